#include "core/report/table_parts.h"

#include <algorithm>
#include <set>
#include <utility>

#include "core/report/wrap.h"
#include "runtime/base/text.h"

namespace cbc {

std::size_t width_of(std::string_view text) {
  std::size_t width = 0;
  for (std::size_t offset = 0; offset < text.size();) {
    const utf8::Decoded decoded = utf8::decode(text, offset);
    width += utf8::display_width(decoded.character);
    offset += decoded.bytes;
  }
  return width;
}

namespace {

/// Replaces the middle of a text that is wider than `columns` by "...".
std::string shorten_text(const std::string& text, std::size_t columns) {
  std::size_t rest = width_of(text);  // from `offset` on
  if (rest <= columns) return text;
  constexpr std::string_view dots = "...";
  const std::size_t kept = columns - dots.size();
  std::size_t offset = 0;
  const auto width_of_next = [&] {
    return utf8::display_width(utf8::decode(text, offset).character);
  };
  const auto skip = [&] {
    rest -= width_of_next();
    offset += utf8::decode(text, offset).bytes;
  };
  const std::size_t width = rest;
  std::size_t begin = 0;
  while (width - rest <= kept / 2) {
    begin = offset;
    skip();
  }
  while (rest > kept - kept / 2) skip();
  while (width_of_next() == 0) skip();  // would combine with the dots
  return concat(std::string_view(text).substr(0, begin), dots,
                std::string_view(text).substr(offset));
}

}  // namespace

std::vector<std::string> shorten(std::vector<std::string> names) {
  std::size_t widest = 0;
  for (const std::string& name : names) widest = std::max(widest, width_of(name));
  const std::size_t different = std::set<std::string>(names.begin(), names.end()).size();
  for (std::size_t columns = longest_name; columns < widest; columns *= 2) {
    std::vector<std::string> shortened;
    shortened.reserve(names.size());
    for (const std::string& name : names) shortened.push_back(shorten_text(name, columns));
    if (std::set<std::string>(shortened.begin(), shortened.end()).size() == different) {
      return shortened;
    }
  }
  return names;
}

std::string_view without_end_blanks(std::string_view text) {
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

std::string assumptions_to_text(const CompiledCatalog& catalog, const StatedAssumptions& stated,
                                std::size_t columns) {
  const std::size_t width = columns == 0 ? text_width : std::min(columns, text_width);
  return wrap_line(describe_assumptions(catalog, stated), width, 2) + "\n";
}

}  // namespace cbc
