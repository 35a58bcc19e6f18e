#include "core/catalog/shape.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

#include "core/catalog/older_catalog.h"
#include "core/catalog/older_format.h"
#include "core/support/wording.h"
#include "core/yaml/values.h"

namespace cbc::shape {
namespace {

using yaml::Hint;
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
                                      {"improve"},
                                      {"resume"},
                                      {"category", "execution_goal", present_goal},
                                      {"automatic_activation", "start_on_request", yaml::opposite},
                                      {"default", "reactive_start"}};
constexpr Key behavior_defaults_keys[] = {
    {"suitability"}, {"package"}, {"retry"}, {"efficacy", "suitability"}};
constexpr Key behavior_keys[] = {
    {"behavior"}, {"package"},   {"task"},  {"tasks"},       {"requires"},
    {"timeout"},  {"situation"}, {"retry"}, {"suitability"}, {"efficacy", "suitability"}};
constexpr Key performance_keys[] = {{"task"}, {"suitability"}, {"efficacy", "suitability"}};
constexpr Key requirement_keys[] = {{"task"}, {"minimum_performance"}};
constexpr Key task_keys[] = {{"task"},
                             {"execution_goal"},
                             {"start_on_request"},
                             {"reactive_start"},
                             {"timeout"},
                             {"minimum_performance"},
                             {"requestable"},
                             {"reactive_priority"},
                             {"improve"},
                             {"resume"},
                             {"parameters"},
                             {"category", "execution_goal", present_goal},
                             {"automatic_activation", "start_on_request", yaml::opposite},
                             {"default", "reactive_start"}};
constexpr Key parameter_keys[] = {{"parameter"}, {"allowed_values"}};
constexpr Key exclusivity_list_keys[] = {{"mutually_exclusive"}, {"at_most"}};

constexpr Key variable_keys[] = {{"variable"}, {"values"}};

constexpr std::string_view exclude_advice =
    "tasks that must not run together are in one list, under 'mutually_exclusive' in the section "
    "'exclusivity_constraints'";
constexpr std::string_view require_advice = "the tasks that a behavior needs are under 'requires'";
constexpr std::string_view behavior_advice =
    "it belongs to the behaviors that perform the task, in the section 'behaviors'";
constexpr std::string_view task_advice = "it belongs to the task, in the section 'tasks'";
constexpr std::string_view start_advice =
    "a priority belongs to the event that starts a task, in a script";

constexpr Hint catalog_hints[] = {{"excludes", exclude_advice, true},
                                  {"conflicts", exclude_advice, true},
                                  {"incompatible_lists", exclude_advice, true},
                                  {"precedence_constraints", require_advice, true}};
/// What says of a behavior or a task how it depends on others.
constexpr Hint constraint_hints[] = {{"excludes", exclude_advice, true},
                                     {"exclusive_with", exclude_advice, true},
                                     {"conflicts", exclude_advice, true},
                                     {"conflicts_with", exclude_advice, true},
                                     {"incompatible_with", exclude_advice, true},
                                     {"mutually_exclusive", exclude_advice, true},
                                     {"needs", require_advice, true},
                                     {"depends_on", require_advice, true},
                                     {"dependencies", require_advice, true},
                                     {"preconditions", require_advice, true},
                                     {"prerequisites", require_advice, true}};

template <std::size_t count>
constexpr auto with_constraint_hints(const Hint (&others)[count]) {
  std::array<Hint, std::size(constraint_hints) + count> hints;
  std::copy_n(others, count,
              std::copy(std::begin(constraint_hints), std::end(constraint_hints), hints.begin()));
  return hints;
}

constexpr auto behavior_hints = with_constraint_hints({{"incompatible_lists", exclude_advice, true},
                                                       {"capabilities", require_advice, true},
                                                       {"execution_goal", task_advice},
                                                       {"start_on_request", task_advice},
                                                       {"reactive_start", task_advice},
                                                       {"parameters", task_advice},
                                                       {"arguments", task_advice},
                                                       {"priority", start_advice}});
constexpr auto task_hints = with_constraint_hints({{"requires", behavior_advice, true},
                                                   {"situation", behavior_advice, true},
                                                   {"suitability", behavior_advice},
                                                   {"package", behavior_advice},
                                                   {"priority", start_advice}});

constexpr const Shape* in_catalog[] = {&behavior, &task, &exclusivity_list, &variable};
constexpr const Shape* in_default_values[] = {&task_defaults, &behavior_defaults};
constexpr const Shape* in_behavior[] = {&requirement, &performance};
constexpr const Shape* in_task[] = {&parameter};

}  // namespace

const Shape catalog{"a catalog", catalog_keys, nullptr, in_catalog, false, catalog_hints};
const Shape default_values{"default_values", default_values_keys, &catalog, in_default_values};
const Shape task_defaults{"the defaults of tasks", task_defaults_keys, &default_values};
const Shape behavior_defaults{"the defaults of behaviors", behavior_defaults_keys, &default_values};
const Shape behavior{"a behavior", behavior_keys, &catalog, in_behavior, true, behavior_hints};
const Shape performance{"a task of a behavior", performance_keys, &behavior, {}, true};
const Shape requirement{"a requirement", requirement_keys, &behavior, {}, true};
const Shape task{"a task", task_keys, &catalog, in_task, true, task_hints};
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
  std::string_view of_entry = {};  ///< the key that each entry has, and those of no other program
  bool may_be_mapping = false;
};

constexpr std::string_view main_key = "behaviors";
constexpr Section other_sections[] = {{"tasks", "task"},
                                      {"situation", "variable"},
                                      {"exclusivity_constraints", "mutually_exclusive"},
                                      {"default_values", {}, true}};

bool is_list_of_mappings(const Node& node) {
  return node.kind == Kind::sequence && !node.items.empty() &&
         std::all_of(node.items.begin(), node.items.end(),
                     [](const Node* item) { return item->kind == Kind::mapping; });
}

bool has_right_kind(const Section& section, const Node& value) {
  return is_list_of_mappings(value) || (section.may_be_mapping && value.kind == Kind::mapping);
}

/// Whether all entries of a list are those of a section.
bool has_entries_of(const Section& section, const Node& list) {
  return !section.of_entry.empty() && is_list_of_mappings(list) &&
         std::all_of(list.items.begin(), list.items.end(), [&section](const Node* item) {
           return item->find(section.of_entry) != nullptr;
         });
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
      if (!is_key(key->text, section.key) || !has_right_kind(section, *value)) continue;
      if (has_entries_of(section, *value)) return true;
      ++others;
    }
  }
  return others >= 2;
}

bool is_the_key(std::string_view key, std::string_view known) { return key == known; }

bool is_about_the_key(std::string_view key, std::string_view known) {
  return key == known || is_misspelling(key, known);
}

/// Whether a key and its value are a section, wherever they stand.
bool is_section(const Node& key, const Node& value) {
  constexpr Section older_sections[] = {{"behavior_descriptors", "behavior"},
                                        {"basic_behaviors", "behavior"},
                                        {"capability_descriptors", "capability"}};
  if (key.text == main_key) return is_list_of_behaviors(value);
  const auto is_one = [&](const Section& section) {
    return key.text == section.key && has_entries_of(section, value);
  };
  return std::any_of(std::begin(other_sections), std::end(other_sections), is_one) ||
         std::any_of(std::begin(older_sections), std::end(older_sections), is_one);
}

/// `levels` that may still lie between this and the section.
std::optional<InnerSection> find_section(const Node& node, const Node* outer, int levels) {
  if (levels == 0) return std::nullopt;
  for (const auto& [key, value] : node.entries) {
    if (is_section(*key, *value)) return InnerSection{key, outer};
    if (const auto found = find_section(*value, key, levels - 1)) return found;
  }
  for (const Node* item : node.items) {
    if (const auto found = find_section(*item, outer, levels - 1)) return found;
  }
  return std::nullopt;
}

}  // namespace

bool is_catalog(const yaml::Node& root) {
  return has_sections(root, is_the_key) || find_older_format(root).has_value();
}

bool resembles_catalog(const yaml::Node& root) {
  return is_catalog(root) || has_sections(root, is_about_the_key);
}

bool is_list_of_behaviors(const yaml::Node& node) {
  return is_list_of_mappings(node) &&
         std::all_of(node.items.begin(), node.items.end(), [](const Node* item) {
           return item->find("behavior") != nullptr && older::has_task(*item);
         });
}

std::optional<InnerSection> find_inner_section(const yaml::Node& root) {
  constexpr int most_levels = 5;
  return find_section(root, nullptr, most_levels);
}

}  // namespace cbc
