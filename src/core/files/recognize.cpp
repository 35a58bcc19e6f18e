#include "core/files/recognize.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <set>

#include "cbc/event.h"
#include "core/catalog/draft.h"
#include "core/check/controls.h"
#include "core/script/event_lines.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_file.h"
#include "runtime/coordinator/record.h"

namespace cbc::cli {
namespace {

template <typename Keys>
bool has_any(const yaml::Node& node, const Keys& keys) {
  return std::any_of(keys.begin(), keys.end(),
                     [&node](std::string_view key) { return node.find(key) != nullptr; });
}

/// Whether lines of a text that is not valid YAML begin with the keys of a catalog.
bool has_lines_of_catalog(std::string_view text) {
  constexpr std::string_view main_key = "behaviors";
  constexpr std::string_view other_keys[] = {"tasks", "exclusivity_constraints", "default_values"};
  const auto begins_with = [](std::string_view line, std::string_view key) {
    return line.starts_with(key) && line.substr(key.size()).starts_with(':');
  };
  text = utf8::without_byte_order_mark(text);
  std::set<std::string_view> found;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::string_view line = text.substr(begin, text.find('\n', begin) - begin);
    if (begins_with(line, main_key)) return true;
    for (const std::string_view key : other_keys) {
      if (begins_with(line, key)) found.insert(key);
    }
    begin += line.size() + 1;
  }
  return found.size() > 1;
}

/// Whether lines of a text that is not valid YAML begin with the keys of a script.
bool has_lines_of_script(std::string_view text) {
  text = utf8::without_byte_order_mark(text);
  bool has_verb = false;
  bool has_key = false;
  for (std::size_t begin = 0; begin < text.size();) {
    std::string_view line = text.substr(begin, text.find('\n', begin) - begin);
    begin += line.size() + 1;
    has_key |= line.starts_with("events:");
    line.remove_prefix(std::min(line.find_first_not_of(" -{"), line.size()));
    const std::string_view word = line.substr(0, line.find(':'));
    has_verb |=
        word.size() < line.size() && (word == "expect" || find_word<Verb>(word).has_value());
  }
  return has_key && has_verb;
}

/// Of a document that is no catalog.
bool is_property_file(const yaml::Node& root) {
  return std::any_of(root.entries.begin(), root.entries.end(), [](const auto& entry) {
    return entry.first->text == "properties" || entry.first->text == "assume";
  });
}

/// Of a document that is neither a catalog nor a property file.
bool is_script(const yaml::Node& root) {
  constexpr std::array<std::string_view, 4> keys = {"events", "catalog", "reactive_delay",
                                                    "timeouts"};
  constexpr std::array<std::string_view, 2> other_event_keys = {"expect", "at"};
  if (root.kind != yaml::Kind::sequence) {
    // In a catalog it is a list.
    const yaml::Node* const situation = root.find("situation");
    const bool has_situation = situation != nullptr && situation->kind == yaml::Kind::mapping;
    return has_any(root, keys) || has_situation;
  }
  // Another list is more likely a catalog that lacks a key.
  return root.items.empty() ||
         std::any_of(root.items.begin(), root.items.end(), [&](const yaml::Node* item) {
           return has_any(*item, words_of<Verb>()) || has_any(*item, other_event_keys);
         });
}

bool has_misspelt_events(const yaml::Node& root) {
  return std::any_of(root.entries.begin(), root.entries.end(), [](const auto& entry) {
    return nearest(entry.first->text, std::array<std::string_view, 1>{"events"}).has_value();
  });
}

/// A list of events, of which at least one has a known verb.
bool has_events(const yaml::Node& node) {
  return node.kind == yaml::Kind::sequence &&
         std::any_of(node.items.begin(), node.items.end(), [](const yaml::Node* item) {
           return has_any(*item, words_of<Verb>()) || item->find("expect") != nullptr;
         });
}

/// Other YAML files may begin like a script.
bool is_script_surely(const yaml::Node& root) {
  const bool names_both = root.find("catalog") != nullptr && root.find("events") != nullptr;
  return names_both || has_events(root) ||
         std::any_of(root.entries.begin(), root.entries.end(),
                     [](const auto& entry) { return has_events(*entry.second); });
}

/// Other YAML files, such as JSON schemas, have a mapping under this key.
bool has_properties(const yaml::Node& root) {
  const yaml::Node* const properties = root.find("properties");
  return properties == nullptr || properties->kind == yaml::Kind::sequence;
}

}  // namespace

Recognition recognize(std::string_view name, std::string_view text,
                      const yaml::Document* document) {
  if (is_compiled(text)) return {FileKind::compiled};
  if (std::filesystem::path(name).filename() == settings_file_name) return {FileKind::settings};
  if (is_log(text)) return {FileKind::log};
  constexpr bool is_faulty = true;
  if (document == nullptr) {
    if (has_lines_of_catalog(text)) return {FileKind::catalog, is_faulty};
    if (has_lines_of_script(text)) return {FileKind::script, is_faulty};
    return {};
  }
  const yaml::Node& root = document->root();
  if (is_catalog(root)) return {FileKind::catalog};
  if (is_property_file(root)) return {FileKind::properties, false, has_properties(root)};
  if (is_script(root)) return {FileKind::script, false, is_script_surely(root)};
  if (has_misspelt_events(root)) return {FileKind::script, is_faulty, is_script_surely(root)};
  if (resembles_catalog(root)) return {FileKind::catalog, is_faulty};
  return {};
}

}  // namespace cbc::cli
