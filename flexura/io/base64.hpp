#pragma once

#include <span>
#include <string>

namespace flexura {

/// Appends bytes to a text, as base64 with padding (RFC 4648).
void append_base64(std::span<const unsigned char> bytes, std::string& text);

}  // namespace flexura
