// Stands in for libFuzzer where only GCC is: runs a target on every file named or in a folder
// named, then on mutations of them, the same ones every time.
//   fuzz_model [--mutations N] [--seconds S] FILE|FOLDER..
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "fuzz/target.hpp"

namespace {

namespace fs = std::filesystem;

std::vector<std::string> read_inputs(const std::vector<std::string>& places) {
  std::vector<fs::path> files;
  for (const std::string& place : places) {
    if (!fs::exists(place)) {
      std::fprintf(stderr, "no seeds at %s\n", place.c_str());
      std::exit(2);
    }
    if (!fs::is_directory(place)) files.emplace_back(place);
    if (fs::is_directory(place))
      for (const auto& entry : fs::recursive_directory_iterator(place))
        if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> inputs{""};
  for (const fs::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return inputs;
}

/// One to eight changes: bits, bytes, pieces cut out, doubled, or taken from another input.
std::string mutated(const std::vector<std::string>& inputs, std::mt19937_64& random) {
  const auto below = [&random](std::size_t n) { return n == 0 ? 0 : random() % n; };
  std::string text = inputs[below(inputs.size())];
  const std::string& other = inputs[below(inputs.size())];
  const std::size_t changes = 1 + below(8);
  for (std::size_t k = 0; k < changes; ++k) {
    const std::size_t at = below(text.size());
    const std::size_t length = std::min(1 + below(24), text.size() - at);
    switch (below(6)) {
      case 0:
        if (!text.empty()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        break;
      case 1:
        text.insert(at, 1, static_cast<char>(below(256)));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(at, text.substr(at, length));
        break;
      case 4:
        text.insert(at, other.substr(below(other.size()), 1 + below(24)));
        break;
      default: {
        constexpr const char* pieces[] = {
            "-1", "0", "1e308", "1e-320", "nan", "[",  "]",
            "{",  "=", "\"",    ".",      ",",   "\n", "9223372036854775807",
            "*",  "("};
        text.insert(at, pieces[below(std::size(pieces))]);
      }
    }
  }
  return text;
}

/// The input is kept in a file while it runs: what it brings down remains there.
void run(const std::string& text, const fs::path& kept) {
  std::ofstream(kept, std::ios::binary) << text;
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t mutations = 0;
  double seconds = 1e9;
  std::vector<std::string> places;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    if (word == "--mutations" && k + 1 < argc)
      mutations = std::stoul(argv[++k]);
    else if (word == "--seconds" && k + 1 < argc)
      seconds = std::stod(argv[++k]);
    else
      places.push_back(word);
  }
  const std::vector<std::string> inputs = read_inputs(places);
  const fs::path kept =
      fs::temp_directory_path() / ("flexura_fuzz_input_" + std::to_string(::getpid()));
  for (const std::string& input : inputs) run(input, kept);
  const auto start = std::chrono::steady_clock::now();
  std::mt19937_64 random(1);
  std::size_t done = 0;
  while (done < mutations &&
         std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() <
             seconds) {
    run(mutated(inputs, random), kept);
    ++done;
  }
  fs::remove(kept);
  std::printf("%zu inputs, %zu mutations\n", inputs.size(), done);
  return 0;
}
