// The reader of model files, on any bytes. A model that it accepts must hold its rules.
#include "flexura/io/model_reader.hpp"
#include "flexura/model/validation.hpp"
#include "fuzz/target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flexura;
  const ModelReading reading = read_model_text(fuzz::text_of(data, size));
  if (reading.model) fuzz::expect(validate_model(*reading.model).empty());
  if (!reading.model) fuzz::expect(!reading.diagnostics.empty());
  for (const Diagnostic& d : reading.diagnostics)
    fuzz::expect(d.position.line >= 1 && d.position.column >= 1 && !d.message.empty());
  return 0;
}
