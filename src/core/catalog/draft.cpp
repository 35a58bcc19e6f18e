#include "core/catalog/draft.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/diagnostic/rules.h"
#include "core/support/wording.h"
#include "core/yaml/values.h"
#include "runtime/base/text.h"

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

namespace cbc::draft {
namespace {

using yaml::Fields;
using yaml::Kind;
using yaml::Node;

constexpr std::string_view task_name = "the name of a task";
constexpr std::size_t most_tasks = 100;  // of one behavior

class Reader {
 public:
  explicit Reader(Reporter& reporter) : reporter_(reporter) {}

  Catalog read(const Node& root) {
    if (root.kind == Kind::null) {
      reporter_.report(rule::missing_key, root.range,
                       "missing key 'behaviors': the catalog is empty");
    } else if (root.kind != Kind::mapping) {
      reporter_.report(
          rule::wrong_type, root.range,
          "a catalog must be a mapping with the key 'behaviors', found " + yaml::describe(root));
    } else if (const Node* key = find_older_format(root)) {
      reporter_.report(rule::older_format, key->range,
                       "this is a catalog of an older format, with capabilities and without tasks; "
                       "it is not supported");
      catalog_.lacks_a_section = true;
    } else {
      read_sections(root);
    }
    return std::move(catalog_);
  }

 private:
  // Counts the errors that `read` reports as errors in values.
  template <typename Read>
  auto read_value(Read read) {
    const std::size_t errors = hiding_errors(reporter_);
    auto value = read();
    catalog_.value_errors += hiding_errors(reporter_) - errors;
    return value;
  }

  void read_sections(const Node& root) {
    Fields fields(root, shape::catalog, reporter_);
    // If a section is given twice, only the first is read.
    catalog_.lacks_a_section = reporter_.errors(rule::duplicate_key) > 0;
    if (const Node* node = fields.find("default_values")) read_default_values(*node);
    if (const Node* node = fields.find("tasks")) {
      catalog_.has_task_section = true;
      catalog_.lacks_a_section |=
          !read_entries(*node, "tasks", "a list of tasks", &Reader::read_task);
    }
    if (const Node* node = fields.require("behaviors", root.range)) {
      catalog_.lacks_a_section |=
          !read_entries(*node, "behaviors", "a list of behaviors", &Reader::read_behavior);
    } else {
      catalog_.lacks_a_section = true;
    }
    if (const Node* node = fields.find("exclusivity_constraints")) {
      read_entries(*node, "exclusivity_constraints", "a list of 'mutually_exclusive' lists",
                   &Reader::read_exclusivity_list);
    }
    catalog_.situation = fields.find("situation");
    fields.report_unknown(yaml::UnknownKeys::ignored);
  }

  bool read_entries(const Node& node, std::string_view key, std::string_view expected,
                    void (Reader::*read_entry)(const Node&)) {
    const Node* list = yaml::read_list(node, key, expected, reporter_);
    if (list == nullptr) return false;
    for (const Node* entry : list->items) (this->*read_entry)(*entry);
    return true;
  }

  // Default values ---------------------------------------------------------------------------

  // The mappings of a list, or a single mapping. Published files have one key in each list entry.
  std::vector<const Node*> mappings_of(const Node& node, std::string_view key) {
    constexpr std::string_view expected = "a mapping, or a list of mappings";
    std::vector<const Node*> mappings;
    if (node.kind == Kind::mapping) {
      mappings.push_back(&node);
    } else if (const Node* list = yaml::read_list(node, key, expected, reporter_)) {
      for (const Node* item : list->items) {
        if (item->kind == Kind::mapping) {
          mappings.push_back(item);
        } else {
          reporter_.report(
              rule::wrong_type, item->range,
              "an entry of " + quote(key) + " must be a mapping, found " + yaml::describe(*item));
        }
      }
    }
    return mappings;
  }

  void read_default_values(const Node& node) {
    Fields fields(mappings_of(node, "default_values"), shape::default_values, reporter_);
    if (const Node* tasks = fields.find("tasks")) {
      Fields defaults(mappings_of(*tasks, "tasks"), shape::task_defaults, reporter_);
      catalog_.task_defaults = read_attributes(defaults);
      defaults.report_unknown(yaml::UnknownKeys::ignored);
    }
    if (const Node* behaviors = fields.find("behaviors")) {
      Fields defaults(mappings_of(*behaviors, "behaviors"), shape::behavior_defaults, reporter_);
      catalog_.default_suitability = read_value([&] { return read_suitability(defaults); });
      catalog_.default_package = read_value([&] { return read_package(defaults); });
      defaults.report_unknown(yaml::UnknownKeys::ignored);
    }
    fields.report_unknown(yaml::UnknownKeys::ignored);
  }

  // Tasks ------------------------------------------------------------------------------------

  TaskAttributes read_attributes(const Fields& fields) {
    return read_value([&] { return read_flags_and_timeout(fields); });
  }

  TaskAttributes read_flags_and_timeout(const Fields& fields) {
    const std::size_t errors = reporter_.errors();
    TaskAttributes attributes;
    attributes.execution_goal = read_execution_goal(fields);
    attributes.start_on_request = read_flag(fields, "start_on_request");
    if (auto automatic = read_flag(fields, "automatic_activation")) {
      automatic->value = !automatic->value;
      attributes.start_on_request = automatic;
    }
    attributes.reactive_start = read_flag(fields, "reactive_start");
    if (const auto older = read_flag(fields, "default")) attributes.reactive_start = older;
    attributes.timeout = read_timeout(fields);
    attributes.is_unclear = reporter_.errors() > errors;
    return attributes;
  }

  std::optional<ExecutionGoal> read_execution_goal(const Fields& fields) {
    constexpr std::string_view goals[] = {"achieve_goal", "keep_running"};
    constexpr std::string_view older_goals[] = {"goal_based", "recurrent"};
    std::optional<std::size_t> goal;
    if (const Node* node = fields.find("execution_goal")) {
      goal = yaml::read_choice(*node, "execution_goal", goals, reporter_);
    } else if (const Node* older = fields.find("category")) {
      goal = yaml::read_choice(*older, "category", older_goals, reporter_);
    }
    if (!goal) return std::nullopt;
    return *goal == 0 ? ExecutionGoal::achieve_goal : ExecutionGoal::keep_running;
  }

  std::optional<Flag> read_flag(const Fields& fields, std::string_view key) {
    const Node* node = fields.find(key);
    if (node == nullptr) return std::nullopt;
    const std::optional<bool> value = yaml::read_boolean(*node, key, reporter_);
    if (!value) return std::nullopt;
    return Flag{*value, fields.range_of(key)};
  }

  std::optional<Timeout> read_timeout(const Fields& fields) {
    const Node* node = fields.find("timeout");
    if (node == nullptr) return std::nullopt;
    const auto seconds = yaml::read_seconds(*node, "timeout", true, reporter_);
    if (!seconds) return std::nullopt;
    return Timeout{*seconds, node->range};
  }

  Percent read_minimum(const Fields& fields) {
    const Node* node = fields.find("minimum_performance");
    if (node == nullptr) return {};
    return {yaml::read_percent(*node, "minimum_performance", reporter_).value_or(0), node->range};
  }

  void read_task(const Node& node) {
    if (!expect_entry(node, "a task", "task: NAME")) {
      // A bare name is understood, so that it is not reported as undefined elsewhere.
      if (node.kind == Kind::scalar && !node.text.empty()) {
        catalog_.tasks.push_back({{node.text, node.range}, {}, {}, {}, {}});
      } else {
        ++catalog_.nameless_tasks;
      }
      return;
    }
    const std::size_t errors = reporter_.errors();
    Fields fields(node, shape::task, reporter_);
    Task task;
    const auto name = require_name(fields, "task", task_name, node.range);
    if (name) {
      task.name = *name;
      fields.call("task " + quote(name->text));
    }
    task.attributes = read_attributes(fields);
    task.minimum_performance = read_value([&] { return read_minimum(fields); });
    if (const Node* parameters = fields.find("parameters")) {
      task.parameters = read_value([&] { return read_parameters(*parameters); });
    }
    task.entry = entry_of(node, fields, errors);
    fields.report_unknown(yaml::UnknownKeys::ignored);
    if (name) {
      catalog_.tasks.push_back(std::move(task));
    } else {
      ++catalog_.nameless_tasks;
    }
  }

  std::vector<Parameter> read_parameters(const Node& node) {
    std::vector<Parameter> parameters;
    const Node* list = yaml::read_list(node, "parameters", "a list of parameters", reporter_);
    if (list == nullptr) return parameters;
    for (const Node* item : list->items) {
      if (!expect_entry(*item, "a parameter", "parameter: NAME")) continue;
      const std::size_t errors = reporter_.errors();
      Fields fields(*item, shape::parameter, reporter_);
      Parameter parameter;
      if (const auto name =
              require_name(fields, "parameter", "the name of a parameter", item->range)) {
        parameter.name = name->text;
        fields.call("parameter " + quote(name->text));
        parameter.range = name->range;
      }
      if (const Node* allowed = fields.find("allowed_values")) {
        read_allowed_values(*allowed, parameter);
      }
      parameter.entry = entry_of(*item, fields, errors);
      fields.report_unknown(yaml::UnknownKeys::ignored);
      parameters.push_back(std::move(parameter));
    }
    return parameters;
  }

  void read_allowed_values(const Node& node, Parameter& parameter) {
    parameter.allowed_range = node.range;
    constexpr std::string_view expected = "a list of values, or the name of a type";
    if (node.kind != Kind::sequence) {
      if (const auto text = yaml::read_text(node, "allowed_values", expected, reporter_)) {
        parameter.allowed_values.emplace_back(*text);
      }
      return;
    }
    parameter.allowed_is_list = true;
    if (!node.items.empty()) parameter.allowed_range = node.items.front()->range;
    for (const Node* item : node.items) {
      if (const auto text =
              yaml::read_text(*item, "allowed_values", "a list of plain values", reporter_)) {
        parameter.allowed_values.emplace_back(*text);
      }
    }
  }

  // Behaviors --------------------------------------------------------------------------------

  std::optional<Percent> read_suitability(const Fields& fields) {
    for (const std::string_view key : {"suitability", "efficacy"}) {
      const Node* node = fields.find(key);
      if (node == nullptr) continue;
      // A suitability that could not be read must exclude nothing.
      return Percent{yaml::read_percent(*node, key, reporter_).value_or(one_million), node->range};
    }
    return std::nullopt;
  }

  std::optional<std::string_view> read_package(const Fields& fields) {
    const Node* node = fields.find("package");
    if (node == nullptr) return std::nullopt;
    return yaml::read_text(*node, "package", "the name of a package", reporter_);
  }

  void read_behavior(const Node& node) {
    if (!expect_entry(node, "a behavior", "behavior: NAME")) {
      ++catalog_.nameless_tasks;
      return;
    }
    Fields fields(node, shape::behavior, reporter_);
    Behavior behavior;
    behavior.name.range = node.range;
    if (const auto name = require_name(fields, "behavior", "the name of a behavior", node.range)) {
      behavior.name = *name;
      fields.call("behavior " + quote(name->text));
    }
    behavior.package = read_value([&] { return read_package(fields); });
    behavior.timeout = read_value([&] { return read_timeout(fields); });
    behavior.suitability = read_value([&] { return read_suitability(fields); });
    read_performed(fields, behavior);
    if (const Node* list = fields.find("requires")) {
      read_requirements(*list, behavior.requirements);
    }
    behavior.situation = fields.find("situation");
    fields.report_unknown(yaml::UnknownKeys::ignored);
    catalog_.behaviors.push_back(std::move(behavior));
  }

  void read_performed(Fields& fields, Behavior& behavior) {
    const Node* list = fields.find("tasks");
    if (fields.find("task") != nullptr && list != nullptr) {
      const bool task_first = fields.range_of("task").begin < fields.range_of("tasks").begin;
      reporter_.report(
          rule::duplicate_key, fields.range_of(task_first ? "tasks" : "task"),
          "'task' and 'tasks' are both given in a behavior",
          {reporter_.note(fields.range_of(task_first ? "task" : "tasks"), "first given here")});
    }
    if (list == nullptr && fields.find("task") == nullptr) list = fields.adopt("tasks");
    if (list != nullptr) {
      read_performances(*list, fields.range_of("tasks"), behavior);
    }
    if (list == nullptr || fields.find("task") != nullptr) {
      const auto task = require_name(fields, "task", task_name, behavior.name.range);
      if (task) {
        behavior.performs.push_back({*task, std::nullopt});
      } else {
        ++catalog_.nameless_tasks;
      }
    }
  }

  void read_performances(const Node& node, const Range& key, Behavior& behavior) {
    const Node* list = yaml::read_list(node, "tasks", "a list of tasks", reporter_);
    if (list == nullptr) {
      ++catalog_.nameless_tasks;
      return;
    }
    if (list->items.empty()) {
      reporter_.report(rule::invalid_value, key, "a behavior must have at least one task");
      ++catalog_.nameless_tasks;
    }
    if (list->items.size() > most_tasks) {
      // Each of them makes a constraint with each requirement of the behavior.
      reporter_.report(rule::invalid_value, key,
                       "a behavior may have at most " + std::to_string(most_tasks) +
                           " tasks, found " + std::to_string(list->items.size()));
    }
    std::unordered_map<std::string_view, Range> known;
    for (const Node* item : list->items) {
      if (!expect_entry(*item, "a task of a behavior", "task: NAME")) {
        ++catalog_.nameless_tasks;
        continue;
      }
      Fields fields(*item, shape::performance, reporter_);
      const auto name = require_name(fields, "task", task_name, item->range);
      const auto suitability = read_value([&] { return read_suitability(fields); });
      fields.report_unknown(yaml::UnknownKeys::ignored);
      if (!name) {
        ++catalog_.nameless_tasks;
        continue;
      }
      const auto [first, is_new] = known.try_emplace(name->text, name->range);
      if (is_new) {
        behavior.performs.push_back({*name, suitability});
      } else {
        reporter_.report(rule::invalid_value, name->range,
                         "task " + quote(name->text) + " is listed twice in one behavior",
                         {reporter_.note(first->second, "first given here")});
      }
    }
  }

  void read_requirements(const Node& node, std::vector<Requirement>& requirements) {
    const Node* list = yaml::read_list(node, "requires", "a list of requirements", reporter_);
    if (list == nullptr) return;
    for (const Node* item : list->items) {
      if (!expect_entry(*item, "a requirement", "task: NAME")) continue;
      const std::size_t errors = reporter_.errors();
      Fields fields(*item, shape::requirement, reporter_);
      const auto name = require_name(fields, "task", task_name, item->range);
      const Percent minimum = read_value([&] { return read_minimum(fields); });
      fields.report_unknown(yaml::UnknownKeys::ignored);
      if (name) requirements.push_back({*name, minimum, entry_of(*item, fields, errors)});
    }
  }

  // Exclusivity ------------------------------------------------------------------------------

  void read_exclusivity_list(const Node& node) {
    if (!expect_entry(node, "an exclusivity constraint", "mutually_exclusive: [A, B]")) return;
    const std::size_t errors = reporter_.errors();
    Fields fields(node, shape::exclusivity_list, reporter_);
    const Node* value = fields.require("mutually_exclusive", node.range);
    const Range range = value == nullptr ? node.range : fields.range_of("mutually_exclusive");
    fields.report_unknown(yaml::UnknownKeys::ignored);
    if (value == nullptr) return;
    const Node* list =
        yaml::read_list(*value, "mutually_exclusive", "a list of names of tasks", reporter_);
    if (list == nullptr) return;
    ExclusivityList result;
    result.range = range;
    for (const Node* item : list->items) {
      if (const auto name =
              yaml::read_name(*item, "mutually_exclusive", "a list of names of tasks", reporter_)) {
        result.tasks.push_back({*name, item->range});
      } else {
        result.is_complete = false;
      }
    }
    result.entry = entry_of(node, fields, errors);
    catalog_.exclusivity.push_back(std::move(result));
  }

  // Common -----------------------------------------------------------------------------------

  bool expect_entry(const Node& node, std::string_view what, std::string_view example) {
    if (node.kind == Kind::mapping) return true;
    reporter_.report(rule::wrong_type, node.range,
                     std::string(what) + " must be a mapping (" + quote(example) + "), found " +
                         yaml::describe(node));
    return false;
  }

  // Where an entry begins, if all of it was understood. `errors`: the number before it was read.
  [[nodiscard]] std::optional<Range> entry_of(const Node& node, const Fields& fields,
                                              std::size_t errors) const {
    if (!fields.is_understood() || reporter_.errors() > errors) return std::nullopt;
    return node.range;
  }

  std::optional<Name> require_name(Fields& fields, std::string_view key, std::string_view expected,
                                   const Range& range) {
    const Node* node = fields.require(key, range);
    if (node == nullptr) return std::nullopt;
    const std::optional<std::string_view> name = yaml::read_name(*node, key, expected, reporter_);
    if (name) return Name{*name, node->range};
    // A list of one name is read as that name, so that it is not reported as undefined elsewhere.
    if (node->items.size() == 1 && node->items[0]->kind == Kind::scalar) {
      return Name{node->items[0]->text, node->items[0]->range};
    }
    return std::nullopt;
  }

  Reporter& reporter_;
  Catalog catalog_;
};

}  // namespace

std::size_t hiding_errors(const Reporter& reporter) {
  return reporter.errors() - reporter.errors(rule::unknown_key);
}

Catalog read(const yaml::Node& root, Reporter& reporter) { return Reader(reporter).read(root); }

}  // namespace cbc::draft
