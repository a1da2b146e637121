#include "flexura/io/read_parameters.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "flexura/core/nearest_word.hpp"

namespace flexura {
namespace {

/// A parameter on its way to a value. Settled means that it has one, or never will.
struct Parameter {
  std::string name;
  KeyPath path;
  SourcePosition position;
  std::string quoted;                  ///< as the user wrote it, for messages
  std::optional<std::string> formula;  ///< absent where the value is given directly
  std::vector<std::size_t> needs;      ///< parameters the formula names
  std::size_t missing = 0;             ///< of these, how many are not settled
  bool settled = false;
};

class ParameterReader {
 public:
  explicit ParameterReader(Reading& reading) : reading_(reading) {}

  void read(const std::optional<Place>& place, const ParameterOverrides& overrides) {
    if (place) {
      for (const NamedPlace& entry : read_names(reading_, *place)) add(entry, overrides);
    }
    for (const auto& [name, value] : overrides) check_override(name, value);
    link();
    settle();
    report_cycles();
  }

 private:
  void add(const NamedPlace& entry, const ParameterOverrides& overrides) {
    reading_.parameter_names.push_back(entry.name);
    index_[entry.name] = parameters_.size();
    parameters_.push_back(
        {entry.name, entry.place.path, entry.place.node->position, "", {}, {}, 0, false});
    Parameter& parameter = parameters_.back();
    if (const auto problem = reading_.formulas.check_name(entry.name)) {
      reading_.report(entry.place.path, entry.position,
                      fmt::format("'{}' cannot name a parameter: {}", entry.name, *problem));
      spoil(parameter);
      return;
    }
    if (const auto at = overrides.find(entry.name); at != overrides.end()) {
      parameter.position = {};
      parameter.quoted = fmt::format("--set {}={}", at->first, at->second);
      read_text_value(parameter, at->second, true);
      return;
    }
    parameter.quoted = describe(*entry.place.node);
    const auto& value = entry.place.node->value;
    if (const auto* integer = std::get_if<std::int64_t>(&value)) {
      define(parameter, static_cast<double>(*integer));
    } else if (const auto* number = std::get_if<double>(&value)) {
      define(parameter, *number);
    } else if (const auto* text = entry.place.node->string()) {
      read_text_value(parameter, *text, false);
    } else {
      fail(parameter, "expected a number, a quantity in quotes or an expression \"= ..\"");
    }
  }

  void read_text_value(Parameter& parameter, const std::string& text, bool number_allowed) {
    parameter.formula = formula_of(text);
    if (parameter.formula) return;
    if (const auto number = read_number(text); number && number_allowed) {
      define(parameter, *number);
      return;
    }
    const QuantityReading result = read_quantity(text);
    if (result.quantity) {
      define(parameter, reading_.units.value_of(*result.quantity));
    } else {
      fail(parameter, "expected a number, a quantity with a unit or an expression \"= ..\"",
           ": " + result.error);
    }
  }

  void check_override(const std::string& name, const std::string& value) {
    if (index_.contains(name)) return;
    const std::string hint = reading_.parameter_names.empty()
                                 ? "; the model has no parameters"
                                 : suggestion(name, reading_.parameter_names);
    reading_.report({}, {},
                    fmt::format("--set {}={}: unknown parameter '{}'{}", name, value, name, hint));
  }

  void fail(Parameter& parameter, const std::string& what, const std::string& why = "") {
    reading_.report(parameter.path, parameter.position,
                    fmt::format("{}, got {}{}", what, parameter.quoted, why));
    spoil(parameter);
  }

  void spoil(Parameter& parameter) {
    reading_.spoilt_parameters.insert(parameter.name);
    parameter.formula.reset();
    parameter.settled = true;
  }

  void define(Parameter& parameter, double value) {
    if (!std::isfinite(value)) {
      fail(parameter, "expected a finite number");
      return;
    }
    reading_.formulas.define(parameter.name, value);
    parameter.settled = true;
  }

  /// Finds out which parameters each formula needs.
  void link() {
    dependents_.resize(parameters_.size());
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      Parameter& parameter = parameters_[i];
      if (!parameter.formula) continue;
      for (const std::string& name : reading_.formulas.undefined_names(*parameter.formula).names) {
        const auto at = index_.find(name);
        if (at == index_.end() || parameters_[at->second].settled) continue;
        parameter.needs.push_back(at->second);
        dependents_[at->second].push_back(i);
      }
      parameter.missing = parameter.needs.size();
    }
  }

  /// Evaluates whatever has all it needs, until nothing more has (Kahn's algorithm).
  void settle() {
    std::vector<std::size_t> ready;
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      if (parameters_[i].formula && parameters_[i].missing == 0) ready.push_back(i);
    }
    while (!ready.empty()) {
      const std::size_t now = ready.back();
      ready.pop_back();
      Parameter& parameter = parameters_[now];
      const auto value = evaluate(reading_, parameter.path, parameter.position, *parameter.formula,
                                  parameter.quoted);
      value ? define(parameter, *value) : spoil(parameter);
      for (const std::size_t dependent : dependents_[now]) {
        if (--parameters_[dependent].missing == 0) ready.push_back(dependent);
      }
    }
  }

  /// What is not settled now needs itself, or needs such a parameter. Every cycle is reported
  /// once, at the parameter that stands first in the file.
  void report_cycles() {
    std::vector<char> seen(parameters_.size(), 0);
    for (std::size_t start = 0; start < parameters_.size(); ++start) {
      std::vector<std::size_t> trail;
      std::size_t at = start;
      while (!parameters_[at].settled && !seen[at]) {
        seen[at] = 1;
        trail.push_back(at);
        const auto& needs = parameters_[at].needs;
        at = *std::find_if(needs.begin(), needs.end(),
                           [this](std::size_t need) { return !parameters_[need].settled; });
      }
      const auto first = std::find(trail.begin(), trail.end(), at);
      if (first != trail.end()) report_cycle({first, trail.end()});
    }
    for (Parameter& parameter : parameters_) {
      if (!parameter.settled) spoil(parameter);
    }
  }

  void report_cycle(std::vector<std::size_t> cycle) {
    std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
    const Parameter& first = parameters_[cycle.front()];
    std::vector<std::string> names;
    names.reserve(cycle.size() + 1);
    for (const std::size_t i : cycle) names.push_back(parameters_[i].name);
    names.push_back(first.name);
    reading_.report(
        first.path, first.position,
        fmt::format("the parameter is defined by itself: {}", fmt::join(names, " -> ")));
  }

  Reading& reading_;
  std::vector<Parameter> parameters_;
  std::map<std::string, std::size_t> index_;
  std::vector<std::vector<std::size_t>> dependents_;
};

}  // namespace

void read_parameters(Reading& reading, const std::optional<Place>& place,
                     const ParameterOverrides& overrides) {
  ParameterReader(reading).read(place, overrides);
}

}  // namespace flexura
