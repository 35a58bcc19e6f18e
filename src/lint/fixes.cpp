#include "lint/fixes.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "lint/entry_spans.h"
#include "text/position_map.h"
#include "text/utf8.h"
#include "yaml/document.h"

namespace cbc {
namespace {

/// An edit whose place in the text is known.
struct Change {
  Span span;
  std::string_view text;
  const yaml::Node* list = nullptr;  ///< from which it removes an entry
};

/// All that mends one finding.
struct Fix {
  std::size_t finding = 0;
  std::vector<Change> changes;  ///< at least one

  [[nodiscard]] bool removes() const { return changes.front().list != nullptr; }
};

bool has_removal(std::span<const Diagnostic> findings) {
  return std::any_of(findings.begin(), findings.end(), [](const Diagnostic& finding) {
    return std::any_of(finding.edits.begin(), finding.edits.end(),
                       [](const Edit& edit) { return edit.kind == Edit::Kind::remove_entry; });
  });
}

/// Finds the places of edits in a text.
class Placement {
 public:
  /// `body` is the text without its byte order mark, as places are counted.
  Placement(std::string_view text, std::string_view body, std::span<const Diagnostic> findings)
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
      const std::optional<Change> change =
          edit.kind == Edit::Kind::replace ? replacement(edit) : removal(edit);
      if (!change) return std::nullopt;
      fix.changes.push_back(*change);
    }
    return fix.changes.empty() ? std::nullopt : std::optional(std::move(fix));
  }

 private:
  [[nodiscard]] std::optional<Change> replacement(const Edit& edit) const {
    const Span span{positions_.offset(edit.range.begin), positions_.offset(edit.range.end)};
    if (span.begin >= span.end) return std::nullopt;
    return Change{span, edit.text, nullptr};
  }

  [[nodiscard]] std::optional<Change> removal(const Edit& edit) const {
    if (!entries_) return std::nullopt;
    const std::optional<EntrySpans::Entry> entry = entries_->find(edit.range.begin);
    if (!entry) return std::nullopt;
    const std::optional<Span> span = entries_->span_of(*entry);
    if (!span) return std::nullopt;
    return Change{*span, {}, entry->list};
  }

  PositionMap positions_;
  std::unique_ptr<const yaml::Document> document_;
  std::optional<EntrySpans> entries_;
};

/// The changes that do not get in the way of one another.
class Selection {
 public:
  /// Whether a fix could be taken, or is not needed any more.
  bool take(const Fix& fix) {
    if (std::all_of(fix.changes.begin(), fix.changes.end(),
                    [this](const Change& change) { return is_removed(change.span); })) {
      return true;
    }
    if (!std::all_of(fix.changes.begin(), fix.changes.end(),
                     [this](const Change& change) { return is_possible(change); })) {
      return false;
    }
    for (const Change& change : fix.changes) {
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
    const Change& before = std::prev(next)->second;
    return before.list != nullptr && span.end <= before.span.end;
  }

  /// A list must keep an entry: an empty one is something else.
  [[nodiscard]] bool is_possible(const Change& change) const {
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

  std::map<std::size_t, Change> changes_;  // by their begin; they do not overlap
  std::map<const yaml::Node*, std::size_t> removed_;
};

/// Removals first, what is around others before them; otherwise as given.
void order(std::vector<Fix>& fixes) {
  std::stable_sort(fixes.begin(), fixes.end(), [](const Fix& a, const Fix& b) {
    if (!a.removes() || !b.removes()) return a.removes() && !b.removes();
    const Span& x = a.changes.front().span;
    const Span& y = b.changes.front().span;
    return x.begin != y.begin ? x.begin < y.begin : x.end > y.end;
  });
}

/// Takes the line break off that became the last one because the line after it was removed.
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
  const Placement placement(text, body, findings);
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
