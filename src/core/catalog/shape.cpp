#include "core/catalog/shape.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

#include "core/support/wording.h"
#include "core/yaml/values.h"

namespace cbc::shape {
namespace {

using yaml::Key;
using yaml::Shape;

std::optional<std::string_view> present_goal(const yaml::Node& category) {
  if (category.text == "goal_based") return "achieve_goal";
  if (category.text == "recurrent") return "keep_running";
  return std::nullopt;
}

constexpr Key catalog_keys[] = {
    {"default_values"}, {"behaviors"}, {"tasks"}, {"exclusivity_constraints"}, {"situation"}};
constexpr Key default_values_keys[] = {{"tasks"}, {"behaviors"}};
constexpr Key task_defaults_keys[] = {{"execution_goal"},
                                      {"start_on_request"},
                                      {"reactive_start"},
                                      {"timeout"},
                                      {"category", "execution_goal", present_goal},
                                      {"automatic_activation", "start_on_request", yaml::opposite},
                                      {"default", "reactive_start"}};
constexpr Key behavior_defaults_keys[] = {
    {"suitability"}, {"package"}, {"efficacy", "suitability"}};
constexpr Key behavior_keys[] = {{"behavior"},  {"package"},     {"task"},
                                 {"tasks"},     {"requires"},    {"timeout"},
                                 {"situation"}, {"suitability"}, {"efficacy", "suitability"}};
constexpr Key performance_keys[] = {{"task"}, {"suitability"}, {"efficacy", "suitability"}};
constexpr Key requirement_keys[] = {{"task"}, {"minimum_performance"}};
constexpr Key task_keys[] = {{"task"},
                             {"execution_goal"},
                             {"start_on_request"},
                             {"reactive_start"},
                             {"timeout"},
                             {"minimum_performance"},
                             {"parameters"},
                             {"category", "execution_goal", present_goal},
                             {"automatic_activation", "start_on_request", yaml::opposite},
                             {"default", "reactive_start"}};
constexpr Key parameter_keys[] = {{"parameter"}, {"allowed_values"}};
constexpr Key exclusivity_list_keys[] = {{"mutually_exclusive"}};

constexpr Key variable_keys[] = {{"variable"}, {"values"}};

constexpr const Shape* in_catalog[] = {&behavior, &task, &exclusivity_list, &variable};
constexpr const Shape* in_default_values[] = {&task_defaults, &behavior_defaults};
constexpr const Shape* in_behavior[] = {&requirement, &performance};
constexpr const Shape* in_task[] = {&parameter};

}  // namespace

const Shape catalog{"a catalog", catalog_keys, nullptr, in_catalog};
const Shape default_values{"default_values", default_values_keys, &catalog, in_default_values};
const Shape task_defaults{"the defaults of tasks", task_defaults_keys, &default_values};
const Shape behavior_defaults{"the defaults of behaviors", behavior_defaults_keys, &default_values};
const Shape behavior{"a behavior", behavior_keys, &catalog, in_behavior, true};
const Shape performance{"a task of a behavior", performance_keys, &behavior, {}, true};
const Shape requirement{"a requirement", requirement_keys, &behavior, {}, true};
const Shape task{"a task", task_keys, &catalog, in_task, true};
const Shape parameter{"a parameter", parameter_keys, &task, {}, true};
const Shape exclusivity_list{
    "an exclusivity constraint", exclusivity_list_keys, &catalog, {}, true};
const Shape variable{"a situation variable", variable_keys, &catalog, {}, true};

}  // namespace cbc::shape

namespace cbc {
namespace {

using yaml::Kind;
using yaml::Node;

/// A section at the top of a catalog, and the kinds of values that it has.
struct Section {
  std::string_view key;
  bool may_be_mapping = false;
};

constexpr std::string_view main_key = "behaviors";
constexpr Section other_sections[] = {
    {"tasks"}, {"situation"}, {"exclusivity_constraints"}, {"default_values", true}};

bool is_list_of_mappings(const Node& node) {
  return node.kind == Kind::sequence && !node.items.empty() &&
         std::all_of(node.items.begin(), node.items.end(),
                     [](const Node* item) { return item->kind == Kind::mapping; });
}

bool has_right_kind(const Section& section, const Node& value) {
  return is_list_of_mappings(value) || (section.may_be_mapping && value.kind == Kind::mapping);
}

bool is_misspelling(std::string_view key, std::string_view known) {
  constexpr std::size_t most_letters = 2;  // more is another name that has this one as a part
  const std::size_t longer = std::max(key.size(), known.size());
  return longer - std::min(key.size(), known.size()) <= most_letters &&
         nearest(key, std::vector<std::string_view>{known}).has_value();
}

using IsKey = bool (*)(std::string_view key, std::string_view known);

/// Whether a mapping has the sections of a catalog.
bool has_sections(const Node& root, IsKey is_key) {
  std::size_t others = 0;
  for (const auto& [key, value] : root.entries) {
    if (key->text == main_key) return true;
    if (is_key(key->text, main_key) && is_list_of_mappings(*value)) return true;
    for (const Section& section : other_sections) {
      if (is_key(key->text, section.key) && has_right_kind(section, *value)) ++others;
    }
  }
  return others >= 2;
}

bool is_the_key(std::string_view key, std::string_view known) { return key == known; }

bool is_about_the_key(std::string_view key, std::string_view known) {
  return key == known || is_misspelling(key, known);
}

/// The key of a mapping that has one of some names and a list for its value.
template <typename Names>
const Node* find_list(const Node& mapping, const Names& names) {
  for (const auto& [key, value] : mapping.entries) {
    if (value->kind == Kind::sequence &&
        std::find(std::begin(names), std::end(names), key->text) != std::end(names)) {
      return key;
    }
  }
  return nullptr;
}

}  // namespace

bool is_catalog(const yaml::Node& root) {
  return has_sections(root, is_the_key) || find_older_format(root) != nullptr;
}

bool resembles_catalog(const yaml::Node& root) {
  return is_catalog(root) || has_sections(root, is_about_the_key);
}

const yaml::Node* find_older_format(const yaml::Node& root) {
  constexpr std::string_view sections[] = {"behavior_descriptors", "capability_descriptors",
                                           "basic_behaviors"};
  constexpr std::string_view keys[] = {"capabilities", "incompatible_lists"};
  if (const Node* key = find_list(root, sections)) return key;
  const Node* behaviors = root.find(main_key);
  if (behaviors == nullptr) return nullptr;
  for (const Node* behavior : behaviors->items) {
    // Beside a task, such a key is just unknown.
    if (behavior->find("task") != nullptr || behavior->find("tasks") != nullptr) continue;
    if (const Node* key = find_list(*behavior, keys)) return key;
  }
  return nullptr;
}

}  // namespace cbc
