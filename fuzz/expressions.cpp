// Quantities with units, and formulas.
#include <cmath>

#include "flexura/core/units.hpp"
#include "flexura/io/expression.hpp"
#include "fuzz/target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flexura;
  const std::string text(fuzz::text_of(data, size));
  const QuantityReading quantity = read_quantity(text);
  fuzz::expect(quantity.quantity.has_value() == quantity.error.empty());
  if (quantity.quantity) static_cast<void>(UnitSystem().value_of(*quantity.quantity));
  static_cast<void>(read_unit(text));
  Formulas formulas;
  if (!formulas.check_name("t")) formulas.define("t", 0.5);
  if (const auto names = formulas.undefined_names(text);
      !names.error.empty() || !names.names.empty())
    return 0;
  const Formulas::Value value = formulas.evaluate(text);
  fuzz::expect(value.value ? std::isfinite(*value.value) : !value.error.empty());
  const Formulas::Function function = formulas.function_of("u", text);
  if (function.function) static_cast<void>(function.function(0.25));
  return 0;
}
