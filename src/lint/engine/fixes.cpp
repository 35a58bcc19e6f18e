// Mends texts by the edits of findings, and shows what that changes in the unified format.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/check/check.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"
#include "core/yaml/source.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

using yaml::is_blank;
using yaml::Kind;
using yaml::Node;
using yaml::Span;

/// A comma between two items, and nothing else but blanks and line breaks.
bool is_one_comma(std::string_view gap) {
  return std::count(gap.begin(), gap.end(), ',') == 1 &&
         std::all_of(gap.begin(), gap.end(),
                     [](char byte) { return byte == ',' || is_blank(byte); });
}

/// Finds the piece of a text to delete for an entry of a list to be removed, and nothing else: the
/// lines of an entry with a dash; in a list of names in brackets, the name and one comma.
class EntrySpans {
 public:
  struct Entry {
    const yaml::Node* list = nullptr;
    std::size_t place = 0;  ///< among its items
  };

  /// `document` is that of `text`, which has no byte order mark; `positions` are those in it. All
  /// three must outlive this object.
  EntrySpans(std::string_view text, const yaml::Document& document, const PositionMap& positions)
      : text_(text), positions_(positions), lines_(yaml::split_lines(text, &document)) {
    index(document.root());
  }

  /// The entry that begins at a place. None if the place has more than one meaning because of
  /// aliases.
  [[nodiscard]] std::optional<Entry> find(const Position& begin) const {
    const auto found = entries_.find(begin);
    return found == entries_.end() ? std::nullopt : std::optional(found->second);
  }

  /// The piece to delete. None if a comment or an anchor would be deleted with it, or if the layout
  /// is unusual.
  [[nodiscard]] std::optional<Span> span_of(const Entry& entry) const {
    const std::optional<Span> span =
        first_byte(*entry.list) == '[' ? name_and_comma(entry) : lines_of(entry);
    // Any '#' counts, since parsers differ in what begins a comment.
    if (!span || text_of(*span).find('#') != std::string_view::npos) return std::nullopt;
    if (!lies_within(*entry.list->items[entry.place], *span)) return std::nullopt;
    return span;
  }

 private:
  void index(const Node& node) {
    if (node.shared) return;
    for (std::size_t place = 0; place < node.items.size(); ++place) {
      const Node& item = *node.items[place];
      if (!item.shared) entries_[item.range.begin] = {&node, place};
      index(item);
    }
    for (const auto& entry : node.entries) index(*entry.second);
  }

  [[nodiscard]] std::string_view text_of(const Span& span) const {
    return text_.substr(span.begin, span.end - span.begin);
  }

  [[nodiscard]] char first_byte(const Node& node) const {
    const std::size_t begin = positions_.offset(node.range.begin);
    return begin < text_.size() ? text_[begin] : '\0';
  }

  /// Whether all parts of a value lie in a span. The target of an alias may be anywhere but in the
  /// span, as it would be deleted with it.
  [[nodiscard]] bool lies_within(const Node& node, const Span& span) const {
    const std::size_t begin = positions_.offset(node.range.begin);
    const bool begins_within = span.begin <= begin && begin < span.end;
    if (node.shared) return !begins_within;
    if (!begins_within || positions_.offset(node.range.end) > span.end) return false;
    // Where a block of text ends is not known.
    const char first = first_byte(node);
    if (node.kind == Kind::scalar && !node.plain && (first == '|' || first == '>')) return false;
    return std::all_of(node.items.begin(), node.items.end(),
                       [&](const Node* item) { return lies_within(*item, span); }) &&
           std::all_of(node.entries.begin(), node.entries.end(), [&](const auto& entry) {
             return lies_within(*entry.first, span) && lies_within(*entry.second, span);
           });
  }

  /// Whether a comment for this program stands above a line: it would be about what follows.
  [[nodiscard]] bool has_control_above(std::size_t line) const {
    while (line-- > 0 && !lines_[line].has_content) {
      const auto& comment = lines_[line].comment;
      if (comment && text_of({*comment, lines_[line].end}).find("cbc:") != std::string_view::npos) {
        return true;
      }
    }
    return false;
  }

  /// From the line with the dash to the last one that is deeper. Blank lines and comments after
  /// that belong to what follows.
  [[nodiscard]] std::optional<Span> lines_of(const Entry& entry) const {
    const Position& place = entry.list->items[entry.place]->range.begin;
    const std::size_t first = place.line - 1;
    const std::optional<std::size_t> depth = lines_[first].depth;
    const std::size_t dash = lines_[first].begin + depth.value_or(0) / 2;
    const std::size_t begin = positions_.offset(place);
    if (!depth || text_[dash] != '-' || dash >= begin || has_control_above(first) ||
        text_.find_first_not_of(" \t", dash + 1) != begin) {
      return std::nullopt;
    }
    const bool is_last = entry.place + 1 == entry.list->items.size();
    std::size_t end = first + 1;
    for (std::size_t next = end; next < lines_.size(); ++next) {
      const yaml::SourceLine& line = lines_[next];
      if (!line.has_content) continue;
      if (!line.depth || *line.depth > *depth) {
        end = next + 1;
        continue;
      }
      // What follows must be the next entry, or something else after the last one.
      const char byte = text_[line.begin + *line.depth / 2];
      const bool closes = byte == ',' || byte == ']' || byte == '}';
      if (closes || (*line.depth == *depth) == is_last) return std::nullopt;
      return Span{lines_[first].begin, lines_[end].begin};
    }
    if (!is_last) return std::nullopt;
    return Span{lines_[first].begin, end < lines_.size() ? lines_[end].begin : text_.size()};
  }

  /// With the comma before it; the first name with the one after it.
  [[nodiscard]] std::optional<Span> name_and_comma(const Entry& entry) const {
    const std::vector<const Node*>& items = entry.list->items;
    const bool are_names = std::all_of(items.begin(), items.end(), [](const Node* item) {
      return item->kind == Kind::scalar && !item->shared;
    });
    if (!are_names || items.size() < 2) return std::nullopt;
    const auto begin = [&](std::size_t place) {
      return positions_.offset(items[place]->range.begin);
    };
    const auto end = [&](std::size_t place) { return positions_.offset(items[place]->range.end); };
    const std::size_t second = std::max<std::size_t>(entry.place, 1);
    const Span gap{end(second - 1), begin(second)};
    if (gap.end < gap.begin || !is_one_comma(text_of(gap))) return std::nullopt;
    if (entry.place == 0) return Span{begin(0), begin(1)};
    const std::size_t after = text_.find_first_not_of(" \t\r\n", end(entry.place));
    if (after == std::string_view::npos || (text_[after] != ',' && text_[after] != ']')) {
      return std::nullopt;
    }
    return Span{gap.begin, end(entry.place)};
  }

  std::string_view text_;
  const PositionMap& positions_;
  const std::vector<yaml::SourceLine> lines_;
  std::map<Position, Entry> entries_;
};

/// An edit whose place in the text is known.
struct PlacedEdit {
  Span span;
  std::string_view text;
  const yaml::Node* list = nullptr;  ///< from which it removes an entry
};

/// All changes that mend one finding.
struct Fix {
  std::size_t finding = 0;
  std::vector<PlacedEdit> changes;  ///< at least one

  [[nodiscard]] bool removes() const { return changes.front().list != nullptr; }
};

bool has_removal(std::span<const Diagnostic> findings) {
  return std::any_of(findings.begin(), findings.end(), [](const Diagnostic& finding) {
    return std::any_of(finding.edits.begin(), finding.edits.end(),
                       [](const Edit& edit) { return edit.kind == Edit::Kind::remove_entry; });
  });
}

/// Finds the places of edits in a text.
class FixPlacement {
 public:
  /// `body` is the text without its byte order mark, as places are counted.
  FixPlacement(std::string_view text, std::string_view body, std::span<const Diagnostic> findings)
      : positions_(body) {
    if (!has_removal(findings)) return;
    Diagnostics ignored;
    document_ = yaml::parse(text, {}, ignored);
    if (document_ != nullptr) entries_.emplace(body, *document_, positions_);
  }

  /// The fix of a finding, or nothing if there is none that is safe.
  [[nodiscard]] std::optional<Fix> place(std::size_t number, const Diagnostic& finding) const {
    Fix fix;
    fix.finding = number;
    for (const Edit& edit : finding.edits) {
      const std::optional<PlacedEdit> change =
          edit.kind == Edit::Kind::replace ? replacement(edit) : removal(edit);
      if (!change) return std::nullopt;
      fix.changes.push_back(*change);
    }
    return fix.changes.empty() ? std::nullopt : std::optional(std::move(fix));
  }

 private:
  [[nodiscard]] std::optional<PlacedEdit> replacement(const Edit& edit) const {
    const Span span{positions_.offset(edit.range.begin), positions_.offset(edit.range.end)};
    if (span.begin >= span.end) return std::nullopt;
    return PlacedEdit{span, edit.text, nullptr};
  }

  [[nodiscard]] std::optional<PlacedEdit> removal(const Edit& edit) const {
    if (!entries_) return std::nullopt;
    const std::optional<EntrySpans::Entry> entry = entries_->find(edit.range.begin);
    if (!entry) return std::nullopt;
    const std::optional<Span> span = entries_->span_of(*entry);
    if (!span) return std::nullopt;
    return PlacedEdit{*span, {}, entry->list};
  }

  PositionMap positions_;
  std::unique_ptr<const yaml::Document> document_;
  std::optional<EntrySpans> entries_;
};

/// A set of changes that do not overlap.
class Selection {
 public:
  /// Whether a fix could be taken, or is no longer needed.
  bool take(const Fix& fix) {
    if (std::all_of(fix.changes.begin(), fix.changes.end(),
                    [this](const PlacedEdit& change) { return is_removed(change.span); })) {
      return true;
    }
    if (!std::all_of(fix.changes.begin(), fix.changes.end(),
                     [this](const PlacedEdit& change) { return is_possible(change); })) {
      return false;
    }
    for (const PlacedEdit& change : fix.changes) {
      changes_.emplace(change.span.begin, change);
      if (change.list != nullptr) ++removed_[change.list];
    }
    return true;
  }

  [[nodiscard]] std::string apply(std::string_view text) const {
    std::string result;
    std::size_t copied = 0;
    for (const auto& [begin, change] : changes_) {
      result += text.substr(copied, begin - copied);
      result += change.text;
      copied = change.span.end;
    }
    result += text.substr(copied);
    return result;
  }

 private:
  [[nodiscard]] bool is_removed(const Span& span) const {
    const auto next = changes_.upper_bound(span.begin);
    if (next == changes_.begin()) return false;
    const PlacedEdit& before = std::prev(next)->second;
    return before.list != nullptr && span.end <= before.span.end;
  }

  /// A list must keep an entry: an empty one means something else.
  [[nodiscard]] bool is_possible(const PlacedEdit& change) const {
    const auto next = changes_.lower_bound(change.span.begin);
    if (next != changes_.end() && next->first < change.span.end) return false;
    if (next != changes_.begin() && std::prev(next)->second.span.end > change.span.begin) {
      return false;
    }
    if (change.list == nullptr) return true;
    const auto removed = removed_.find(change.list);
    const std::size_t gone = removed == removed_.end() ? 0 : removed->second;
    return gone + 1 < change.list->items.size();
  }

  std::map<std::size_t, PlacedEdit> changes_;  // by their begin; they do not overlap
  std::map<const yaml::Node*, std::size_t> removed_;
};

/// Removals first, outer ones before inner ones; otherwise as given.
void order(std::vector<Fix>& fixes) {
  std::stable_sort(fixes.begin(), fixes.end(), [](const Fix& a, const Fix& b) {
    if (!a.removes() || !b.removes()) return a.removes() && !b.removes();
    const Span& x = a.changes.front().span;
    const Span& y = b.changes.front().span;
    return x.begin != y.begin ? x.begin < y.begin : x.end > y.end;
  });
}

/// Removes a line break at the end that is there only because the line after it was removed.
void drop_line_break(std::string& text) {
  if (!text.ends_with('\n')) return;
  text.pop_back();
  if (text.ends_with('\r')) text.pop_back();
}

}  // namespace

FixedText apply_fixes(std::string_view text, std::span<const Diagnostic> findings) {
  FixedText fixed;
  const std::string_view body = utf8::without_byte_order_mark(text);
  fixed.text = text.substr(0, text.size() - body.size());
  const FixPlacement placement(text, body, findings);
  std::vector<Fix> fixes;
  for (std::size_t number = 0; number < findings.size(); ++number) {
    if (auto fix = placement.place(number, findings[number])) fixes.push_back(std::move(*fix));
  }
  order(fixes);
  Selection selection;
  for (const Fix& fix : fixes) {
    if (selection.take(fix)) fixed.mended.push_back(fix.finding);
  }
  std::sort(fixed.mended.begin(), fixed.mended.end());
  fixed.text += selection.apply(body);
  if (!text.ends_with('\n')) drop_line_break(fixed.text);
  return fixed;
}

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

/// Finds the changes from front to back, piece by piece, each by the longest common subsequence of
/// the next lines of both texts. A piece ends where the texts agree again for a while. If they do
/// not do so soon, it is looked at again with more lines, up to a bound, so the work is linear even
/// where the texts have nothing in common.
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
