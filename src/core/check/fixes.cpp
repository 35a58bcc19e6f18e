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
#include <string_view>
#include <utility>
#include <vector>

#include "core/check/check.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"
#include "core/yaml/edits.h"
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
    std::vector<yaml::TextEdit> edits;
    for (const auto& [begin, change] : changes_) edits.push_back({change.span, change.text});
    return yaml::apply_edits(text, edits);
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
