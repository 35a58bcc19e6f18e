#include "text/wrap.h"

#include <algorithm>
#include <cstddef>

#include "text/utf8.h"

namespace cbc {
namespace {

bool is_lower(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool joins_words(char c) { return std::string_view(" _-./").find(c) != std::string_view::npos; }

/// Whether a line may end before this byte.
bool can_break(std::string_view name, std::size_t place) {
  const char before = name[place - 1];
  const char after = name[place];
  if (joins_words(before)) return !joins_words(after);
  return is_lower(before) && is_upper(after);
}

/// The end of the first line: the place to break that leaves it nearest to the length.
std::size_t end_of_line(std::string_view name, std::size_t length) {
  std::size_t best = name.size();
  std::size_t best_distance = utf8::count_characters(name) - length;
  for (std::size_t place = 1; place < name.size(); ++place) {
    if (!can_break(name, place)) continue;
    const std::size_t line = utf8::count_characters(name.substr(0, place));
    const std::size_t distance = line > length ? line - length : length - line;
    if (distance < best_distance) {
      best = place;
      best_distance = distance;
    }
    if (line > length) break;
  }
  return best;
}

}  // namespace

std::vector<std::string_view> wrap_name(std::string_view name, std::size_t width) {
  std::vector<std::string_view> lines;
  const std::size_t length = utf8::count_characters(name);
  // A few characters more are better than another line.
  const std::size_t count = (length - std::min(length, width / 3) + width - 1) / width;
  for (std::size_t left = count; left > 1 && !name.empty(); --left) {
    const std::size_t line = utf8::count_characters(name) / left;
    const std::size_t end = end_of_line(name, line);
    lines.push_back(name.substr(0, end));
    name.remove_prefix(end);
  }
  if (!name.empty() || lines.empty()) lines.push_back(name);
  return lines;
}

}  // namespace cbc
