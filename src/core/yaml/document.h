#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/diagnostic/diagnostic.h"

/// YAML as a tree that remembers where everything stands and keeps duplicate keys.
namespace cbc::yaml {

enum class Kind : std::uint8_t { null, scalar, sequence, mapping };

struct Node {
  Kind kind = Kind::null;
  bool plain = false;              ///< a scalar without quotes, which may be a number or a boolean
  bool shared = false;             ///< an alias or a merge key '<<' gives it more than one meaning
  Range range;                     ///< for collections: the first character only
  std::string text;                ///< of a scalar
  std::vector<const Node*> items;  ///< of a sequence
  std::vector<std::pair<const Node*, const Node*>>
      entries;  ///< of a mapping, in order, all of them

  /// The first value of `key`, or nullptr if there is none or it is null.
  [[nodiscard]] const Node* find(std::string_view key) const;
};

/// Owns the nodes of one file. Aliases share the node of their anchor.
class Document {
 public:
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] const Node& root() const { return *root_; }
  /// All nodes, including those that the root does not reach; scalars in the order of the text.
  [[nodiscard]] const std::deque<Node>& nodes() const { return nodes_; }

 private:
  friend class Builder;
  std::string file_;
  std::deque<Node> nodes_;
  const Node* root_ = nullptr;
};

/// Nesting deeper than this is refused.
inline constexpr std::size_t maximum_depth = 64;
/// Aliases that stand for more nodes than this, all together, are refused.
inline constexpr std::size_t maximum_alias_nodes = 100'000;

/// Parses one YAML document. Returns nullptr, and an error in `diagnostics`, if `text` is not valid
/// UTF-8, not YAML, more than one document, too deep, or an alias bomb.
[[nodiscard]] std::unique_ptr<const Document> parse(std::string_view text, std::string file,
                                                    Diagnostics& diagnostics);

/// What is wrong with a text in another encoding of Unicode, by its first bytes: "expected UTF-8,
/// found UTF-16". Empty if they show none.
[[nodiscard]] std::string fault_of_encoding(std::string_view text);

/// Reads JSON texts, one after the other, into the tree that the YAML parser gives for them, in a
/// hundredth of its time: the nodes are kept and used again.
class JsonReader {
 public:
  /// The root of the tree, which is valid until the next call; nullptr if the text is no JSON, or
  /// deeper than YAML may be: then the YAML parser has the last word. All ranges lie in `line`;
  /// their columns count bytes.
  [[nodiscard]] const Node* read(std::string_view text, std::uint32_t line = 1);
  /// After a text that is no JSON, while it is still there: why, as far as a few words can tell.
  [[nodiscard]] std::string fault() const;
  /// Whether the text has a key '<<', which merges mappings in YAML and is a name in JSON.
  [[nodiscard]] bool has_merge_key() const { return has_merge_key_; }

 private:
  [[nodiscard]] const Node* read_value(std::size_t depth);
  [[nodiscard]] bool read_mapping(Node& node, std::size_t depth);
  [[nodiscard]] bool read_sequence(Node& node, std::size_t depth);
  [[nodiscard]] bool read_string(std::string& value);
  [[nodiscard]] bool read_escape(std::string& value);
  [[nodiscard]] bool read_hex(std::uint32_t& unit);
  [[nodiscard]] bool read_number(std::string& value);
  [[nodiscard]] bool read_word(std::string_view word);
  void skip_space();
  [[nodiscard]] bool take(char character);
  [[nodiscard]] Node& make_node(Kind kind);
  void end_range(Node& node) const;

  std::string_view text_;
  std::size_t at_ = 0;
  std::uint32_t line_ = 1;
  bool has_merge_key_ = false;
  std::vector<std::unique_ptr<Node>> nodes_;
  std::size_t used_ = 0;
};

}  // namespace cbc::yaml
