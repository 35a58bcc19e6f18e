// A scanner that reads the text once, and keeps the mappings and lists that are open where it is.
// What is not valid YAML it takes for what somebody is about to write: a mapping in brackets ends
// where a line begins an entry of the block that it stands in, a quote at the end of its line
// unless the text goes on sensibly where it is closed.
//
// The YAML parser stops at the first mistake, and a text with a cursor in it mostly has one there.

#include "lsp/language/context.h"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"
#include "core/yaml/source.h"
#include "runtime/base/text.h"

namespace cbc::lsp {
namespace {

using yaml::Span;

/// More than any text has that cbc reads; see yaml::maximum_depth.
constexpr std::size_t most_frames = 200;

// Where each scalar is visited, its path is made anew; so that takes little time in any text.
constexpr std::size_t most_visited_frames = 64;
constexpr std::size_t longest_visited_key = 1000;

/// What comes next in a mapping or list.
enum class Next : std::uint8_t { entry, value, nothing };

/// A mapping or list that is not closed yet.
struct Frame {
  struct Entry {
    Span key;
    Span value;  ///< empty unless it is a scalar
  };
  bool is_list = false;
  bool is_flow = false;
  bool is_implicit = false;  ///< a mapping without braces in a list in brackets
  std::size_t column = 0;    ///< of a block
  std::size_t entry = 0;     ///< where the present entry of a list begins
  Next next = Next::entry;
  std::vector<Entry> entries = {};  ///< of a mapping
};

class Scanner {
 public:
  Scanner(std::string_view text, std::size_t cursor)
      : text_(text), cursor_(std::min(cursor, text.size())) {}
  /// There is no cursor, and each scalar is visited.
  Scanner(std::string_view text, const std::function<void(const Context&)>& visit)
      : text_(text), cursor_(std::string_view::npos), visit_(&visit) {}

  Context scan() && {
    at_ = text_.size() - utf8::without_byte_order_mark(text_).size();
    cursor_ = std::max(cursor_, at_);
    gap_ = line_ = at_;
    // Behind the cursor only its siblings are of interest.
    while (at_ < text_.size() && !is_over_ && (at_ <= cursor_ || watched_ > 0)) {
      if (is_in_flow()) {
        scan_flow();
      } else {
        line_ = at_;
        scan_line();
      }
    }
    if (cursor_ == text_.size() && at_ == cursor_ && gap_ == cursor_ && !is_found_) {
      is_in_flow() ? note_gap(at_) : note_blank(0);
    }
    while (!frames_.empty()) pop();
    return std::move(result_);
  }

 private:
  // The text --------------------------------------------------------------------------------------

  [[nodiscard]] char byte(std::size_t at) const { return at < text_.size() ? text_[at] : '\n'; }
  [[nodiscard]] bool is_blank_at(std::size_t at) const { return yaml::is_blank(byte(at)); }
  [[nodiscard]] bool is_line_end(std::size_t at) const {
    return byte(at) == '\n' || (byte(at) == '\r' && byte(at + 1) == '\n');
  }
  [[nodiscard]] std::size_t skip_spaces(std::size_t at) const {
    while (!is_line_end(at) && is_blank_at(at)) ++at;
    return at;
  }
  [[nodiscard]] bool begins_comment(std::size_t at) const {
    return byte(at) == '#' && (at == line_ || is_blank_at(at - 1));
  }
  [[nodiscard]] static bool is_one_of(char byte, std::string_view bytes) {
    return bytes.find(byte) != std::string_view::npos;
  }
  [[nodiscard]] bool is_dash(std::size_t at) const {
    return byte(at) == '-' && is_blank_at(at + 1);
  }
  /// Past anchors and tags.
  [[nodiscard]] std::size_t skip_properties(std::size_t at) const {
    while (byte(at) == '&' || byte(at) == '!') {
      while (!is_blank_at(at) && !(is_in_flow() && is_one_of(byte(at), ",[]{}"))) ++at;
      at = skip_spaces(at);
    }
    return at;
  }

  [[nodiscard]] bool is_quote(std::size_t at) const { return is_one_of(byte(at), "\"'"); }

  /// Whether the colon of a key stands here. That of a key in quotes needs no blank in brackets.
  [[nodiscard]] bool is_colon(std::size_t at, bool has_quotes = false) const {
    const bool is_end = is_in_flow() && (has_quotes || is_one_of(byte(at + 1), ",[]{}"));
    return byte(at) == ':' && (is_end || is_blank_at(at + 1));
  }

  [[nodiscard]] Span scalar_at(std::size_t at, bool ends_at_colon) const {
    return {at, is_quote(at) ? end_of_quoted(at) : end_of_plain(at, ends_at_colon)};
  }

  /// Where a plain scalar ends on its line, without blanks at its end.
  [[nodiscard]] std::size_t end_of_plain(std::size_t at, bool ends_at_colon) const {
    std::size_t end = at;
    for (; !is_line_end(at); ++at) {
      const char here = byte(at);
      if (here == '#' && at > end) break;
      if (is_in_flow() && is_one_of(here, ",[]{}")) break;
      if (ends_at_colon && is_colon(at)) break;
      if (!yaml::is_blank(here)) end = at + 1;
    }
    return end;
  }

  /// The same of one that may go on in the next lines; those of a block are deeper.
  [[nodiscard]] std::size_t end_of_plain_lines(std::size_t end) const {
    while (true) {
      std::size_t at = skip_spaces(end);
      if (!is_line_end(at)) return end;
      std::size_t line = at;
      while (at < text_.size() && is_line_end(at)) {
        line = yaml::end_of_line(text_, at) + 1;
        at = skip_spaces(line);
      }
      const bool goes_on = is_in_flow() ? !is_one_of(byte(at), ",[]{}#:\"'") && !begins_entry(at)
                                        : !frames_.empty() && at - line > frames_.back().column &&
                                              byte(at) != '#' && (is_dash(at) || !begins_entry(at));
      if (at >= text_.size() || !goes_on) return end;
      end = end_of_plain(at, is_in_flow());
    }
  }

  /// Whether a line, whose content begins here, begins an entry of a block: "- ", or "key: ".
  [[nodiscard]] bool begins_entry(std::size_t at) const {
    if (is_dash(at)) return true;
    if (is_quote(at)) return is_colon(skip_spaces(end_of_quoted(at)));
    for (; !is_line_end(at); ++at) {
      if (is_one_of(byte(at), ",[]{}#")) return false;
      if (is_colon(at)) return true;
    }
    return false;
  }

  /// One past the closing quote; the end of the line if that is missing.
  [[nodiscard]] std::size_t end_of_quoted(std::size_t begin) const {
    const char quote = byte(begin);
    std::optional<std::size_t> line_end;
    for (std::size_t at = begin + 1; at < text_.size(); ++at) {
      if (byte(at) == '\n' && !line_end) line_end = at;
      if (byte(at) == '\\' && quote == '"') {
        ++at;
      } else if (byte(at) == quote && quote == '\'' && byte(at + 1) == quote) {
        ++at;
      } else if (byte(at) == quote) {
        const std::size_t next = at + 1;
        const bool goes_on = is_blank_at(next) || is_one_of(byte(next), ",]}:");
        if (line_end && !goes_on) break;
        return next;
      }
    }
    std::size_t end = line_end.value_or(yaml::end_of_line(text_, begin));
    while (end > begin + 1 && is_blank_at(end - 1)) --end;
    return end;
  }

  [[nodiscard]] std::string text_of(const Span& span) const {
    const std::string_view raw = text_.substr(span.begin, span.end - span.begin);
    if (raw.empty()) return {};
    const bool is_quoted = is_one_of(raw.front(), "\"'");
    if (is_quoted && raw.size() > 1 && raw.back() == raw.front()) {
      const std::string_view inner = raw.substr(1, raw.size() - 2);
      const std::string_view special = raw.front() == '"' ? "\\\n" : "'\n";
      if (inner.find_first_of(special) == std::string_view::npos) return std::string(inner);
    } else if (!is_quoted && raw.find('\n') == std::string_view::npos) {
      return std::string(raw);
    }
    Diagnostics ignored;
    const auto document = yaml::parse(concat(raw, "\n"), {}, ignored);
    if (document != nullptr && document->root().items.empty()) return document->root().text;
    return std::string(raw.substr(is_quoted ? 1 : 0));
  }

  // Mappings and lists ----------------------------------------------------------------------------

  [[nodiscard]] bool is_in_flow() const { return !frames_.empty() && frames_.back().is_flow; }

  void push(Frame frame) {
    if (frames_.size() == most_frames) {
      result_ = {};
      watched_ = 0;
      is_over_ = true;
    }
    if (!frames_.empty()) frames_.back().next = Next::nothing;
    frames_.push_back(std::move(frame));
  }

  void pop() {
    if (watched_ == frames_.size()) {
      for (const Frame::Entry& entry : frames_.back().entries) {
        if (entry.key.begin != own_key_) result_.siblings.push_back(text_of(entry.key));
      }
      watched_ = 0;
      is_over_ = true;
    }
    frames_.pop_back();
  }

  /// Closes what ends before a key at a column.
  void pop_to(std::size_t column) {
    while (!frames_.empty()) {
      const std::size_t top = frames_.size() - 1;
      const bool is_before = frames_[top].column < column;
      if (is_before || (frames_[top].column == column && !has_key_above(top))) return;
      pop();
    }
  }

  void add_key(const Span& key, bool has_colon) {
    frames_.back().entries.push_back({key, {}});
    frames_.back().next = Next::nothing;
    if (note_scalar(key, true, false)) result_.has_colon = has_colon;
  }

  void add_value(const Span& value, bool is_open) {
    if (!frames_.empty()) {
      Frame& top = frames_.back();
      if (!top.is_list && !top.entries.empty()) top.entries.back().value = value;
      top.next = Next::nothing;
    }
    note_scalar(value, false, is_open);
  }

  // The cursor ------------------------------------------------------------------------------------

  [[nodiscard]] std::string step_of(const Frame& frame) const {
    if (frame.is_list || frame.entries.empty()) return {};
    const Span& key = frame.entries.back().key;
    const bool is_kept = visit_ == nullptr || key.end - key.begin <= longest_visited_key;
    return is_kept ? text_of(key) : "...";
  }

  /// Fills in the path to a frame, and what is around it.
  void note_frame(std::size_t frame) {
    is_found_ = true;
    result_ = {};
    for (std::size_t outer = 0; outer < frame; ++outer) {
      result_.path.push_back(step_of(frames_[outer]));
    }
    if (frame > 0 && visit_ == nullptr) note_outer(frames_[frame - 1]);
    result_.is_flow = frame < frames_.size() && frames_[frame].is_flow;
    const auto list = std::find_if(frames_.begin(), frames_.end(),
                                   [](const Frame& outer) { return outer.is_list; });
    if (list != frames_.end()) result_.entry = list->entry;
    result_.is_json = is_json_;
    result_.begin = result_.end = cursor_;
    own_key_ = text_.size();
    watched_ = 0;
  }

  void note_outer(const Frame& frame) {
    for (const Frame::Entry& entry : frame.entries) {
      if (entry.value.end > entry.value.begin) {
        result_.outer.emplace_back(text_of(entry.key), text_of(entry.value));
      }
    }
  }

  void watch(std::size_t frame, bool has_own_key) {
    watched_ = frame + 1;
    if (!has_own_key || frames_[frame].entries.empty()) return;
    own_key_ = frames_[frame].entries.back().key.begin;
  }

  void note_place(bool is_key, bool is_open) {
    const std::size_t last = frames_.empty() ? 0 : frames_.size() - 1;
    note_frame(last);
    result_.is_key = is_key;
    result_.is_open = is_open;
    if (frames_.empty()) return;
    const Frame& top = frames_.back();
    result_.is_item = top.is_list && !is_key;
    if (top.is_list) return;
    if (!is_key) result_.key = step_of(top);
    watch(last, !is_key);
  }

  /// Returns whether the cursor is in the scalar.
  bool note_scalar(const Span& span, bool is_key, bool is_open) {
    const bool is_here = visit_ == nullptr ? cursor_ >= span.begin && cursor_ <= span.end
                                           : frames_.size() <= most_visited_frames;
    if (!is_here || is_over_) return false;
    note_place(is_key, is_open);
    result_.begin = span.begin;
    result_.end = span.end;
    if (byte(span.begin) != '*') result_.text = text_of(span);  // an alias is no text of its own
    if (is_key && watched_ > 0) own_key_ = span.begin;
    if (visit_ == nullptr) return true;
    watched_ = 0;
    (*visit_)(result_);
    return false;
  }

  /// The bytes from `gap_` to `end` have nothing but blanks.
  void note_gap(std::size_t end, bool is_open = false) {
    if (is_found_ || cursor_ < gap_ || cursor_ > end || frames_.empty()) return;
    const Frame& top = frames_.back();
    if (top.next == Next::nothing) return;
    note_place(!top.is_list && top.next == Next::entry, is_open);
  }

  /// The innermost frame at a column or before it; the first one if there is none.
  [[nodiscard]] std::size_t frame_at(std::size_t column) const {
    std::size_t frame = frames_.empty() ? 0 : frames_.size() - 1;
    while (frame > 0 && frames_[frame].column > column) --frame;
    return frame;
  }

  /// A list may stand at the column of its key.
  [[nodiscard]] bool has_key_above(std::size_t frame) const {
    return frame > 0 && frames_[frame].is_list && !frames_[frame - 1].is_list &&
           frames_[frame].column == frames_[frame - 1].column;
  }

  [[nodiscard]] std::string list_key_at(std::size_t column) const {
    const std::size_t frame = frame_at(column);
    if (frames_.empty() || frames_[frame].column != column) return {};
    if (has_key_above(frame)) return step_of(frames_[frame - 1]);
    return frames_[frame].next == Next::value ? step_of(frames_[frame]) : "";
  }

  /// The cursor is at a column of a line of a block that has nothing but blanks.
  void note_blank(std::size_t column) {
    std::size_t frame = frame_at(column);
    if (has_key_above(frame) && frames_[frame].column == column) --frame;
    note_frame(frame);
    result_.is_key = true;
    if (frames_.empty()) return;
    const Frame& found = frames_[frame];
    if (frame + 1 == frames_.size() && found.next != Next::nothing && found.column < column) {
      result_.path.push_back(step_of(found));
      result_.outer.clear();
      note_outer(found);
    } else if (!found.is_list) {
      result_.list_key = list_key_at(column);
      watch(frame, false);
    }
  }

  // Blocks ----------------------------------------------------------------------------------------

  void finish_line() {
    gap_ = yaml::end_of_line(text_, at_) + 1;  // past the end of a text without a last line break
    at_ = std::min(gap_, text_.size());
  }

  void scan_line() {
    at_ = skip_spaces(at_);
    if (is_line_end(at_)) {
      if (cursor_ >= line_ && cursor_ <= at_) note_blank(cursor_ - line_);
      return finish_line();
    }
    const bool is_marker = at_ == line_ && is_blank_at(at_ + 3) &&
                           (text_.substr(at_, 3) == "---" || text_.substr(at_, 3) == "...");
    if (is_marker || (at_ == line_ && byte(at_) == '%' && frames_.empty())) {
      while (!frames_.empty()) pop();
      at_ = is_marker ? skip_spaces(at_ + 3) : yaml::end_of_line(text_, at_);
      if (is_line_end(at_)) return finish_line();
    }
    bool starts_line = true;
    while (is_dash(at_) && !is_over_) {
      open_item(at_ - line_, starts_line);
      starts_line = false;
      gap_ = at_ + 2;
      at_ = skip_spaces(at_ + 1);
      note_gap(at_, true);
      if (is_line_end(at_)) return finish_line();
    }
    scan_content(starts_line);
  }

  void open_item(std::size_t column, bool starts_line) {
    while (starts_line && !frames_.empty() && frames_.back().column > column) pop();
    const bool is_next = !frames_.empty() && frames_.back().is_list && starts_line &&
                         frames_.back().column == column;
    if (!is_next) push({.is_list = true, .column = column});
    frames_.back().next = Next::entry;
    frames_.back().entry = at_ + 1;
  }

  /// What follows the dashes of a line.
  void scan_content(bool starts_line) {
    const std::size_t column = at_ - line_;
    at_ = skip_properties(at_);
    if (is_line_end(at_) || begins_comment(at_)) return finish_line();
    const Span span = scalar_at(at_, true);
    if (is_one_of(byte(at_), "{[|>") || !is_colon(skip_spaces(span.end))) {
      return scan_value(column, starts_line);
    }
    if (starts_line) pop_to(column);
    // Below a complete value, a key at another column is one that is not indented well.
    const bool is_next = !frames_.empty() && !frames_.back().is_list &&
                         (frames_.back().column == column || frames_.back().next == Next::nothing);
    if (!is_next) push({.column = column});
    add_key(span, true);
    frames_.back().next = Next::value;
    at_ = skip_spaces(span.end) + 1;
    gap_ = at_ + 1;
    at_ = skip_spaces(at_);
    note_gap(at_);
    at_ = skip_properties(at_);
    if (is_line_end(at_) || begins_comment(at_)) return finish_line();
    scan_value(column, false, true);
  }

  /// `has_key`: it follows its key on the same line.
  void scan_value(std::size_t column, bool starts_line, bool has_key = false) {
    const std::string list_key = starts_line ? list_key_at(column) : "";
    if (starts_line) pop_to(column);
    if (starts_line && frames_.empty() && !is_one_of(byte(at_), "{[|>")) push({.column = column});
    const bool is_half_key = starts_line && !frames_.empty() && frames_.back().column >= column;
    if (is_one_of(byte(at_), "{[")) return open_flow();
    if (is_one_of(byte(at_), "|>")) {
      add_value(take_block_scalar(), false);
      return;
    }
    Span span = scalar_at(at_, false);
    if (is_half_key) {
      if (note_scalar(span, true, false)) result_.list_key = list_key;
    } else {
      if (!is_quote(at_)) span.end = end_of_plain_lines(span.end);
      add_value(span, !has_key);
    }
    at_ = span.end;
    finish_line();
  }

  Span take_block_scalar() {
    const std::size_t begin = at_;
    std::size_t end = std::min(yaml::end_of_line(text_, at_), text_.size());
    for (std::size_t line = end + 1; line < text_.size();) {
      const std::size_t at = skip_spaces(line);
      const std::size_t line_end = yaml::end_of_line(text_, line);
      const bool is_inside = !frames_.empty() && at - line > frames_.back().column;
      if (!is_line_end(at) && !is_inside) break;
      if (!is_line_end(at)) end = line_end;
      line = line_end + 1;
    }
    at_ = end;
    finish_line();
    return {begin, end};
  }

  // Flow ------------------------------------------------------------------------------------------

  void open_flow() {
    push({.is_list = byte(at_) == '[', .is_flow = true, .column = at_ - line_, .entry = at_ + 1});
    gap_ = ++at_;
  }

  void close_flow() {
    const bool is_list = byte(at_) == ']';
    std::size_t open = frames_.size();
    while (open > 0 && frames_[open - 1].is_flow &&
           (frames_[open - 1].is_implicit || frames_[open - 1].is_list != is_list)) {
      --open;
    }
    gap_ = ++at_;
    if (open == 0 || !frames_[open - 1].is_flow) return;
    while (frames_.size() >= open) pop();
    if (!is_in_flow()) finish_line();
  }

  /// Whether the content of a new line shows that brackets were left open.
  [[nodiscard]] bool leaves_flow(std::size_t line, std::size_t content) const {
    const auto block = std::find_if(frames_.rbegin(), frames_.rend(),
                                    [](const Frame& frame) { return !frame.is_flow; });
    return block != frames_.rend() && content - line <= block->column && begins_entry(content);
  }

  void scan_flow() {
    at_ = skip_spaces(at_);
    note_gap(at_);
    if (begins_comment(at_) || is_line_end(at_)) {
      finish_line();
      line_ = at_;
      if (!leaves_flow(line_, skip_spaces(at_))) return;
      while (is_in_flow()) pop();
      return;
    }
    const char here = byte(at_);
    if (here == '{' || here == '[') return open_flow();
    if (here == '}' || here == ']') return close_flow();
    if (here == '&' || here == '!') {
      at_ = skip_properties(at_);
    } else if (here == ',') {
      while (frames_.back().is_implicit) pop();
      frames_.back().next = Next::entry;
      frames_.back().entry = gap_ = ++at_;
    } else if (is_colon(at_, is_after_quote_)) {
      if (!frames_.back().is_list && !frames_.back().entries.empty()) {
        frames_.back().next = Next::value;
      }
      gap_ = ++at_ + (is_after_quote_ ? 0 : 1);
    } else {
      scan_flow_scalar();
    }
  }

  void scan_flow_scalar() {
    const bool is_quoted = is_quote(at_);
    Span span = scalar_at(at_, true);
    if (!is_quoted) span.end = end_of_plain_lines(span.end);
    if (!knows_json_) is_json_ = frames_.front().is_flow && byte(at_) == '"';
    knows_json_ = true;
    const bool has_colon = is_colon(skip_spaces(span.end), is_quoted);
    if (frames_.back().is_list && has_colon) push({.is_flow = true, .is_implicit = true});
    // A comma may be missing.
    if (frames_.back().is_list || frames_.back().next == Next::value) {
      add_value(span, false);
    } else {
      add_key(span, has_colon);
    }
    is_after_quote_ = is_quoted;
    at_ = gap_ = span.end;
    // It may go over several lines.
    const std::size_t line = text_.substr(span.begin, span.end - span.begin).rfind('\n');
    if (line != std::string_view::npos) line_ = span.begin + line + 1;
  }

  const std::string_view text_;
  std::size_t cursor_;
  const std::function<void(const Context&)>* visit_ = nullptr;
  std::size_t at_ = 0;
  std::size_t line_ = 0;  ///< where the line of `at_` begins
  std::size_t gap_ = 0;   ///< where the cursor may stand after the last token
  std::vector<Frame> frames_;
  bool is_after_quote_ = false;
  bool knows_json_ = false;
  bool is_json_ = false;

  Context result_;
  bool is_found_ = false;
  bool is_over_ = false;     ///< all is known
  std::size_t watched_ = 0;  ///< the number of frames down to the one whose keys are the siblings
  std::size_t own_key_ = 0;  ///< where the key begins that is no sibling
};

}  // namespace

Context context_at(std::string_view text, std::size_t offset) {
  return Scanner(text, offset).scan();
}

void visit_scalars(std::string_view text, const std::function<void(const Context&)>& visit) {
  (void)Scanner(text, visit).scan();
}

}  // namespace cbc::lsp
