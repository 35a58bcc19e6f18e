#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string_view>

#include "cbc/diagnostic.h"
#include "text/position_map.h"
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

}  // namespace cbc
