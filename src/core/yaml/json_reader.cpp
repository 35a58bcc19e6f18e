#include "core/yaml/document.h"
#include "runtime/base/text.h"

namespace cbc::yaml {
namespace {

/// The nodes of a longer text are given back, with all that they hold.
constexpr std::size_t longest_kept = std::size_t{1} << 14;

bool is_digit(char character) { return character >= '0' && character <= '9'; }

void append_utf8(std::string& text, std::uint32_t character) {
  const auto append = [&text](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (character < 0x80) {
    append(character);
  } else if (character < 0x800) {
    append(0xC0 | character >> 6);
    append(0x80 | (character & 0x3F));
  } else if (character < 0x10000) {
    append(0xE0 | character >> 12);
    append(0x80 | (character >> 6 & 0x3F));
    append(0x80 | (character & 0x3F));
  } else {
    append(0xF0 | character >> 18);
    append(0x80 | (character >> 12 & 0x3F));
    append(0x80 | (character >> 6 & 0x3F));
    append(0x80 | (character & 0x3F));
  }
}

}  // namespace

const Node* JsonReader::read(std::string_view text, std::uint32_t line) {
  if (text_.size() > longest_kept) nodes_.clear();
  text_ = utf8::without_byte_order_mark(text);
  at_ = 0;
  line_ = line;
  used_ = 0;
  has_merge_key_ = false;
  if (utf8::find_invalid(text)) return nullptr;
  const Node* const root = read_value(1);
  skip_space();
  return at_ == text_.size() ? root : nullptr;
}

std::string JsonReader::fault() const {
  std::string fault = fault_of_encoding(text_);
  return fault.empty() ? "it is not JSON, or it is damaged" : fault;
}

/// Null after a mistake.
const Node* JsonReader::read_value(std::size_t depth) {
  skip_space();
  if (at_ == text_.size() || depth > maximum_depth) return nullptr;
  Node& node = make_node(Kind::scalar);
  bool is_read = false;
  switch (text_[at_]) {
    case '{':
      is_read = read_mapping(node, depth);
      break;
    case '[':
      is_read = read_sequence(node, depth);
      break;
    case '"':
      is_read = read_string(node.text);
      break;
    case 'n':
      node.kind = Kind::null;
      is_read = read_word("null");
      break;
    case 't':
    case 'f':
      node.plain = true;
      node.text = text_[at_] == 't' ? "true" : "false";
      is_read = read_word(node.text);
      break;
    default:
      node.plain = true;
      is_read = read_number(node.text);
  }
  if (!is_read) return nullptr;
  end_range(node);
  return &node;
}

bool JsonReader::read_mapping(Node& node, std::size_t depth) {
  node.kind = Kind::mapping;
  ++at_;
  skip_space();
  if (take('}')) return true;
  for (;;) {
    skip_space();
    Node& key = make_node(Kind::scalar);
    if (at_ == text_.size() || text_[at_] != '"' || !read_string(key.text)) return false;
    if (key.text == "<<") has_merge_key_ = true;
    end_range(key);
    skip_space();
    if (!take(':')) return false;
    const Node* const value = read_value(depth + 1);
    if (value == nullptr) return false;
    node.entries.emplace_back(&key, value);
    skip_space();
    if (take('}')) return true;
    if (!take(',')) return false;
  }
}

bool JsonReader::read_sequence(Node& node, std::size_t depth) {
  node.kind = Kind::sequence;
  ++at_;
  skip_space();
  if (take(']')) return true;
  for (;;) {
    const Node* const item = read_value(depth + 1);
    if (item == nullptr) return false;
    node.items.push_back(item);
    skip_space();
    if (take(']')) return true;
    if (!take(',')) return false;
  }
}

bool JsonReader::read_string(std::string& value) {
  ++at_;
  for (;;) {
    const std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != '"' && text_[at_] != '\\' &&
           static_cast<unsigned char>(text_[at_]) >= ' ') {
      ++at_;
    }
    value += text_.substr(begin, at_ - begin);
    if (at_ == text_.size()) return false;
    if (take('"')) return true;
    if (!take('\\') || !read_escape(value)) return false;
  }
}

bool JsonReader::read_escape(std::string& value) {
  if (at_ == text_.size()) return false;
  constexpr std::string_view letters = "\"\\/bfnrt";
  constexpr std::string_view meanings = "\"\\/\b\f\n\r\t";
  const char letter = text_[at_++];
  if (const std::size_t place = letters.find(letter); place != std::string_view::npos) {
    value += meanings[place];
    return true;
  }
  std::uint32_t character = 0;
  if (letter != 'u' || !read_hex(character)) return false;
  if (character >= 0xD800 && character < 0xE000) {
    std::uint32_t second = 0;
    if (character >= 0xDC00 || !take('\\') || !take('u') || !read_hex(second)) return false;
    if (second < 0xDC00 || second >= 0xE000) return false;
    character = 0x10000 + ((character - 0xD800) << 10) + (second - 0xDC00);
  }
  append_utf8(value, character);
  return true;
}

bool JsonReader::read_hex(std::uint32_t& unit) {
  for (int place = 0; place < 4; ++place) {
    if (at_ == text_.size()) return false;
    const char digit = text_[at_++];
    const char lower = static_cast<char>(digit | 0x20);
    if (!is_digit(digit) && (lower < 'a' || lower > 'f')) return false;
    unit = unit << 4 | static_cast<std::uint32_t>(is_digit(digit) ? digit - '0' : lower - 'a' + 10);
  }
  return true;
}

bool JsonReader::read_number(std::string& value) {
  const std::size_t begin = at_;
  const auto read_digits = [this] {
    const std::size_t first = at_;
    while (at_ < text_.size() && is_digit(text_[at_])) ++at_;
    return at_ > first;
  };
  static_cast<void>(take('-'));
  if (!take('0') && !read_digits()) return false;
  if (take('.') && !read_digits()) return false;
  if (take('e') || take('E')) {
    if (!take('+')) static_cast<void>(take('-'));
    if (!read_digits()) return false;
  }
  value = text_.substr(begin, at_ - begin);
  return true;
}

bool JsonReader::read_word(std::string_view word) {
  if (text_.substr(at_, word.size()) != word) return false;
  at_ += word.size();
  return true;
}

void JsonReader::skip_space() {
  const auto is_space = [](char character) {
    return character == ' ' || character == '\t' || character == '\r' || character == '\n';
  };
  while (at_ < text_.size() && is_space(text_[at_])) ++at_;
}

bool JsonReader::take(char character) {
  if (at_ == text_.size() || text_[at_] != character) return false;
  ++at_;
  return true;
}

Node& JsonReader::make_node(Kind kind) {
  if (used_ == nodes_.size()) nodes_.push_back(std::make_unique<Node>());
  Node& node = *nodes_[used_++];
  node.kind = kind;
  node.plain = false;
  node.text.clear();
  node.items.clear();
  node.entries.clear();
  node.range.begin = {line_, static_cast<std::uint32_t>(at_ + 1)};
  return node;
}

void JsonReader::end_range(Node& node) const {
  node.range.end = {line_, static_cast<std::uint32_t>(at_ + 1)};
}

}  // namespace cbc::yaml
