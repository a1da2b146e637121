#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "flexura/core/diagnostics.hpp"
#include "flexura/model/model.hpp"

namespace flexura {

/// Parameters given from outside, such as by `--set t=0.2`: by name, the value a plain number, a
/// quantity with a unit ("50 um") or an expression ("= 2*w").
using ParameterOverrides = std::map<std::string, std::string>;

/// The model, or every mistake of the file sorted by position; never both, never neither. Warnings
/// stand among the diagnostics of either.
struct ModelReading {
  std::optional<Model> model;
  Diagnostics diagnostics;
};

/// Reads and checks a model file (format version 1, docs/model_file.md). All quantities of the
/// model are in the file's declared units, angles in radians. Whatever is wrong, with the file,
/// its text or the model, comes back as diagnostics; nothing is thrown.
ModelReading read_model(const std::filesystem::path& file,
                        const ParameterOverrides& overrides = {});

/// Likewise for the text of a model file; files that it names are looked for in the current
/// directory, not beside it.
ModelReading read_model_text(std::string_view text, const ParameterOverrides& overrides = {});

}  // namespace flexura
