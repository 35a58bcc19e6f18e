#include "cli/file_kind.h"

#include <algorithm>
#include <array>

#include "text/nearest.h"
#include "text/utf8.h"

namespace cbc::cli {
namespace {

constexpr std::array<std::string_view, 4> catalog_keys = {
    "behaviors", "tasks", "exclusivity_constraints", "default_values"};

template <typename Keys>
bool has_any(const yaml::Node& node, const Keys& keys) {
  return std::any_of(keys.begin(), keys.end(),
                     [&node](std::string_view key) { return node.find(key) != nullptr; });
}

/// Whether a line begins with one of the keys.
bool has_line_with_key(std::string_view text) {
  text = utf8::without_byte_order_mark(text);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::string_view line = text.substr(begin, text.find('\n', begin) - begin);
    for (const std::string_view key : catalog_keys) {
      if (line.starts_with(key) && line.substr(key.size()).starts_with(':')) return true;
    }
    begin += line.size() + 1;
  }
  return false;
}

}  // namespace

bool is_catalog(const yaml::Document& document) { return has_any(document.root(), catalog_keys); }

bool is_script(const yaml::Document& document) {
  constexpr std::array<std::string_view, 4> keys = {"events", "catalog", "reactive_delay",
                                                    "situation"};
  constexpr std::array<std::string_view, 9> event_keys = {
      "start", "stop", "finish", "situation", "fault", "repair", "expect", "at", "wait"};
  const yaml::Node& root = document.root();
  if (root.kind != yaml::Kind::sequence) return !is_catalog(document) && has_any(root, keys);
  // A list of anything else is more likely a catalog that lacks a key.
  return root.items.empty() ||
         std::any_of(root.items.begin(), root.items.end(),
                     [&event_keys](const yaml::Node* item) { return has_any(*item, event_keys); });
}

bool looks_like_script(const yaml::Document& document) {
  if (is_script(document)) return true;
  const auto& entries = document.root().entries;
  return !is_catalog(document) &&
         std::any_of(entries.begin(), entries.end(), [](const auto& entry) {
           return nearest(entry.first->text, std::array<std::string_view, 1>{"events"}).has_value();
         });
}

bool looks_like_catalog(std::string_view text) {
  if (has_line_with_key(text)) return true;
  Diagnostics ignored;
  const auto document = yaml::parse(text, {}, ignored);
  if (document == nullptr || is_script(*document)) return false;
  if (is_catalog(*document)) return true;
  const auto& entries = document->root().entries;
  return std::any_of(entries.begin(), entries.end(), [](const auto& entry) {
    return nearest(entry.first->text, catalog_keys).has_value();
  });
}

}  // namespace cbc::cli
