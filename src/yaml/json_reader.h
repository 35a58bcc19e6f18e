#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

#include "yaml/document.h"

namespace cbc::yaml {

/// Reads JSON texts, one after the other, into the tree that the YAML parser gives for them, in a
/// hundredth of its time: the nodes are kept and used again.
class JsonReader {
 public:
  /// The root of the tree, which is valid until the next call; nullptr if the text is no JSON, or
  /// deeper than YAML may be: then the YAML parser has the last word. All ranges lie in `line`;
  /// their columns count bytes.
  [[nodiscard]] const Node* read(std::string_view text, std::uint32_t line);

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
  std::deque<Node> nodes_;
  std::size_t used_ = 0;
};

}  // namespace cbc::yaml
