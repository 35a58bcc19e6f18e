#include "script/parameters.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "text/json_writer.h"
#include "yaml/duplicates.h"
#include "yaml/values.h"

namespace cbc {
namespace {

using yaml::Kind;
using yaml::Node;

void report_duplicates(const Node& node, Reporter& reporter) {
  if (node.kind == Kind::mapping) yaml::report_duplicate_keys(node, reporter);
  for (const Node* item : node.items) report_duplicates(*item, reporter);
  for (const auto& entry : node.entries) report_duplicates(*entry.second, reporter);
}

// Canonical form -----------------------------------------------------------------------------
//
// Every value says how long it is before it begins, so that no two values have the same text: a
// scalar is "s<bytes>:<text>", a list "l<items>:<items>", a mapping "m<entries>:<keys and values>",
// and an empty item of a list "n".

std::string tagged(char tag, std::size_t size) { return tag + std::to_string(size) + ":"; }

std::string canonical(const Node& node);

std::string canonical_list(const Node& node) {
  std::string text;
  std::size_t size = 0;
  std::size_t waiting = 0;  // empty items that only count if another one follows
  for (const Node* item : node.items) {
    const std::string value = canonical(*item);
    if (value.empty()) {
      ++waiting;
      continue;
    }
    text.append(waiting, 'n');
    text += value;
    size += waiting + 1;
    waiting = 0;
  }
  return size == 0 ? "" : tagged('l', size) + text;
}

std::string canonical_mapping(const Node& node) {
  std::vector<std::pair<std::string_view, std::string>> entries;
  for (const auto& [key, value] : node.entries) {
    std::string text = canonical(*value);
    if (!text.empty()) entries.emplace_back(key->text, std::move(text));
  }
  if (entries.empty()) return {};
  std::sort(entries.begin(), entries.end());
  std::string text = tagged('m', entries.size());
  for (const auto& [key, value] : entries) {
    text += tagged('s', key.size());
    text += key;
    text += value;
  }
  return text;
}

std::string canonical(const Node& node) {
  switch (node.kind) {
    case Kind::null:
      break;
    case Kind::scalar:
      return node.text.empty() ? "" : tagged('s', node.text.size()) + node.text;
    case Kind::sequence:
      return canonical_list(node);
    case Kind::mapping:
      return canonical_mapping(node);
  }
  return {};
}

// JSON ---------------------------------------------------------------------------------------

bool is_digit(char character) { return character >= '0' && character <= '9'; }

/// Whether a text is a number of JSON. One that no double can hold is none here, as many readers of
/// JSON refuse it.
bool is_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return false;
  // These are no numbers to JSON: .5, 05, 5., inf
  if (text.starts_with('-')) text.remove_prefix(1);
  if (!is_digit(text.front())) return false;
  if (text.size() > 1 && text.front() == '0' && is_digit(text[1])) return false;
  const std::size_t point = text.find('.');
  return point == std::string_view::npos || (point + 1 < text.size() && is_digit(text[point + 1]));
}

void append_json(std::string& json, const Node& node) {
  switch (node.kind) {
    case Kind::null:
      json += "null";
      break;
    case Kind::scalar:
      // As it was written, so that no digit is lost.
      if (node.plain && (node.text == "true" || node.text == "false" || is_number(node.text))) {
        json += node.text;
      } else {
        append_text(json, node.text);
      }
      break;
    case Kind::sequence:
      json += '[';
      for (const Node* item : node.items) {
        if (json.back() != '[') json += ',';
        append_json(json, *item);
      }
      json += ']';
      break;
    case Kind::mapping:
      json += '{';
      for (const auto& [key, value] : node.entries) {
        JsonWriter(json).key(key->text);
        append_json(json, *value);
      }
      json += '}';
      break;
  }
}

}  // namespace

std::optional<Parameters> read_parameters(const Node& node, Reporter& reporter) {
  if (yaml::read_mapping(node, "parameters", "a mapping", reporter) == nullptr) {
    return std::nullopt;
  }
  report_duplicates(node, reporter);
  Parameters parameters{canonical(node), {}};
  append_json(parameters.json, node);
  return parameters;
}

}  // namespace cbc
