#include "flexura/report/report.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

#include "flexura/report/assets.hpp"
#include "flexura/report/report_data.hpp"

namespace flexura {
namespace {

std::string escape_html(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

constexpr std::string_view asset_prefix = "asset ";
/// Of what only linkages need: other reports are not to grow by it.
constexpr std::string_view linkage_prefix = "linkage ";

bool starts_with(std::string_view text, std::string_view prefix) {
  return text.substr(0, prefix.size()) == prefix;
}

bool has_linkage(const Result& result) {
  return std::any_of(result.studies.begin(), result.studies.end(), [](const StudyResult& study) {
    return std::holds_alternative<LinkageResult>(study.content);
  });
}

/// What stands for one {{placeholder}} of page.html.
std::string fill(std::string_view placeholder, const Result& result) {
  if (placeholder == "title") {
    return escape_html(result.title.empty() ? result.model_file : result.title);
  }
  if (placeholder == "data") return make_report_data(result);
  for (const std::string_view prefix : {asset_prefix, linkage_prefix}) {
    if (!starts_with(placeholder, prefix)) continue;
    const std::string_view asset = report_asset(placeholder.substr(prefix.size()));
    if (asset.empty()) continue;
    return prefix == linkage_prefix && !has_linkage(result) ? std::string() : std::string(asset);
  }
  throw std::logic_error("page.html asks for an unknown '" + std::string(placeholder) + "'");
}

}  // namespace

std::string make_report(const Result& result) {
  constexpr std::string_view opening = "{{";
  constexpr std::string_view closing = "}}";
  // One pass over the template alone: what is filled in is never searched again, so a title that
  // looks like a placeholder stays a title.
  std::string_view rest = report_asset("page.html");
  std::string html;
  while (true) {
    const std::size_t begin = rest.find(opening);
    html += rest.substr(0, begin);
    if (begin == std::string_view::npos) return html;
    rest.remove_prefix(begin + opening.size());
    const std::size_t end = rest.find(closing);
    if (end == std::string_view::npos) throw std::logic_error("page.html: '{{' without '}}'");
    html += fill(rest.substr(0, end), result);
    rest.remove_prefix(end + closing.size());
  }
}

}  // namespace flexura
