// Differences between lines in the unified format, by longest common subsequences (J. W. Hunt and
// M. D. McIlroy, "An algorithm for differential file comparison", 1976), each in a window of the
// next lines of both texts. A window whose lines do not agree again for a while is tried again with
// more of them, up to a bound; so time and memory for a line are bounded, whatever the texts.
//
// The algorithm of E. W. Myers, "An O(ND) difference algorithm and its variations", Algorithmica 1
// (1986), finds the shortest difference of the whole texts, but takes quadratic time where they
// have little in common. The edits that a fix made are known, but there may be several rounds of
// them, each on the text of the one before; to compare the first text with the last is simpler.

#include "core/support/line_diff.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/base/text.h"

namespace cbc {
namespace {

constexpr std::size_t context = 3;

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

/// Finds the changes from front to back, window by window.
class LineComparison {
 public:
  LineComparison(const TextLines& before, const TextLines& after)
      : before_(before), after_(after) {}

  std::vector<LineChange> run() {
    constexpr std::size_t fewest = 32;
    constexpr std::size_t most = 2048;
    while (x_ < before_.size() || y_ < after_.size()) {
      std::size_t window = fewest;
      while (!compare_next(window, window >= most)) window *= 4;
    }
    return std::move(changes_);
  }

 private:
  static constexpr std::size_t sure_match = 16;  // equal lines in a row

  /// Adds the changes among the next lines of both texts, unless these end without a sure match; if
  /// `is_last`, also then.
  bool compare_next(std::size_t window, bool is_last) {
    const std::size_t width = std::min(window, after_.size() - y_);
    const std::size_t height = std::min(window, before_.size() - x_);
    const bool is_rest = width == after_.size() - y_ && height == before_.size() - x_;
    // By line of either text: how many lines the texts have in common from there on.
    std::vector<std::uint16_t> common((height + 1) * (width + 1));
    const auto at = [&](std::size_t i, std::size_t j) -> std::uint16_t& {
      return common[i * (width + 1) + j];
    };
    const auto are_equal = [&](std::size_t i, std::size_t j) {
      return before_[x_ + i] == after_[y_ + j];
    };
    for (std::size_t i = height; i-- > 0;) {
      for (std::size_t j = width; j-- > 0;) {
        at(i, j) = are_equal(i, j) ? static_cast<std::uint16_t>(at(i + 1, j + 1) + 1)
                                   : std::max(at(i + 1, j), at(i, j + 1));
      }
    }
    std::vector<LineChange> found;
    std::size_t i = 0;
    std::size_t j = 0;
    std::size_t equal = 0;
    while ((i < height || j < width) && equal < sure_match) {
      if (i < height && j < width && are_equal(i, j)) {
        ++equal;
        ++i;
        ++j;
        continue;
      }
      equal = 0;
      const bool is_deletion = j == width || (i < height && at(i + 1, j) >= at(i, j + 1));
      found.push_back(
          {x_ + i, x_ + i + (is_deletion ? 1 : 0), y_ + j, y_ + j + (is_deletion ? 0 : 1)});
      ++(is_deletion ? i : j);
    }
    if (equal < sure_match && !is_rest && !is_last) return false;
    for (const LineChange& change : found) add(change);
    x_ += i;
    y_ += j;
    return true;
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

}  // namespace

std::string unified_diff(std::string_view before, std::string_view after, std::string_view file) {
  const TextLines old_lines = split_lines(before);
  const TextLines new_lines = split_lines(after);
  const std::vector<LineChange> changes = LineComparison(old_lines, new_lines).run();
  if (changes.empty()) return {};
  std::string name = printable(file);
  if (name.find(' ') != std::string::npos) name += '\t';  // ends it for patch
  std::string diff = "--- a/" + name + "\n+++ b/" + name + "\n";
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
