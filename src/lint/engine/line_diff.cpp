// Line differences in the unified format.
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/check/check.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

constexpr std::size_t context = 3;

// A piece ends after this many changes, or after this many equal lines in a row.
constexpr int most_changes = 200;
constexpr int sure_match = 32;

using TextLines = std::vector<std::string_view>;

/// Each with its line break; the last one may lack it.
TextLines split_lines(std::string_view text) {
  TextLines lines;
  while (!text.empty()) {
    const std::size_t line_break = text.find('\n');
    const std::size_t size = line_break == std::string_view::npos ? text.size() : line_break + 1;
    lines.push_back(text.substr(0, size));
    text.remove_prefix(size);
  }
  return lines;
}

/// Lines [old_begin, old_end) of the old text, replaced by [new_begin, new_end) of the new one.
struct LineChange {
  std::size_t old_begin = 0;
  std::size_t old_end = 0;
  std::size_t new_begin = 0;
  std::size_t new_end = 0;
};

/// Finds the changes from front to back, by the greedy algorithm of Myers ("An O(ND) difference
/// algorithm and its variations", 1986), piece by piece: a piece ends where the texts agree again
/// for a while, or when it gets too long. So the work is linear even where the texts have nothing
/// in common, which no library at hand ensures.
class LineComparison {
 public:
  LineComparison(const TextLines& before, const TextLines& after)
      : before_(before), after_(after) {}

  std::vector<LineChange> run() {
    skip_equal();
    while (x_ < before_.size() || y_ < after_.size()) {
      add_piece();
      skip_equal();
    }
    return std::move(changes_);
  }

 private:
  // The furthest points that a number of changes reaches, by diagonal, in lines of the old text.
  // `furthest_[d]` has those of the diagonals -d to d.
  using Reach = std::vector<int>;

  void skip_equal() {
    while (x_ < before_.size() && y_ < after_.size() && before_[x_] == after_[y_]) {
      ++x_;
      ++y_;
    }
  }

  [[nodiscard]] int old_left() const { return static_cast<int>(before_.size() - x_); }
  [[nodiscard]] int new_left() const { return static_cast<int>(after_.size() - y_); }

  [[nodiscard]] bool equal(int x, int y) const {
    return x < old_left() && y < new_left() &&
           before_[x_ + static_cast<std::size_t>(x)] == after_[y_ + static_cast<std::size_t>(y)];
  }

  static std::size_t slot(int changes, int diagonal) {
    const int place = diagonal + changes;
    return static_cast<std::size_t>(place);
  }

  [[nodiscard]] int reached(int changes, int diagonal) const {
    return furthest_[static_cast<std::size_t>(changes)][slot(changes, diagonal)];
  }

  [[nodiscard]] bool is_possible(int x, int diagonal) const {
    return x >= 0 && x <= old_left() && x >= diagonal && x - diagonal <= new_left();
  }

  // The point on a diagonal that one more change leads to; below 0: none.
  [[nodiscard]] int step(int changes, int diagonal) const {
    if (changes == 0) return 0;
    int best = -1;
    if (diagonal > -changes + 1) {  // a line is deleted
      const int from = reached(changes - 1, diagonal - 1);
      if (from >= 0 && is_possible(from + 1, diagonal)) best = from + 1;
    }
    if (diagonal < changes - 1) {  // a line is inserted
      const int from = reached(changes - 1, diagonal + 1);
      if (from > best && is_possible(from, diagonal)) best = from;
    }
    return best;
  }

  void add_piece() {
    furthest_.clear();
    int best_diagonal = 0;
    for (int changes = 0;; ++changes) {
      furthest_.emplace_back(slot(changes, changes) + 1, -1);
      int best_sum = -1;
      for (int diagonal = -changes; diagonal <= changes; diagonal += 2) {
        const int from = step(changes, diagonal);
        if (from < 0) continue;
        int x = from;
        while (equal(x, x - diagonal)) ++x;
        furthest_.back()[slot(changes, diagonal)] = x;
        if (2 * x - diagonal > best_sum) {
          best_sum = 2 * x - diagonal;
          best_diagonal = diagonal;
        }
        const bool at_end = x == old_left() && x - diagonal == new_left();
        if (at_end || x - from >= sure_match) return take(changes, diagonal);
      }
      if (changes == most_changes) return take(changes, best_diagonal);
    }
  }

  // Follows the path that ends on a diagonal back to its start, and adds its changes.
  void take(int changes, int diagonal) {
    const int end = reached(changes, diagonal);
    const int end_diagonal = diagonal;
    std::vector<LineChange> path;
    for (; changes > 0; --changes) {
      const int to = step(changes, diagonal);
      const bool is_deletion = diagonal > -changes + 1 && reached(changes - 1, diagonal - 1) >= 0 &&
                               reached(changes - 1, diagonal - 1) + 1 == to;
      const auto x = x_ + static_cast<std::size_t>(to);
      const auto y = y_ + static_cast<std::size_t>(to - diagonal);
      path.push_back(is_deletion ? LineChange{x - 1, x, y, y} : LineChange{x, x, y - 1, y});
      diagonal += is_deletion ? -1 : 1;
    }
    std::reverse(path.begin(), path.end());
    for (const LineChange& change : path) add(change);
    x_ += static_cast<std::size_t>(end);
    y_ += static_cast<std::size_t>(end - end_diagonal);
  }

  void add(const LineChange& change) {
    if (!changes_.empty() && changes_.back().old_end == change.old_begin &&
        changes_.back().new_end == change.new_begin) {
      changes_.back().old_end = change.old_end;
      changes_.back().new_end = change.new_end;
    } else {
      changes_.push_back(change);
    }
  }

  const TextLines& before_;
  const TextLines& after_;
  std::size_t x_ = 0;  // lines that were compared
  std::size_t y_ = 0;
  std::vector<Reach> furthest_;
  std::vector<LineChange> changes_;
};

void add_line(char mark, std::string_view line, std::string& diff) {
  diff += mark;
  diff += line;
  if (!line.ends_with('\n')) diff += "\n\\ No newline at end of file\n";
}

/// Lines of a hunk: "12,3". A single line has no count; for no lines it is the line before them.
std::string extent(std::size_t begin, std::size_t end) {
  if (end == begin + 1) return std::to_string(end);
  return std::to_string(begin == end ? begin : begin + 1) + "," + std::to_string(end - begin);
}

/// A hunk: changes [first, last), which are close together, and the lines around them.
void add_hunk(const TextLines& before, const TextLines& after,
              const std::vector<LineChange>& changes, std::size_t first, std::size_t last,
              std::string& diff) {
  const std::size_t lead = std::min(context, changes[first].old_begin);
  const std::size_t tail = std::min(context, before.size() - changes[last - 1].old_end);
  diff += "@@ -" + extent(changes[first].old_begin - lead, changes[last - 1].old_end + tail) +
          " +" + extent(changes[first].new_begin - lead, changes[last - 1].new_end + tail) +
          " @@\n";
  std::size_t line = changes[first].old_begin - lead;
  for (std::size_t i = first; i < last; ++i) {
    for (; line < changes[i].old_begin; ++line) add_line(' ', before[line], diff);
    for (; line < changes[i].old_end; ++line) add_line('-', before[line], diff);
    for (std::size_t added = changes[i].new_begin; added < changes[i].new_end; ++added) {
      add_line('+', after[added], diff);
    }
  }
  for (const std::size_t end = line + tail; line < end; ++line) add_line(' ', before[line], diff);
}

/// A file name as git writes it: in quotes if necessary, and followed by a tab if it has blanks.
/// In quotes are also names with characters that terminals obey or do not show.
std::string name_in_head(std::string_view prefix, std::string_view file) {
  const bool is_shown = printable(file) == file;
  const auto is_special = [is_shown](char byte) {
    const auto code = static_cast<unsigned char>(byte);
    return code < 0x20 || code == 0x7F || (code > 0x7F && !is_shown) || byte == '"' || byte == '\\';
  };
  std::string name(prefix);
  if (std::none_of(file.begin(), file.end(), is_special)) {
    name += file;
    if (file.find(' ') != std::string_view::npos) name += '\t';
    return name;
  }
  name.insert(0, "\"");
  for (const char byte : file) {
    if (byte == '"' || byte == '\\') {
      name += '\\';
      name += byte;
    } else if (is_special(byte)) {
      const auto code = static_cast<unsigned char>(byte);
      name += '\\';
      for (const unsigned shift : {6U, 3U, 0U}) {
        name += static_cast<char>('0' + ((code >> shift) & 7U));
      }
    } else {
      name += byte;
    }
  }
  return name + '"';
}

}  // namespace

std::string unified_diff(std::string_view before, std::string_view after, std::string_view file) {
  const TextLines old_lines = split_lines(before);
  const TextLines new_lines = split_lines(after);
  const std::vector<LineChange> changes = LineComparison(old_lines, new_lines).run();
  if (changes.empty()) return {};
  std::string diff = "--- " + name_in_head("a/", file) + "\n+++ " + name_in_head("b/", file) + "\n";
  for (std::size_t first = 0; first < changes.size();) {
    std::size_t last = first + 1;
    while (last < changes.size() &&
           changes[last].old_begin - changes[last - 1].old_end <= 2 * context) {
      ++last;
    }
    add_hunk(old_lines, new_lines, changes, first, last, diff);
    first = last;
  }
  return diff;
}

}  // namespace cbc
