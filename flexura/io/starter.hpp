#pragma once

#include <string>

namespace flexura {

/// The text of a small, commented model to begin from: a stage on two parallel leaf flexures. It
/// is valid as it stands.
std::string starter_model();

}  // namespace flexura
