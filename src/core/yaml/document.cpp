#include "core/yaml/document.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <unordered_set>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/yaml/source.h"
#include "runtime/base/text.h"

namespace cbc::yaml {

const Node* Node::find(std::string_view key) const {
  for (const auto& [name, value] : entries) {
    if (name->text == key) return value->kind == Kind::null ? nullptr : value;
  }
  return nullptr;
}

namespace {

constexpr std::string_view core_tag = "tag:yaml.org,2002:";

// Thrown to end the parsing of a document; becomes a finding.
struct Refusal : std::runtime_error {
  Refusal(const Range& where, const std::string& message, std::vector<Note> more = {})
      : std::runtime_error(message), range(where), notes(std::move(more)) {}
  Range range;
  std::vector<Note> notes;
};

constexpr std::string_view unclosed_text = "a text in quotes does not end";

std::string too_deep() {
  return "nested too deeply: more than " + std::to_string(maximum_depth) + " levels";
}

// Puts a message of yaml-cpp, which is about its grammar, in terms of the text. Its exceptions
// differ in nothing but their messages, which it declares as constants.
std::string explain(const std::string& message) {
  struct Explanation {
    std::string_view message;
    std::string_view meaning;
  };
  static const Explanation explanations[] = {
      {YAML::ErrorMsg::END_OF_MAP,
       "expected a key, or the end of the mapping: is the indentation right?"},
      {YAML::ErrorMsg::END_OF_SEQ,
       "expected '- ', or the end of the list: is the indentation right?"},
      {YAML::ErrorMsg::END_OF_MAP_FLOW, "expected ',' or '}' in a mapping in braces"},
      {YAML::ErrorMsg::END_OF_SEQ_FLOW, "expected ',' or ']' in a list in brackets"},
      {YAML::ErrorMsg::MAP_VALUE,
       "unexpected ':': is the indentation right? a value with ': ' in it must be in quotes"},
      {YAML::ErrorMsg::BLOCK_ENTRY, "unexpected '- ': is the indentation right?"},
      {YAML::ErrorMsg::MAP_KEY, "unexpected '? ': is the indentation right?"},
      {YAML::ErrorMsg::FLOW_END, "this bracket does not close the one that was opened last"},
      {YAML::ErrorMsg::DOC_IN_SCALAR,
       "a text in quotes does not end before '---' or '...' at the start of a line"},
      {YAML::ErrorMsg::UNKNOWN_TOKEN, "a value cannot begin with this character; put it in quotes"},
      {YAML::ErrorMsg::BAD_FILE, "cannot be read as YAML"},
  };
  for (const Explanation& explanation : explanations) {
    if (message == explanation.message) return std::string(explanation.meaning);
  }
  return message;
}

// Whether a line above that is no key with a value may be the cause of a message.
bool may_lack_colon(const std::string& message) {
  return message == YAML::ErrorMsg::MAP_VALUE || message == YAML::ErrorMsg::END_OF_MAP ||
         message == YAML::ErrorMsg::END_OF_SEQ;
}

bool is_null_text(std::string_view text) {
  return text.empty() || text == "~" || text == "null" || text == "Null" || text == "NULL";
}

}  // namespace

// Builds the tree from the events of the parser.
class Builder : public YAML::EventHandler {
 public:
  Builder(std::string_view text, const PositionMap& positions, Document& document, std::string file)
      : text_(text), positions_(positions), document_(document) {
    document_.file_ = std::move(file);
  }

  // Whether there was no event at all: the text is empty.
  [[nodiscard]] bool empty() const { return document_.root_ == nullptr; }

  void finish_empty() { document_.root_ = create(Kind::null, {}); }

  // Marks nodes that have several places in the tree, and all parts of mappings that merge others.
  void mark_shared() {
    std::unordered_set<const Node*> found;
    while (!shared_.empty()) {
      const Node* node = shared_.back();
      shared_.pop_back();
      if (!found.insert(node).second) continue;
      shared_.insert(shared_.end(), node->items.begin(), node->items.end());
      for (const auto& [key, value] : node->entries) {
        shared_.push_back(key);
        shared_.push_back(value);
      }
    }
    if (found.empty()) return;
    for (Node& node : document_.nodes_) node.shared = found.contains(&node);
  }

  [[nodiscard]] Range range_at(std::size_t begin, std::size_t end) const {
    const Position first = positions_.at(begin);
    const std::string_view within = text_.substr(std::min(begin, text_.size()), end - begin);
    if (end <= begin || within.find('\n') != std::string_view::npos) {
      return {first, positions_.at(std::max(begin, end))};
    }
    const auto characters = static_cast<std::uint32_t>(utf8::count_characters(within));
    return {first, {first.line, first.column + characters}};
  }

  // Possible start of the unfinished token.
  [[nodiscard]] std::size_t last_end() const { return last_end_; }

  // Where the innermost collection in brackets or braces begins that is still open.
  [[nodiscard]] std::optional<std::size_t> open_bracket() const {
    for (std::size_t i = frames_.size(); i > 0; --i) {
      const std::optional<std::size_t> bracket = frames_[i - 1].bracket;
      // A pair in a list, 'a: b' in '[a: b]', is a mapping without braces.
      if (bracket && (text_[*bracket] == '[' || text_[*bracket] == '{')) return bracket;
    }
    return std::nullopt;
  }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (!empty()) {
      const std::size_t at = offset(mark);
      const bool is_separated = text_.substr(std::min(at, text_.size()), 3) == "---";
      throw Refusal(range_at(at, at + 3),
                    is_separated ? "expected one document, found a second one"
                                 : "expected the end of the document: is the indentation right?");
    }
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const std::size_t begin = skip_properties(text_, offset(mark));
    const std::size_t end = end_of_null(text_, begin);
    const bool written = end > begin && begin >= last_end_;
    const Range range = written ? range_at(begin, end) : range_of_missing(offset(mark));
    if (written) last_end_ = end;
    add(create(Kind::null, range), anchor, {1, 0});
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    const ScalarExtent extent = extent_of_scalar(text_, offset(mark), value);
    // The parser accepts a text without its closing quote if a line break follows.
    if (!extent.closed)
      throw Refusal(range_at(extent.begin, extent.end), std::string(unclosed_text));
    last_end_ = std::max(last_end_, extent.end);
    add(create_scalar(range_at(extent.begin, extent.end), tag, extent.plain, value), anchor,
        {1, 0});
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const std::size_t begin = offset(mark);
    const std::size_t end = end_of_alias(text_, begin);
    last_end_ = std::max(last_end_, end);
    const Anchored& anchored = anchors_.at(anchor);
    if (anchored.node == nullptr) {
      throw Refusal(range_at(begin, end), "an alias stands within the value that it names");
    }
    alias_nodes_ += anchored.size.nodes;
    if (alias_nodes_ > maximum_alias_nodes) {
      throw Refusal(range_at(begin, end), "aliases stand for more than " +
                                              std::to_string(maximum_alias_nodes) + " values");
    }
    if (frames_.size() + anchored.size.height > maximum_depth) {
      throw Refusal(range_at(begin, end), too_deep());
    }
    alias_range_ = range_at(begin, end);
    shared_.push_back(anchored.node);
    add(anchored.node, 0, anchored.size);
    alias_range_.reset();
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override {
    open(Kind::sequence, mark, tag, "seq", anchor, style);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override {
    open(Kind::mapping, mark, tag, "map", anchor, style);
  }
  void OnMapEnd() override { close(); }

 private:
  // The size of a value with all its parts, aliases expanded.
  struct Size {
    std::size_t nodes = 0;
    std::size_t height = 0;  // levels of collections
  };
  struct Anchored {
    const Node* node = nullptr;  // nullptr until the value ends
    Size size;
  };
  struct Frame {
    Node* node = nullptr;
    YAML::anchor_t anchor = 0;
    std::optional<std::size_t> bracket;  // where a collection in brackets or braces begins
    const Node* key = nullptr;           // of a mapping, while its value is awaited
    const Node* merge_key = nullptr;
    std::vector<std::pair<const Node*, Range>> merges;  // mappings to merge, and where it says so
    std::size_t merge_at = 0;                           // place among the entries
    Size size{1, 1};
  };

  static std::size_t offset(const YAML::Mark& mark) {
    return mark.pos < 0 ? 0 : static_cast<std::size_t>(mark.pos);
  }

  static bool is_flow(YAML::EmitterStyle::value style) { return style == YAML::EmitterStyle::Flow; }

  Node* create(Kind kind, const Range& range) {
    Node& node = document_.nodes_.emplace_back();
    node.kind = kind;
    node.range = range;
    return &node;
  }

  const Node* create_scalar(const Range& range, std::string_view tag, bool plain,
                            const std::string& value) {
    if (tag == "?" || tag == "!") {
      Node* node = create(Kind::scalar, range);
      node->plain = tag == "?";
      node->text = value;
      return node;
    }
    const std::string_view name = tag.substr(std::min(core_tag.size(), tag.size()));
    const bool core = tag.substr(0, core_tag.size()) == core_tag;
    if (core && name == "null" && plain && is_null_text(value)) return create(Kind::null, range);
    if (core && (name == "str" || name == "int" || name == "float" || name == "bool")) {
      Node* node = create(Kind::scalar, range);
      node->plain = name != "str";
      node->text = value;
      return node;
    }
    throw Refusal(range, "unsupported tag " + quote(tag));
  }

  void open(Kind kind, const YAML::Mark& mark, std::string_view tag, std::string_view core_name,
            YAML::anchor_t anchor, YAML::EmitterStyle::value style) {
    const std::size_t begin = skip_properties(text_, offset(mark));
    const Range range = range_at(begin, begin + 1);
    if (frames_.size() >= maximum_depth) throw Refusal(range, too_deep());
    if (tag != "?" && tag != "!" && tag != std::string(core_tag).append(core_name)) {
      throw Refusal(range, "unsupported tag " + quote(tag));
    }
    refuse_as_key(range, is_flow(style) ? begin : text_.size());
    if (is_flow(style)) last_end_ = std::max(last_end_, begin + 1);
    register_anchor(anchor, {});
    Frame frame;
    frame.node = create(kind, range);
    frame.anchor = anchor;
    if (is_flow(style)) frame.bracket = begin;
    frames_.push_back(std::move(frame));
  }

  void close() {
    Frame frame = std::move(frames_.back());
    frames_.pop_back();
    if (!frame.merges.empty()) {
      merge(frame);
      shared_.push_back(frame.node);
    }
    add(frame.node, frame.anchor, frame.size);
  }

  void register_anchor(YAML::anchor_t anchor, const Anchored& anchored) {
    if (anchor == 0) return;
    if (anchors_.size() <= anchor) anchors_.resize(anchor + 1);
    anchors_[anchor] = anchored;
  }

  // Puts a finished value in its place.
  void add(const Node* node, YAML::anchor_t anchor, const Size& size) {
    register_anchor(anchor, {node, size});
    if (frames_.empty()) {
      document_.root_ = node;
      return;
    }
    Frame& frame = frames_.back();
    frame.size.nodes += size.nodes;
    frame.size.height = std::max(frame.size.height, size.height + 1);
    if (frame.node->kind == Kind::sequence) {
      frame.node->items.push_back(node);
    } else if (frame.key == nullptr && frame.merge_key == nullptr) {
      add_key(frame, node);
    } else if (frame.merge_key != nullptr) {
      add_merge(frame, node);
    } else {
      frame.node->entries.emplace_back(frame.key, node);
      frame.key = nullptr;
    }
  }

  [[nodiscard]] bool expects_key() const {
    return !frames_.empty() && frames_.back().node->kind == Kind::mapping &&
           frames_.back().key == nullptr && frames_.back().merge_key == nullptr;
  }

  // Refuses a collection in the place of a key. At the end of the text, the parser also takes an
  // unclosed collection in brackets for a key.
  void refuse_as_key(const Range& range, std::size_t bracket) const {
    if (!expects_key()) return;
    if (bracket < text_.size() && !is_closed(text_, bracket)) {
      throw Refusal(range, quote(text_.substr(bracket, 1)) + " is not closed");
    }
    throw Refusal(range, "a key must be a plain name, not a list or a mapping");
  }

  void add_key(Frame& frame, const Node* node) {
    if (node->kind != Kind::scalar) {
      const Range range = alias_range_.value_or(node->range);
      if (node->kind == Kind::null) throw Refusal(range, "a key is missing here, or is null");
      refuse_as_key(range, text_.size());
    }
    if (node->plain && node->text == "<<") {
      if (!frame.merges.empty()) {
        throw Refusal(node->range, "a second merge key '<<' in one mapping; merge a list instead");
      }
      frame.merge_key = node;
      frame.merge_at = frame.node->entries.size();
    } else {
      frame.key = node;
    }
  }

  void add_merge(Frame& frame, const Node* node) {
    const Range range = alias_range_.value_or(node->range);
    const std::vector<const Node*> single{node};
    for (const Node* source : node->kind == Kind::sequence ? node->items : single) {
      if (source->kind != Kind::mapping) {
        throw Refusal(range, "the merge key '<<' takes a mapping, or a list of mappings");
      }
      frame.merges.emplace_back(source, range);
    }
    frame.merge_key = nullptr;
  }

  // Inserts the keys of merged mappings that the mapping does not have itself in the place of '<<';
  // of equal ones, the first counts. They count as aliases, since they may multiply like these.
  void merge(const Frame& frame) {
    auto& entries = frame.node->entries;
    std::unordered_set<std::string_view> known;
    for (const auto& [key, value] : entries) known.insert(key->text);
    std::vector<std::pair<const Node*, const Node*>> merged;
    for (const auto& [source, range] : frame.merges) {
      alias_nodes_ += 2 * source->entries.size();
      if (alias_nodes_ > maximum_alias_nodes) {
        throw Refusal(range, "aliases stand for more than " + std::to_string(maximum_alias_nodes) +
                                 " values");
      }
      for (const auto& entry : source->entries) {
        if (known.insert(entry.first->text).second) merged.push_back(entry);
      }
    }
    entries.insert(entries.begin() + static_cast<std::ptrdiff_t>(frame.merge_at), merged.begin(),
                   merged.end());
  }

  // The place of a value that is not written out. The parser gives the place of what comes next;
  // the key, or the dash of the list item, says more.
  Range range_of_missing(std::size_t next) {
    if (frames_.empty()) return range_at(0, 0);
    const Frame& frame = frames_.back();
    if (frame.key != nullptr) return frame.key->range;
    if (frame.merge_key != nullptr) return frame.merge_key->range;
    if (frame.node->kind == Kind::sequence && !frame.bracket) {
      const std::size_t dash = find_dash(text_, last_end_);
      last_end_ = std::min(dash + 1, text_.size());
      return range_at(dash, dash + 1);
    }
    return range_at(next, next + 1);
  }

  std::string_view text_;
  const PositionMap& positions_;
  Document& document_;
  std::vector<Frame> frames_;
  std::vector<Anchored> anchors_;
  std::vector<const Node*> shared_;  // targets of aliases, and mappings that merge others
  std::size_t alias_nodes_ = 0;
  std::optional<Range> alias_range_;  // while an alias is being added
  std::size_t last_end_ = 0;          // end of the last token, as far as known
};

namespace {

// Whether YAML allows a character only as an escape.
bool is_forbidden(char32_t character) {
  if (character < 0x20) return character != '\t' && character != '\n' && character != '\r';
  return character >= 0x7F && character < 0xA0 && character != 0x85;
}

void check_characters(std::string_view text, const PositionMap& positions) {
  for (std::size_t offset = 0; offset < text.size();) {
    if ((text[offset] >= ' ' && text[offset] < 0x7F) || text[offset] == '\n') {
      ++offset;
      continue;
    }
    const utf8::Decoded decoded = utf8::decode(text, offset);
    const auto refuse = [&](const std::string& message) {
      const Position begin = positions.at(offset);
      throw Refusal({begin, {begin.line, begin.column + 1}}, message);
    };
    if (!decoded.valid || decoded.character == 0) {
      if (const std::string fault = fault_of_encoding(text); !fault.empty()) refuse(fault);
      refuse(decoded.valid ? "a NUL byte" : "not valid UTF-8");
    }
    if (is_forbidden(decoded.character)) {
      refuse("a control character: " + quote(text.substr(offset, decoded.bytes)));
    }
    // YAML says that it ends a line, the parser does not: readers would disagree about comments.
    if (decoded.character == '\r' && offset + 1 < text.size() && text[offset + 1] != '\n') {
      refuse("a carriage return without a line feed; end lines with a line feed");
    }
    offset += decoded.bytes;
  }
}

/// yaml-cpp keeps all tokens of a flow collection until it knows whether the collection is a
/// mapping key, so "[[[[..." would fill the memory before the first event. Texts with far too many
/// open brackets are refused; quotes and comments are not understood, hence the generous bound.
void check_brackets(std::string_view text, const PositionMap& positions) {
  constexpr std::size_t most_open = 100'000;
  std::size_t open = 0;
  std::size_t suspect = 0;  // where `open` last passed the allowed depth
  for (std::size_t offset = 0; offset < text.size(); ++offset) {
    const char byte = text[offset];
    if (byte == '[' || byte == '{') {
      if (++open == maximum_depth + 1) suspect = offset;
      if (open > most_open)
        throw Refusal({positions.at(suspect), positions.at(suspect + 1)}, too_deep());
    } else if ((byte == ']' || byte == '}') && open > 0) {
      --open;
    }
  }
}

[[noreturn]] void refuse(const YAML::Exception& exception, std::string_view text,
                         const std::string& file, const Builder& builder) {
  const auto offset = static_cast<std::size_t>(std::max(exception.mark.pos, 0));
  const std::size_t tab = find_indenting_tab(text, offset + 1);
  if (tab <= offset && tab < text.size() && text[tab] == '\t') {
    throw Refusal(builder.range_at(tab, tab + 1), "a tab may not indent; use spaces");
  }
  if (exception.msg == YAML::ErrorMsg::EOF_IN_SCALAR) {
    const std::size_t quote_at = find_quote(text, builder.last_end());
    throw Refusal(builder.range_at(quote_at, quote_at + 1), std::string(unclosed_text));
  }
  if (exception.msg.starts_with(YAML::ErrorMsg::UNKNOWN_ANCHOR)) {
    const std::size_t end = end_of_alias(text, offset);
    throw Refusal(builder.range_at(offset, end),
                  "there is no anchor " + quote(text.substr(offset + 1, end - offset - 1)));
  }
  if (exception.msg.starts_with(YAML::ErrorMsg::INVALID_UNICODE)) {
    // JSON writes such characters as two escapes, which the parser does not combine.
    throw Refusal(builder.range_at(offset, offset + 1),
                  "this escape is no character; write the character itself, or \\U and 8 digits");
  }
  // The parser comes upon an unclosed bracket only where the next lines do not fit into it.
  auto bracket = builder.open_bracket();
  // There are no events yet of a collection that may be a key.
  if (exception.msg == YAML::ErrorMsg::BLOCK_ENTRY) {
    bracket = find_open_bracket(text, bracket.value_or(builder.last_end()), offset);
  }
  if (bracket && exception.msg != YAML::ErrorMsg::FLOW_END && !is_closed(text, *bracket)) {
    const bool is_list = text[*bracket] == '[';
    throw Refusal(
        builder.range_at(*bracket, *bracket + 1),
        quote(text.substr(*bracket, 1)) + " is not closed",
        {{file, builder.range_at(offset, offset + 1),
          is_list ? "expected ',' or ']' before this" : "expected ',' or '}' before this"}});
  }
  if (may_lack_colon(exception.msg)) {
    const std::string_view line = find_line_without_key(text, offset);
    if (!line.empty()) {
      const auto begin = static_cast<std::size_t>(line.data() - text.data());
      throw Refusal(builder.range_at(begin, begin + line.size()),
                    "expected a key and a value: is ':' missing, or the space after it?");
    }
  }
  throw Refusal(builder.range_at(offset, offset + 1), explain(exception.msg));
}

void parse_document(std::string_view text, const PositionMap& positions, const std::string& file,
                    Document& document) {
  check_characters(text, positions);
  check_brackets(text, positions);
  std::istringstream stream{std::string(text)};
  Builder builder(text, positions, document, file);
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& exception) {
    refuse(exception, text, file, builder);
  }
  if (builder.empty()) builder.finish_empty();
  builder.mark_shared();
}

}  // namespace

std::string fault_of_encoding(std::string_view text) {
  using namespace std::string_view_literals;
  // The mark of UTF-32 may begin with that of UTF-16.
  if (text.starts_with("\xFF\xFE\0\0"sv) || text.starts_with("\0\0\xFE\xFF"sv)) {
    return "expected UTF-8, found UTF-32";
  }
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    return "expected UTF-8, found UTF-16";
  }
  // Without a mark, the zero bytes of the first ASCII characters show it.
  std::string zeros;
  for (const char byte : text.substr(0, 8)) zeros += byte == '\0' ? '0' : 'x';
  if (zeros == "x000x000" || zeros == "000x000x") return "expected UTF-8, found UTF-32";
  if (zeros == "x0x0x0x0" || zeros == "0x0x0x0x") return "expected UTF-8, found UTF-16";
  return {};
}

std::unique_ptr<const Document> parse(std::string_view text, std::string file,
                                      Diagnostics& diagnostics) {
  text = utf8::without_byte_order_mark(text);
  const PositionMap positions(text);
  auto document = std::make_unique<Document>();
  try {
    parse_document(text, positions, file, *document);
    return document;
  } catch (const Refusal& refusal) {
    diagnostics.add({rule::yaml_syntax, Severity::error, std::move(file), refusal.range,
                     refusal.what(), refusal.notes});
  }
  return nullptr;
}

}  // namespace cbc::yaml
