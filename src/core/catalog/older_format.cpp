#include "core/catalog/older_format.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "core/catalog/older_catalog.h"

namespace cbc {

namespace older {

bool is_list_of_entries(const yaml::Node& node) {
  return node.kind == yaml::Kind::null ||
         (node.kind == yaml::Kind::sequence &&
          std::all_of(node.items.begin(), node.items.end(),
                      [](const yaml::Node* item) { return item->kind == yaml::Kind::mapping; }));
}

bool has_task(const yaml::Node& behavior) {
  return behavior.find("task") != nullptr || behavior.find("tasks") != nullptr;
}

}  // namespace older

namespace {

using older::descriptor_sections;
using older::has_task;
using older::is_list_of_entries;
using older::precedence_section;
using older::system_key;
using yaml::Kind;
using yaml::Node;

using Words = std::span<const std::string_view>;

constexpr std::string_view capability_sections[] = {"capability_descriptors", "behavior_lists"};
constexpr std::string_view capability_keys[] = {"capabilities", "incompatible_lists"};

bool is_among(std::string_view word, Words words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

const Node* find_section(const Node& root, Words sections) {
  for (const auto& [key, value] : root.entries) {
    if (is_among(key->text, sections) && is_list_of_entries(*value)) return key;
  }
  return nullptr;
}

/// The first of some keys in the entries of a list of behaviors that have no task. Beside a task,
/// such a key is just unknown.
const Node* find_in_entries(const Node* behaviors, Words keys, Kind kind) {
  if (behaviors == nullptr) return nullptr;
  for (const Node* behavior : behaviors->items) {
    if (has_task(*behavior)) continue;
    for (const auto& [key, value] : behavior->entries) {
      if (value->kind == kind && is_among(key->text, keys)) return key;
    }
  }
  return nullptr;
}

/// Whether a list of behaviors has none with a task.
bool lacks_tasks(const Node* behaviors) {
  return behaviors == nullptr || std::none_of(behaviors->items.begin(), behaviors->items.end(),
                                              [](const Node* item) { return has_task(*item); });
}

}  // namespace

std::optional<OlderFormat> find_older_format(const yaml::Node& root) {
  const Node* const descriptors = find_section(root, descriptor_sections);
  const Node* const of_capabilities = find_section(root, capability_sections);
  const Node* precedences = find_section(root, std::array{precedence_section});
  const Node* const behaviors = root.find("behaviors");
  if (!lacks_tasks(behaviors)) precedences = nullptr;
  const Node* list = behaviors;
  if (descriptors != nullptr) list = root.find(descriptors->text);
  const Node* const with_capabilities = find_in_entries(list, capability_keys, Kind::sequence);
  const Node* const with_system = find_in_entries(list, std::array{system_key}, Kind::scalar);

  OlderFormat format;
  for (const Node* key :
       {descriptors, of_capabilities, precedences, with_capabilities, with_system}) {
    if (format.key == nullptr) format.key = key;
  }
  if (format.key == nullptr) return std::nullopt;
  if (of_capabilities != nullptr || with_capabilities != nullptr) {
    format.features = "with capabilities and without tasks";
  } else if (precedences != nullptr || with_system != nullptr) {
    format.features = "with behavior systems and precedence constraints, and without tasks";
  } else if (descriptors != nullptr && descriptors->text == descriptor_sections[1]) {
    format.features = "with basic behaviors and without tasks";
  } else {
    format.features = "with behavior descriptors and without tasks";
  }
  return format;
}

}  // namespace cbc
