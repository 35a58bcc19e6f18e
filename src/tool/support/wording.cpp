#include "support/wording.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/text.h"

namespace cbc {
namespace {

// Costs: a letter in the other case, or one separator for another, is a quarter of an edit.
constexpr std::size_t edit_cost = 4;
constexpr std::size_t small_cost = 1;

// Nobody types longer names, so it is not worth the time to compare them.
constexpr std::size_t longest_name = 200;
constexpr std::size_t shortest_word = 3;

char lower(char character) {
  return character >= 'A' && character <= 'Z' ? static_cast<char>(character - 'A' + 'a')
                                              : character;
}

bool is_separator(char character) {
  return character == '_' || character == '-' || character == ' ' || character == '.';
}

std::size_t substitution_cost(char a, char b) {
  if (a == b) return 0;
  if (lower(a) == lower(b) || (is_separator(a) && is_separator(b))) return small_cost;
  return edit_cost;
}

// The highest cost of a suggestion: an edit for every three characters, or every letter in the
// other case.
std::size_t limit_for(std::size_t length) { return std::max(length, edit_cost * (length / 3)); }

// Edit distance with transpositions of neighbors (optimal string alignment).
class EditDistance {
 public:
  /// `limit + 1` if the distance is more than `limit`. Adds its work to `work`.
  std::size_t operator()(std::string_view a, std::string_view b, std::size_t limit,
                         std::size_t& work) {
    // Cells further from the diagonal cost more than the limit; a border of such cells suffices.
    const std::size_t band = limit / edit_cost;
    const std::size_t beyond = limit + 1;
    for (auto* row : {&before_previous_, &previous_, &current_}) row->assign(b.size() + 2, beyond);
    for (std::size_t j = 0; j <= std::min(band, b.size()); ++j) previous_[j] = j * edit_cost;
    std::size_t smallest_before = 0;
    for (std::size_t i = 1; i <= a.size(); ++i) {
      const std::size_t first = i > band ? i - band : 0;
      const std::size_t last = std::min(b.size(), i + band);
      std::size_t smallest = beyond;
      if (first > 0) current_[first - 1] = beyond;
      for (std::size_t j = first; j <= last; ++j) {
        current_[j] = std::min(cell(a, b, i, j), beyond);
        smallest = std::min(smallest, current_[j]);
      }
      if (last < b.size()) current_[last + 1] = beyond;
      work += last + 1 - first;
      // A transposition looks two rows back.
      if (smallest == beyond && smallest_before == beyond) return beyond;
      smallest_before = smallest;
      std::swap(before_previous_, previous_);
      std::swap(previous_, current_);
    }
    return previous_[b.size()];
  }

 private:
  [[nodiscard]] std::size_t cell(std::string_view a, std::string_view b, std::size_t i,
                                 std::size_t j) const {
    std::size_t cost = previous_[j] + edit_cost;
    if (j == 0) return cost;
    cost = std::min({cost, current_[j - 1] + edit_cost,
                     previous_[j - 1] + substitution_cost(a[i - 1], b[j - 1])});
    if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
        lower(a[i - 2]) == lower(b[j - 1])) {
      cost = std::min(cost, before_previous_[j - 2] + edit_cost);
    }
    return cost;
  }

  std::vector<std::size_t> before_previous_;
  std::vector<std::size_t> previous_;
  std::vector<std::size_t> current_;
};

bool same_letters(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return substitution_cost(x, y) <= small_cost; });
}

// Whether `part` begins or ends `whole` as a sequence of whole words.
bool is_part_at_boundary(std::string_view part, std::string_view whole) {
  if (part.size() < shortest_word || part.size() + 1 >= whole.size()) return false;
  const std::size_t rest = whole.size() - part.size();
  return (is_separator(whole[part.size()]) && same_letters(part, whole.substr(0, part.size()))) ||
         (is_separator(whole[rest - 1]) && same_letters(part, whole.substr(rest)));
}

std::optional<std::string_view> search(std::string_view name,
                                       std::span<const std::string_view> names,
                                       std::size_t& work_left) {
  if (name.empty() || name.size() > longest_name || work_left == 0) return std::nullopt;

  EditDistance distance;
  std::optional<std::string_view> best;
  std::size_t best_cost = 0;
  std::optional<std::string_view> best_part;
  std::size_t best_part_length = 0;
  std::size_t work = names.size();
  for (const std::string_view candidate : names) {
    if (candidate.empty() || candidate.size() > longest_name || candidate == name) continue;
    const std::size_t difference =
        std::max(name.size(), candidate.size()) - std::min(name.size(), candidate.size());
    const std::size_t limit =
        best ? best_cost - 1 : limit_for(std::max(name.size(), candidate.size()));
    const bool near_enough = difference * edit_cost <= limit;
    if (near_enough) {
      const std::size_t cost = distance(name, candidate, limit, work);
      if (cost <= limit) {
        best = candidate;
        best_cost = cost;
      }
    }
    const std::size_t common = std::min(name.size(), candidate.size());
    if (!best && common > best_part_length &&
        (is_part_at_boundary(candidate, name) || is_part_at_boundary(name, candidate))) {
      best_part = candidate;
      best_part_length = common;
    }
  }
  work_left -= std::min(work, work_left);
  return best ? best : best_part;
}

}  // namespace

std::optional<std::string_view> Suggestions::nearest(std::string_view name) {
  return search(name, names_, work_left_);
}

std::optional<std::string_view> nearest(std::string_view name,
                                        std::span<const std::string_view> names) {
  std::size_t work_left = std::numeric_limits<std::size_t>::max();
  return search(name, names, work_left);
}

std::string did_you_mean(std::optional<std::string_view> suggestion) {
  return suggestion ? "; did you mean " + quote(*suggestion) + "?" : std::string();
}

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

/// The end of the first line: the break that makes it nearest to the length.
std::size_t end_of_first_line(std::string_view name, std::size_t length) {
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
  // A few more characters are better than another line.
  const std::size_t count = (length - std::min(length, width / 3) + width - 1) / width;
  for (std::size_t left = count; left > 1 && !name.empty(); --left) {
    const std::size_t line = utf8::count_characters(name) / left;
    const std::size_t end = end_of_first_line(name, line);
    lines.push_back(name.substr(0, end));
    name.remove_prefix(end);
  }
  if (!name.empty() || lines.empty()) lines.push_back(name);
  return lines;
}

namespace {

bool stands_for_itself(char byte) {
  return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') ||
         (byte >= '0' && byte <= '9') || byte == '-' || byte == '.' || byte == '_' || byte == '~' ||
         byte == '/';
}

}  // namespace

std::string percent_encode(std::string_view path) {
  std::string encoded;
  for (const char byte : path) {
    if (stands_for_itself(byte)) {
      encoded += byte;
    } else {
      append_percent_encoded(encoded, byte);
    }
  }
  return encoded;
}

void append_percent_encoded(std::string& text, char byte) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  const unsigned value = static_cast<unsigned char>(byte);
  text += '%';
  text += digits[value / 16];
  text += digits[value % 16];
}

}  // namespace cbc
