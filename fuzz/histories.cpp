// The reader of tables over time.
#include <cmath>

#include "flexura/io/history_file.hpp"
#include "fuzz/target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flexura;
  const HistoryFileReading reading =
      read_history_text(fuzz::text_of(data, size), {"h.csv", "t", "a"});
  if (!reading.error.empty()) return 0;
  fuzz::expect(reading.times.size() == reading.values.size());
  for (std::size_t k = 0; k < reading.times.size(); ++k) {
    fuzz::expect(std::isfinite(reading.times[k]) && std::isfinite(reading.values[k]));
    fuzz::expect(k == 0 || reading.times[k] > reading.times[k - 1]);
  }
  return 0;
}
