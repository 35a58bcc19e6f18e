#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cbc/diagnostic.h"

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
  /// All nodes, also those that the root no longer reaches; scalars in the order of the text.
  [[nodiscard]] const std::vector<std::unique_ptr<Node>>& nodes() const { return nodes_; }

 private:
  friend class Builder;
  std::string file_;
  std::vector<std::unique_ptr<Node>> nodes_;
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

}  // namespace cbc::yaml
