#include "catalog/shapes.h"

#include <optional>
#include <string_view>

#include "yaml/values.h"

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
    {"default_values"}, {"behaviors"}, {"tasks"}, {"exclusivity_constraints"}};
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
constexpr Key behavior_keys[] = {
    {"behavior"}, {"package"}, {"task"},        {"tasks"},
    {"requires"}, {"timeout"}, {"suitability"}, {"efficacy", "suitability"}};
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

constexpr const Shape* in_catalog[] = {&behavior, &task, &exclusivity_list};
constexpr const Shape* in_default_values[] = {&task_defaults, &behavior_defaults};
constexpr const Shape* in_behavior[] = {&requirement, &performance};
constexpr const Shape* in_task[] = {&parameter};

}  // namespace

const Shape catalog{"a catalog", catalog_keys, nullptr, in_catalog};
const Shape default_values{"default_values", default_values_keys, &catalog, in_default_values};
const Shape task_defaults{"the defaults of tasks", task_defaults_keys, &default_values};
const Shape behavior_defaults{"the defaults of behaviors", behavior_defaults_keys, &default_values};
const Shape behavior{"a behavior", behavior_keys, &catalog, in_behavior};
const Shape performance{"a task of a behavior", performance_keys, &behavior};
const Shape requirement{"a requirement", requirement_keys, &behavior};
const Shape task{"a task", task_keys, &catalog, in_task};
const Shape parameter{"a parameter", parameter_keys, &task};
const Shape exclusivity_list{"an exclusivity constraint", exclusivity_list_keys, &catalog};

}  // namespace cbc::shape
