#include "flexura/io/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <cctype>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <utility>

namespace flexura {

struct Formulas::Parser {
  // Evaluation changes only muParser's own caches.
  mutable mu::Parser parser;
};

namespace {

std::string explain(const mu::Parser::exception_type& error) {
  std::string message = error.GetMsg();
  while (!message.empty() && (message.back() == '.' || message.back() == ' ')) message.pop_back();
  // muParser counts from 0; people and the rest of the messages count from 1.
  if (const auto at = message.find("position "); at != std::string::npos && error.GetPos() >= 0) {
    message.replace(at, std::string::npos, fmt::format("character {}", error.GetPos() + 1));
  }
  if (!message.empty()) {
    message[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(message[0])));
  }
  return message;
}

/// muParser keeps a pointer to its variable and caches of its own: every copy needs its own, and
/// threads that share one must take turns.
class FunctionOfOne {
 public:
  FunctionOfOne(const mu::Parser& parser, std::string variable)
      : variable_(std::move(variable)), state_(std::make_unique<State>(parser)) {
    state_->parser.DefineVar(variable_, &state_->value);
  }
  FunctionOfOne(const FunctionOfOne& other) : FunctionOfOne(other.parser(), other.variable_) {}
  FunctionOfOne(FunctionOfOne&&) noexcept = default;
  FunctionOfOne& operator=(const FunctionOfOne&) = delete;
  FunctionOfOne& operator=(FunctionOfOne&&) = delete;
  ~FunctionOfOne() = default;

  double operator()(double value) const {
    const std::scoped_lock lock(state_->turn);
    try {
      state_->value = value;
      return state_->parser.Eval();
    } catch (const mu::Parser::exception_type&) {
      return std::numeric_limits<double>::quiet_NaN();
    }
  }

 private:
  mu::Parser parser() const {
    const std::scoped_lock lock(state_->turn);
    return state_->parser;
  }

  struct State {
    explicit State(const mu::Parser& original) : parser(original) {}

    mu::Parser parser;
    double value = 0.0;
    std::mutex turn;
  };
  std::string variable_;
  std::unique_ptr<State> state_;
};

}  // namespace

Formulas::Formulas() : parser_(std::make_unique<Parser>()) {
  parser_->parser.DefineConst("pi", std::numbers::pi);
}
Formulas::~Formulas() = default;
Formulas::Formulas(Formulas&&) noexcept = default;
Formulas& Formulas::operator=(Formulas&&) noexcept = default;

std::optional<std::string> Formulas::check_name(const std::string& name) const {
  const auto letter = [](char c) {
    return c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  };
  bool valid = !name.empty() && letter(name[0]);
  for (const char c : name) valid = valid && (letter(c) || (c >= '0' && c <= '9'));
  if (!valid) return "a parameter's name is made of letters, digits and _, a letter first";
  if (parser_->parser.GetFunDef().count(name) != 0) return "it is the name of a function";
  if (name == "pi" || name == "_pi" || name == "_e") return "it is the name of a constant";
  return {};
}

void Formulas::define(const std::string& name, double value) {
  parser_->parser.DefineConst(name, value);
}

Formulas::Names Formulas::undefined_names(const std::string& formula) const {
  try {
    parser_->parser.SetExpr(formula);
    Names result;
    for (const auto& [name, value] : parser_->parser.GetUsedVar()) result.names.push_back(name);
    return result;
  } catch (const mu::Parser::exception_type& error) {
    return {{}, explain(error)};
  }
}

Formulas::Value Formulas::evaluate(const std::string& formula) const {
  try {
    parser_->parser.SetExpr(formula);
    int count = 0;
    const double* values = parser_->parser.Eval(count);
    if (count != 1) return {std::nullopt, fmt::format("it gives {} values", count)};
    if (std::isnan(values[0])) return {std::nullopt, "its value is not a number"};
    if (std::isinf(values[0])) return {std::nullopt, "its value is infinite"};
    return {values[0], ""};
  } catch (const mu::Parser::exception_type& error) {
    return {std::nullopt, explain(error)};
  }
}

Formulas::Function Formulas::function_of(const std::string& variable,
                                         const std::string& formula) const {
  try {
    mu::Parser parser(parser_->parser);
    const auto constants = parser.GetConst();
    parser.ClearConst();
    for (const auto& [name, value] : constants)
      if (name != variable) parser.DefineConst(name, value);
    double somewhere = 0.0;
    parser.DefineVar(variable, &somewhere);
    parser.SetExpr(formula);
    int count = 0;
    parser.Eval(count);
    if (count != 1) return {{}, fmt::format("it gives {} values", count)};
    return {FunctionOfOne(parser, variable), ""};
  } catch (const mu::Parser::exception_type& error) {
    return {{}, explain(error)};
  }
}

std::optional<std::string> formula_of(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || text[first] != '=') return {};
  std::string formula(text);
  formula[first] = ' ';  // so that positions in the formula are those in the text
  return formula;
}

}  // namespace flexura
