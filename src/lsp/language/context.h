#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Where a cursor is in YAML text that need not parse.
namespace cbc::lsp {

/// A place is that of a key, of the value of a key, of an item of a list, or none of these: in a
/// comment, after a complete value, in the indentation of a line. Texts are without quotes.
struct Context {
  /// The keys from the root to the innermost mapping or list that has the cursor; "" stands for an
  /// item of a list.
  std::vector<std::string> path;
  bool is_key = false;     ///< a key stands, or may begin, at the cursor
  bool has_colon = false;  ///< of a key
  std::string key;         ///< whose value has the cursor; otherwise empty
  bool is_item = false;
  /// A value, or an item, that stands where a mapping in lines of its own may begin instead.
  bool is_open = false;
  bool is_flow = false;   ///< the cursor is in brackets
  std::size_t entry = 0;  ///< where the entry of the outermost list begins that has the cursor
  bool is_json = false;   ///< the whole text is in brackets, with keys in double quotes
  /// Bytes of the scalar at the cursor, with its quotes; equal if there is none yet.
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string text;
  std::vector<std::string> siblings;  ///< the other keys of the same mapping
  /// On a line that has no complete key: the key of this mapping to whose list an item may be added
  /// here, with a dash.
  std::string list_key;
  /// The keys before the cursor, with values that are scalars, of the mapping in which the
  /// innermost mapping stands.
  std::vector<std::pair<std::string, std::string>> outer;
};

/// `offset` is a byte of the text, or its end. Takes a time linear in the text. Of a text with
/// several documents, the one that has the cursor counts.
[[nodiscard]] Context context_at(std::string_view text, std::size_t offset);

/// The place of each scalar, in the order of the text, without `siblings` and `outer`. Passes over
/// what is nested deeper than 64 mappings and lists; a key of more than 1000 bytes is "..." in
/// paths.
void visit_scalars(std::string_view text, const std::function<void(const Context&)>& visit);

}  // namespace cbc::lsp
