// Fixes are edits of bytes: what is not part of an edit stays as it is, comments, layout and line
// breaks included. An entry of a list is removed only if it is certain where it begins and ends and
// that nothing else is lost with it, such as a comment or an anchor; otherwise the finding stays.
// Edits that do not overlap are made together, removals first, outer ones before inner ones. The
// caller then lints the new text, fixes what has come up, and compares in the end what both texts
// mean.
//
// To change the tree and to write it anew would need no such care, but would lose comments and
// layout, and the diff of a fix would be one of the whole file.

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
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

constexpr std::string_view blanks_and_breaks = " \t\r\n";

/// Whether a comment for this program stands above a line: it would be about what follows.
bool has_control_above(std::string_view text, std::size_t line_begin) {
  std::string_view above = text.substr(0, line_begin);
  while (!above.empty()) {
    above.remove_suffix(1);                           // the line break
    const std::size_t begin = above.rfind('\n') + 1;  // 0 if there is none
    const std::string_view line = above.substr(begin);
    above = above.substr(0, begin);
    const std::size_t content = line.find_first_not_of(" \t\r");
    if (content == std::string_view::npos) continue;
    if (line[content] != '#') return false;
    if (line.find("cbc:", content) != std::string_view::npos) return true;
  }
  return false;
}

/// Whether a comment may stand in a piece of a text. Any '#' counts, since parsers differ in what
/// begins one.
bool may_have_comment(std::string_view text, const Span& span) {
  return text.substr(span.begin, span.end - span.begin).find('#') != std::string_view::npos;
}

/// A comma between two items, and nothing else but blanks and line breaks.
bool is_one_comma(std::string_view gap) {
  return std::count(gap.begin(), gap.end(), ',') == 1 &&
         std::all_of(gap.begin(), gap.end(),
                     [](char byte) { return byte == ',' || is_blank(byte); });
}

/// A line of a text: its indentation, and its first byte that is not blank, if there is one.
struct Line {
  std::size_t begin = 0;
  std::size_t end = 0;      ///< with its line break
  std::size_t content = 0;  ///< `end` if there is none
};

Line line_at(std::string_view text, std::size_t begin) {
  Line line;
  line.begin = begin;
  const std::size_t line_break = text.find('\n', begin);
  line.end = line_break == std::string_view::npos ? text.size() : line_break + 1;
  line.content = std::min(text.find_first_not_of(blanks_and_breaks, begin), line.end);
  return line;
}

bool is_dash(std::string_view text, std::size_t offset) {
  return text[offset] == '-' && (offset + 1 == text.size() || is_blank(text[offset + 1]));
}

/// Finds the piece of a text to delete for an entry of a list to be removed, and nothing else: the
/// lines of an entry with a dash; in brackets, the entry and one comma.
class EntrySpans {
 public:
  struct Entry {
    const yaml::Node* list = nullptr;
    std::size_t place = 0;  ///< among its items
  };

  /// `document` is that of `text`, which has no byte order mark; `positions` are those in it. All
  /// three must outlive this object.
  EntrySpans(std::string_view text, const yaml::Document& document, const PositionMap& positions);

  /// The entry that begins at a place. None if the place has more than one meaning because of
  /// aliases.
  [[nodiscard]] std::optional<Entry> find(const Position& begin) const;

  /// The piece to delete. None if a comment or an anchor would be deleted with it, or if the layout
  /// is unusual.
  [[nodiscard]] std::optional<Span> span_of(const Entry& entry) const;

 private:
  void index(const yaml::Node& node);
  [[nodiscard]] char first_byte(const yaml::Node& node) const;
  [[nodiscard]] bool is_in_brackets(const yaml::Node& node) const;
  [[nodiscard]] bool lies_within(const yaml::Node& node, const Span& span) const;
  [[nodiscard]] std::optional<std::size_t> end_of(const yaml::Node& node) const;
  [[nodiscard]] std::optional<Span> lines_of(const Entry& entry) const;
  [[nodiscard]] std::optional<Span> item_and_comma(const Entry& entry) const;

  std::string_view text_;
  const PositionMap& positions_;
  std::map<Position, Entry> entries_;
};

EntrySpans::EntrySpans(std::string_view text, const yaml::Document& document,
                       const PositionMap& positions)
    : text_(text), positions_(positions) {
  index(document.root());
}

void EntrySpans::index(const Node& node) {
  if (node.shared) return;
  for (std::size_t place = 0; place < node.items.size(); ++place) {
    const Node& item = *node.items[place];
    if (!item.shared) entries_[item.range.begin] = {&node, place};
    index(item);
  }
  for (const auto& entry : node.entries) index(*entry.second);
}

std::optional<EntrySpans::Entry> EntrySpans::find(const Position& begin) const {
  const auto found = entries_.find(begin);
  return found == entries_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<Span> EntrySpans::span_of(const Entry& entry) const {
  const std::optional<Span> span =
      is_in_brackets(*entry.list) ? item_and_comma(entry) : lines_of(entry);
  if (!span || may_have_comment(text_, *span)) return std::nullopt;
  if (!lies_within(*entry.list->items[entry.place], *span)) return std::nullopt;
  return span;
}

char EntrySpans::first_byte(const Node& node) const {
  const std::size_t begin = positions_.offset(node.range.begin);
  return begin < text_.size() ? text_[begin] : '\0';
}

bool EntrySpans::is_in_brackets(const Node& node) const {
  return first_byte(node) == '[' || first_byte(node) == '{';
}

/// Whether a value lies in a span as a whole. The target of an alias may be anywhere but in the
/// span, as it would be deleted with it.
bool EntrySpans::lies_within(const Node& node, const Span& span) const {
  const std::size_t begin = positions_.offset(node.range.begin);
  const bool begins_within = span.begin <= begin && begin < span.end;
  if (node.shared) return !begins_within;
  if (!begins_within) return false;
  if (node.kind == Kind::scalar) {
    // Where a block of text ends is not known.
    if (!node.plain && (first_byte(node) == '|' || first_byte(node) == '>')) return false;
    return positions_.offset(node.range.end) <= span.end;
  }
  if (node.kind != Kind::null && is_in_brackets(node)) {
    const std::optional<std::size_t> end = end_of(node);
    if (!end || *end > span.end) return false;
  }
  return std::all_of(node.items.begin(), node.items.end(),
                     [&](const Node* item) { return lies_within(*item, span); }) &&
         std::all_of(node.entries.begin(), node.entries.end(), [&](const auto& entry) {
           return lies_within(*entry.first, span) && lies_within(*entry.second, span);
         });
}

/// One past a scalar or a collection in brackets, if its end can be found.
std::optional<std::size_t> EntrySpans::end_of(const Node& node) const {
  if (node.shared || node.kind == Kind::null) return std::nullopt;
  if (node.kind == Kind::scalar) return positions_.offset(node.range.end);
  if (!is_in_brackets(node)) return std::nullopt;

  std::size_t end = positions_.offset(node.range.begin) + 1;
  if (!node.items.empty() || !node.entries.empty()) {
    const Node* last = node.items.empty() ? node.entries.back().second : node.items.back();
    // A value that is not written out has the place of its key.
    const bool is_missing = last->kind == Kind::null && !node.entries.empty() &&
                            last->range == node.entries.back().first->range;
    const std::optional<std::size_t> last_end =
        last->kind == Kind::null ? positions_.offset(last->range.end) : end_of(*last);
    if (!last_end || (last->kind == Kind::null && !node.items.empty())) return std::nullopt;
    end = yaml::find_content(text_, *last_end);
    if (is_missing && end < text_.size() && text_[end] == ':') ++end;
    end = yaml::find_content(text_, end);
    if (end < text_.size() && text_[end] == ',') ++end;
  }
  end = yaml::find_content(text_, end);
  const char bracket = node.kind == Kind::sequence ? ']' : '}';
  if (end >= text_.size() || text_[end] != bracket) return std::nullopt;
  return end + 1;
}

/// From the line with the dash to the last one that is indented deeper. Blank lines and comments
/// after that belong to what follows.
std::optional<Span> EntrySpans::lines_of(const Entry& entry) const {
  const std::size_t begin = positions_.offset(entry.list->items[entry.place]->range.begin);
  const Position line_begin{entry.list->items[entry.place]->range.begin.line, 1};
  const Line first = line_at(text_, positions_.offset(line_begin));
  const std::size_t dash = first.content;
  if (dash >= begin || !is_dash(text_, dash)) return std::nullopt;
  if (has_control_above(text_, first.begin)) return std::nullopt;
  if (text_.find_first_not_of(blanks_and_breaks, dash + 1) != begin) return std::nullopt;

  const std::size_t indentation = dash - first.begin;
  const bool is_last = entry.place + 1 == entry.list->items.size();
  std::size_t end = first.end;
  for (Line line = first; line.end < text_.size();) {
    line = line_at(text_, line.end);
    if (line.content == line.end || text_[line.content] == '#') continue;
    const std::size_t depth = line.content - line.begin;
    if (depth > indentation) {
      end = line.end;
      continue;
    }
    // What follows must be the next entry, or something else after the last one.
    const bool is_next = depth == indentation && is_dash(text_, line.content);
    const bool closes = std::string_view(",]}").find(text_[line.content]) != std::string_view::npos;
    if (is_next == is_last || closes) return std::nullopt;
    return Span{first.begin, end};
  }
  return is_last ? std::optional(Span{first.begin, end}) : std::nullopt;
}

/// With the comma before it; the first item with the one after it.
std::optional<Span> EntrySpans::item_and_comma(const Entry& entry) const {
  const std::vector<const Node*>& items = entry.list->items;
  const Node& item = *items[entry.place];
  const std::size_t begin = positions_.offset(item.range.begin);
  const std::optional<std::size_t> end = end_of(item);
  if (!end) return std::nullopt;
  if (entry.place == 0) {
    if (items.size() == 1 || items[1]->shared) return std::nullopt;
    const std::size_t next = positions_.offset(items[1]->range.begin);
    if (next < *end || !is_one_comma(text_.substr(*end, next - *end))) return std::nullopt;
    return Span{begin, next};
  }
  const std::optional<std::size_t> before = end_of(*items[entry.place - 1]);
  if (!before || *before > begin || !is_one_comma(text_.substr(*before, begin - *before))) {
    return std::nullopt;
  }
  const std::size_t after = text_.find_first_not_of(blanks_and_breaks, *end);
  if (after == std::string_view::npos || (text_[after] != ',' && text_[after] != ']')) {
    return std::nullopt;
  }
  return Span{*before, *end};
}

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

}  // namespace cbc
