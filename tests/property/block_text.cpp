#include "block_text.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace cbc::mutation {
namespace {

struct NotUnderstood : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One past the last character before a comment and the blanks around it.
std::size_t end_of_content(std::string_view line) {
  char quote = '\0';
  std::size_t end = line.size();
  for (std::size_t at = 0; at < line.size(); ++at) {
    const char byte = line[at];
    const bool after_blank = at == 0 || line[at - 1] == ' ';
    if (quote != '\0') {
      if (byte == quote) quote = '\0';
    } else if ((byte == '"' || byte == '\'') && after_blank) {
      quote = byte;
    } else if (byte == '#' && after_blank) {
      end = at;
      break;
    }
  }
  return line.substr(0, end).find_last_not_of(' ') + 1;
}

bool is_entry(std::string_view text) { return text == "-" || text.starts_with("- "); }

class Parser {
 public:
  explicit Parser(const Lines& lines) {
    for (std::size_t number = 1; number <= lines.count(); ++number) {
      if (!lines.has_content(number)) continue;
      const std::string& line = lines[number];
      if (line.find('\t') != std::string::npos) throw NotUnderstood("a tab");
      const std::size_t begin = line.find_first_not_of(' ');
      rows_.push_back({number, begin, line.substr(begin, end_of_content(line) - begin)});
    }
  }

  Item parse() {
    if (rows_.empty()) throw NotUnderstood("empty");
    Item root = parse_block();
    if (next_ != rows_.size()) throw NotUnderstood("more than one value");
    return root;
  }

 private:
  struct Row {
    std::size_t line;
    std::size_t column;
    std::string text;
  };

  Item parse_block() {
    if (is_entry(rows_[next_].text)) return parse_list();
    if (key_end(rows_[next_].text)) return parse_mapping();
    const Row row = rows_[next_++];
    return parse_inline(row.text, row.line, row.column);
  }

  Item parse_list() {
    Item list;
    list.kind = Item::Kind::list;
    list.line = rows_[next_].line;
    list.column = rows_[next_].column;
    while (next_ < rows_.size() && rows_[next_].column == list.column &&
           is_entry(rows_[next_].text)) {
      Row& row = rows_[next_];
      const std::size_t content = row.text.find_first_not_of(' ', 1);
      if (content == std::string::npos) throw NotUnderstood("an entry on the next line");
      row.column += content;
      row.text.erase(0, content);
      list.items.push_back(parse_block());
      list.last_line = list.items.back().last_line;
    }
    return list;
  }

  Item parse_mapping() {
    Item mapping;
    mapping.kind = Item::Kind::mapping;
    mapping.line = rows_[next_].line;
    mapping.column = rows_[next_].column;
    while (next_ < rows_.size() && rows_[next_].column == mapping.column &&
           !is_entry(rows_[next_].text)) {
      const Row row = rows_[next_++];
      const auto end = key_end(row.text);
      if (!end) throw NotUnderstood("no key");
      Field field;
      field.key = row.text.substr(0, *end);
      field.line = row.line;
      field.column = row.column;
      const std::size_t begin = row.text.find_first_not_of(' ', *end + 1);
      if (begin != std::string::npos) {
        field.value = parse_inline(row.text.substr(begin), row.line, row.column + begin);
      } else if (next_ < rows_.size() && belongs_to(mapping.column, rows_[next_])) {
        field.value = parse_block();
      } else {
        field.value.line = row.line;
        field.value.last_line = row.line;
      }
      field.last_line = field.value.last_line;
      mapping.last_line = field.last_line;
      mapping.fields.push_back(std::move(field));
    }
    return mapping;
  }

  static bool belongs_to(std::size_t key_column, const Row& row) {
    return row.column > key_column || (row.column == key_column && is_entry(row.text));
  }

  static std::optional<std::size_t> key_end(const std::string& text) {
    const std::size_t colon = std::min(text.find(": "), text.size() - 1);
    if (text[colon] != ':' || text.find_first_of("\"'[{#&*!|>") < colon) return std::nullopt;
    return colon;
  }

  static Item parse_inline(const std::string& text, std::size_t line, std::size_t column) {
    Item item;
    item.kind = Item::Kind::scalar;
    item.line = line;
    item.column = column;
    item.last_line = line;
    if (text.front() == '[') {
      if (text.back() != ']') throw NotUnderstood("a list over several lines");
      read_flow_items(text, item);
    } else if (text.front() == '"' || text.front() == '\'') {
      if (text.size() < 2 || text.back() != text.front()) throw NotUnderstood("a long text");
      item.text = text.substr(1, text.size() - 2);
    } else if (std::string("{&*!|>%@`").find(text.front()) != std::string::npos) {
      throw NotUnderstood("a value of another style");
    } else {
      item.text = text;
    }
    return item;
  }

  static void read_flow_items(const std::string& text, Item& list) {
    list.kind = Item::Kind::list;
    list.flow = true;
    std::size_t begin = 1;
    while (begin < text.size()) {
      const std::size_t end = text.find_first_of(",]", begin);
      const std::size_t first = text.find_first_not_of(' ', begin);
      if (first < end) {
        const std::size_t last = text.find_last_not_of(' ', end - 1);
        list.items.push_back(
            parse_inline(text.substr(first, last + 1 - first), list.line, list.column + first));
      }
      begin = end + 1;
    }
  }

  std::vector<Row> rows_;  // lines with content; the dashes of entries are taken off when read
  std::size_t next_ = 0;
};

}  // namespace

const Field* Item::find(std::string_view key) const {
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [key](const Field& field) { return field.key == key; });
  return found == fields.end() ? nullptr : &*found;
}

Lines::Lines(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines_.emplace_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

std::string Lines::text() const {
  std::string text;
  for (const std::string& line : lines_) text += line + "\n";
  return text;
}

void Lines::insert_after(std::size_t line, const std::string& added) {
  lines_.insert(lines_.begin() + static_cast<std::ptrdiff_t>(line), added);
}

void Lines::erase(std::size_t first, std::size_t last) {
  lines_.erase(lines_.begin() + static_cast<std::ptrdiff_t>(first - 1),
               lines_.begin() + static_cast<std::ptrdiff_t>(last));
}

void Lines::replace(std::size_t line, std::size_t column, std::size_t length,
                    std::string_view now) {
  lines_[line - 1].replace(column, length, now);
}

std::size_t Lines::shown_column(std::size_t line, std::size_t column) const {
  const std::string& text = lines_[line - 1];
  const auto begin = text.begin();
  const auto characters =
      std::count_if(begin, begin + static_cast<std::ptrdiff_t>(column),
                    [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; });
  return static_cast<std::size_t>(characters) + 1;
}

bool Lines::has_content(std::size_t line) const { return end_of_content(lines_[line - 1]) > 0; }

std::optional<Item> read_block_text(const Lines& lines) {
  try {
    return Parser(lines).parse();
  } catch (const NotUnderstood&) {
    return std::nullopt;
  }
}

}  // namespace cbc::mutation
