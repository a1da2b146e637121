#pragma once

#include <string>

#include <gtest/gtest.h>

#include "flexura/io/model_reader.hpp"

namespace flexura::testing {

/// A small valid model whose parts can be replaced one by one.
struct ModelText {
  std::string head = "flexura = 1\n";
  std::string units = "[units]\nlength = \"mm\"\nforce = \"N\"\ntime = \"s\"\n";
  std::string parameters;
  std::string materials = "[materials.steel]\nyoungs_modulus = 210e3\npoissons_ratio = 0.3\n";
  std::string sections = "[sections.strip]\nrectangle = { thickness = 0.1, width = 1.0 }\n";
  std::string bodies = "[bodies.ground]\nfixed = true\n[bodies.stage]\npoints = { P = [10, 5] }\n";
  std::string axis = "{ line = [[0, 0], [10, 0]] }";
  std::string studies;

  std::string text() const {
    return head + units + parameters + materials + sections + bodies +
           "[flexures.leaf]\nbetween = [\"ground\", \"stage\"]\naxis = " + axis +
           "\nmaterial = \"steel\"\nsection = \"strip\"\n" + studies;
  }
};

/// All messages of a reading, one a line, with their positions.
inline std::string messages(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& d : diagnostics) {
    text += std::to_string(d.position.line) + ":" + std::to_string(d.position.column) + ": " +
            d.message + "\n";
  }
  return text;
}

/// The model; a failed expectation and an empty model if there are diagnostics.
inline Model read_valid(const std::string& text, const ParameterOverrides& overrides = {}) {
  const ModelReading reading = read_model_text(text, overrides);
  EXPECT_EQ(messages(reading.diagnostics), "");
  EXPECT_TRUE(reading.model.has_value());
  return reading.model.value_or(Model{});
}

}  // namespace flexura::testing
