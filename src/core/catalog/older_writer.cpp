// Writes a converted catalog. Edits of the older text would have to move most of it: what was said
// of a behavior is said of its task.

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/catalog/older_catalog.h"
#include "core/support/wording.h"
#include "core/yaml/document.h"
#include "core/yaml/source.h"
#include "runtime/base/text.h"

namespace cbc::older {

using yaml::in_quotes;
using yaml::Kind;
using yaml::Node;

std::string written(std::string_view text) {
  const auto is_letter_or_digit = [](char byte) {
    return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') ||
           (byte >= '0' && byte <= '9') || byte == '_';
  };
  const bool begins_well =
      !text.empty() && (is_letter_or_digit(text[0]) ||
                        (text[0] == '-' && text.size() > 1 && is_letter_or_digit(text[1])));
  const bool is_simple =
      begins_well && std::all_of(text.begin(), text.end(), [&](char byte) {
        return is_letter_or_digit(byte) || byte == '.' || byte == '-' || byte == '/' || byte == '+';
      });
  return is_simple ? std::string(text) : in_quotes(text);
}

std::string written(const Node& node) {
  switch (node.kind) {
    case Kind::null:
      return "~";
    case Kind::scalar:
      return node.plain ? written(node.text) : in_quotes(node.text);
    case Kind::sequence:
      return "[" + join(node.items, ", ", [](const Node* item) { return written(*item); }) + "]";
    case Kind::mapping:
      break;
  }
  return "{" +
         join(node.entries, ", ",
              [](const auto& entry) {
                return written(*entry.first) + ": " + written(*entry.second);
              }) +
         "}";
}

std::string written(const std::vector<std::string>& names) {
  return "[" + join(names, ", ", [](const std::string& name) { return written(name); }) + "]";
}

namespace {

/// The comments of a text by the entries that they are about: one at the end of a line by the entry
/// that this line is part of, others by the entry below them.
class Comments {
 public:
  /// `entries`: the lines in which they begin.
  Comments(std::string_view text, const yaml::Document& document,
           const std::set<std::uint32_t>& entries) {
    const std::uint32_t first_key = document.root().range.begin.line;
    text = utf8::without_byte_order_mark(text);
    std::uint32_t number = 0;
    for (const yaml::SourceLine& line : yaml::split_lines(text, &document)) {
      ++number;
      if (!line.comment) continue;
      std::string_view comment = text.substr(*line.comment, line.end - *line.comment);
      while (!comment.empty() && yaml::is_blank(comment.back())) comment.remove_suffix(1);
      std::string& place = place_of(entries, first_key, number, line.has_content);
      place += comment;
      place += '\n';
    }
  }

  [[nodiscard]] const std::string& head() const { return head_; }
  [[nodiscard]] const std::string& tail() const { return tail_; }
  /// Those of the entry that begins in a line; none for the second entry of the line.
  [[nodiscard]] std::string take(std::uint32_t line) { return std::exchange(by_entry_[line], {}); }

 private:
  std::string& place_of(const std::set<std::uint32_t>& entries, std::uint32_t first_key,
                        std::uint32_t line, bool has_content) {
    if (line < first_key) return head_;
    auto entry = entries.lower_bound(line);
    if (has_content) {
      entry = entries.upper_bound(line);
      if (entry == entries.begin()) return head_;
      --entry;
    }
    return entry == entries.end() ? tail_ : by_entry_[*entry];
  }

  std::string head_;
  std::string tail_;
  std::map<std::uint32_t, std::string> by_entry_;
};

/// Ends lines as the older text does.
std::string with_line_ends(const std::string& text, std::string_view older) {
  if (older.find("\r\n") == std::string_view::npos) return text;
  std::string result;
  for (const char byte : text) {
    if (byte == '\n') result += '\r';
    result += byte;
  }
  return result;
}

std::string_view goal_of(const Node& category) {
  return category.text == "recurrent" ? "keep_running" : "achieve_goal";
}

void write_defaults(const Item& defaults, std::string& out) {
  if (defaults.goal == nullptr && defaults.timeout == nullptr) return;
  out += "default_values:\n  tasks:\n";
  if (defaults.goal != nullptr) {
    out += "    execution_goal: " + std::string(goal_of(*defaults.goal)) + "\n";
  }
  if (defaults.timeout != nullptr) out += "    timeout: " + written(*defaults.timeout) + "\n";
}

void write_behavior(const Item& item, std::string& out) {
  out += "- behavior: " + written(item.name) + "\n";
  if (item.package != nullptr) out += "  package: " + written(*item.package) + "\n";
  out += "  task: " + written(item.name) + "\n";
  if (!item.required.empty()) out += "  requires:\n";
  for (const std::string& task : item.required) out += "  - task: " + written(task) + "\n";
  for (const std::string& line : item.kept) out += "  " + line + "\n";
}

void write_task(const Item& item, bool is_required, const Item& defaults, std::string& out) {
  out += "- task: " + written(item.name) + "\n";
  if (item.is_capability) {
    out += "  execution_goal: keep_running\n";
  } else if (item.goal != nullptr) {
    out += "  execution_goal: " + std::string(goal_of(*item.goal)) + "\n";
  }
  const bool is_reactive =
      !item.is_capability && item.is_reactive.value_or(defaults.is_reactive.value_or(false));
  if (is_reactive) out += "  reactive_start: TRUE\n";
  if (is_reactive || is_required || item.is_capability) {
    out += "  start_on_request: FALSE\n";
  }
  if (item.timeout != nullptr) out += "  timeout: " + written(*item.timeout) + "\n";
  if (!item.parameters.empty()) out += "  parameters:\n";
  for (const std::string& line : item.parameters) out += "  " + line + "\n";
}

}  // namespace

std::string write(const Converted& catalog, const yaml::Document& document, std::string_view text) {
  std::set<std::string_view> required;
  std::set<std::uint32_t> lines = catalog.other_lines;
  for (const Item& item : catalog.items) {
    required.insert(item.required.begin(), item.required.end());
    lines.insert(item.line);
  }
  lines.erase(0);
  Comments comments(text, document, lines);
  std::string out = comments.head();
  write_defaults(catalog.defaults, out);
  out += "behaviors:\n";
  for (const Item& item : catalog.items) {
    out += comments.take(item.line);
    write_behavior(item, out);
  }
  out += "tasks:\n";
  for (const Item& item : catalog.items) {
    write_task(item, required.contains(item.name), catalog.defaults, out);
  }
  for (const std::uint32_t line : catalog.other_lines) out += comments.take(line);
  if (!catalog.exclusive.empty()) out += "exclusivity_constraints:\n";
  for (const std::vector<std::string>& tasks : catalog.exclusive) {
    out += "- mutually_exclusive: " + written(tasks) + "\n";
  }
  if (!catalog.kept_precedences.empty()) out += "x-precedence_constraints:\n";
  for (const std::string& precedence : catalog.kept_precedences) out += "- " + precedence + "\n";
  for (const std::string& line : catalog.kept) out += line + "\n";
  return with_line_ends(out + comments.tail(), text);
}

}  // namespace cbc::older
