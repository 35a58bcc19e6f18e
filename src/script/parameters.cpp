#include "script/parameters.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

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

using Json = nlohmann::ordered_json;

Json to_json_scalar(const Node& node) {
  if (node.plain) {
    const std::string_view text = node.text;
    if (text == "true") return true;
    if (text == "false") return false;
    Json number = Json::parse(text, nullptr, false);
    if (number.is_number() && number.dump() == text) return number;
  }
  return node.text;
}

Json to_json(const Node& node) {
  switch (node.kind) {
    case Kind::null:
      break;
    case Kind::scalar:
      return to_json_scalar(node);
    case Kind::sequence: {
      Json list = Json::array();
      for (const Node* item : node.items) list.push_back(to_json(*item));
      return list;
    }
    case Kind::mapping: {
      Json::object_t mapping;
      for (const auto& [key, value] : node.entries) {
        // Keys differ, which ordered_json would check anew for each of them.
        static_cast<Json::object_t::Container&>(mapping).emplace_back(key->text, to_json(*value));
      }
      return mapping;
    }
  }
  return nullptr;
}

}  // namespace

std::optional<Parameters> read_parameters(const Node& node, Reporter& reporter) {
  if (yaml::read_mapping(node, "parameters", "a mapping", reporter) == nullptr) {
    return std::nullopt;
  }
  report_duplicates(node, reporter);
  return Parameters{canonical(node),
                    to_json(node).dump(-1, ' ', false, Json::error_handler_t::replace)};
}

}  // namespace cbc
