#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "diagnostic/diagnostic.h"
#include "yaml/document.h"

namespace cbc {

/// A piece of a text in bytes; `end` is one past the last.
struct Span {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Finds what has to go from a text to remove an entry of a list and nothing else: the lines of an
/// entry with a dash; in brackets, the entry and one comma.
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

  /// What has to go. Nothing if a comment or an anchor would go with it, or the layout is not a
  /// usual one.
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

struct FixedText {
  std::string text;
  /// Places in the findings given, ascending, of those that are mended. The others have no edits,
  /// or it is not safe to apply them, or they are in the way of one another.
  std::vector<std::size_t> mended;
};

/// Applies the edits of findings about a text: for each finding all of them, or none. Nothing else
/// is changed: comments, order, layout, line breaks, a byte order mark, and whether the last line
/// has a line break stay as they are. What stands in a removed entry is mended with it. Removals
/// come first; of edits that overlap otherwise those of the first finding count.
///
/// Mended text may have new findings with edits: repeat it until nothing is mended. It ends, as
/// each time the text has fewer entries or fewer older names.
[[nodiscard]] FixedText apply_fixes(std::string_view text, std::span<const Diagnostic> findings);

/// The difference of two texts in the unified format, with three lines of context, as `patch -p1`
/// and `git apply` take it; empty if there is none. `file` is the name in its head. The work is
/// bounded: where much has changed in one place the difference may not be the shortest.
[[nodiscard]] std::string unified_diff(std::string_view before, std::string_view after,
                                       std::string_view file);

}  // namespace cbc
