// A YAML or JSON text as a tree that can be changed and written again. Comments, anchors and layout
// are lost.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/yaml/document.h"
#include "fuzz/target.h"
#include "property/random.h"

namespace cbc::fuzz {

struct Tree {
  yaml::Kind kind = yaml::Kind::null;
  bool plain = false;       ///< a scalar without quotes
  std::string text;         ///< of a scalar
  std::vector<Tree> items;  ///< of a mapping: key, value, key, value...
};

/// Empty if the text cannot be parsed, or has very many nodes.
[[nodiscard]] std::optional<Tree> read_tree(std::string_view text);

/// Valid, whatever the scalars are: YAML in block style with entries in braces, JSON on one line.
[[nodiscard]] std::string write_tree(const Tree& tree, Language language);

/// Makes one change. `words` come in the place of keys and values; it must not be empty.
/// `mutate_bytes` changes the text of a scalar.
using MutateBytes = std::string (*)(std::string text, std::size_t most);
void change_tree(Tree& tree, oracle::Random& random, const std::vector<std::string>& words,
                 MutateBytes mutate_bytes);

}  // namespace cbc::fuzz
