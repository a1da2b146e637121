#include "flexura/io/text_checks.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace flexura {
namespace {

constexpr int deepest_nesting = 32;
constexpr int most_key_parts = 16;

SourcePosition position_at(std::string_view text, std::size_t offset) {
  SourcePosition position;
  for (const char c : text.substr(0, offset)) {
    if (c == '\n') {
      ++position.line;
      position.column = 1;
    } else if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) {
      ++position.column;  // columns count characters, not bytes
    }
  }
  return position;
}

/// Bytes of the UTF-8 character at the start of `text`, 0 if there is none: no overlong forms,
/// no surrogates, nothing beyond U+10FFFF (RFC 3629).
std::size_t utf8_length(std::string_view text) {
  const auto byte = [text](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const auto follows = [&byte](std::size_t i, unsigned low = 0x80, unsigned high = 0xBF) {
    return byte(i) >= low && byte(i) <= high;
  };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead <= 0xDF) return follows(1) ? 2 : 0;
  if (lead >= 0xE0 && lead <= 0xEF) {
    const bool second = follows(1, lead == 0xE0 ? 0xA0 : 0x80, lead == 0xED ? 0x9F : 0xBF);
    return second && follows(2) ? 3 : 0;
  }
  if (lead >= 0xF0 && lead <= 0xF4) {
    const bool second = follows(1, lead == 0xF0 ? 0x90 : 0x80, lead == 0xF4 ? 0x8F : 0xBF);
    return second && follows(2) && follows(3) ? 4 : 0;
  }
  return 0;
}

std::optional<Diagnostic> check_encoding(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    return Diagnostic{{}, "the file is UTF-16; model files are UTF-8 text"};
  }
  if (const auto at = text.find('\0'); at != std::string_view::npos) {
    return Diagnostic{position_at(text, at),
                      "this is a binary file (it holds a zero byte), not "
                      "a model: a model is UTF-8 text"};
  }
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text.substr(at));
    if (length == 0) {
      return Diagnostic{position_at(text, at),
                        fmt::format("the file is not UTF-8 text (byte 0x{:02x} here)",
                                    static_cast<unsigned>(static_cast<unsigned char>(text[at])))};
    }
    at += length;
  }
  return {};
}

/// Follows brackets and dotted keys, skipping strings and comments as TOML delimits them.
class NestingScan {
 public:
  explicit NestingScan(std::string_view text) : text_(text) {}

  std::optional<Diagnostic> run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (c == '"' || c == '\'') {
        skip_string(c);
      } else {
        count(c);
        if (depth_ > deepest_nesting || dots_ >= most_key_parts) return too_deep();
        ++at_;
      }
    }
    return {};
  }

 private:
  void count(char c) {
    const bool key_character = c == '_' || c == '-' || c == ' ' || c == '\t' ||
                               (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
                               (c >= 'A' && c <= 'Z');
    if (c == '.') {
      ++dots_;
    } else if (!key_character) {
      dots_ = 0;
    }
    if (c == '[' || c == '{') ++depth_;
    if ((c == ']' || c == '}') && depth_ > 0) --depth_;
  }

  void skip_string(char quote) {
    const std::string_view rest = text_.substr(at_);
    const bool triple = rest.size() > 2 && rest[1] == quote && rest[2] == quote;
    std::size_t end = triple ? 3 : 1;
    while (end < rest.size()) {
      if (rest[end] == '\\' && quote == '"') {
        end += 2;
      } else if (!triple && (rest[end] == quote || rest[end] == '\n')) {
        break;
      } else if (triple && rest.substr(end, 3) == rest.substr(0, 3)) {
        end += 2;
        break;
      } else {
        ++end;
      }
    }
    at_ = std::min(at_ + end + 1, text_.size());
  }

  Diagnostic too_deep() const {
    return {
        position_at(text_, at_),
        dots_ >= most_key_parts
            ? fmt::format("a key of more than {} parts; no model needs that", most_key_parts)
            : fmt::format("brackets nested deeper than {}; no model needs that", deepest_nesting)};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  int dots_ = 0;
};

}  // namespace

std::string too_long_message(std::uintmax_t size) {
  constexpr double megabyte = 1024.0 * 1024.0;
  const std::string has =
      size == 0 ? "is longer" : fmt::format("has {:.1f} MB", static_cast<double>(size) / megabyte);
  return fmt::format("the file {}; a model file may have {} MB at most", has,
                     longest_model_text >> 20U);
}

std::optional<Diagnostic> check_text(std::string_view text) {
  if (text.size() > longest_model_text) return Diagnostic{{}, too_long_message(text.size())};
  if (auto problem = check_encoding(text)) return problem;
  return NestingScan(text).run();
}

}  // namespace flexura
