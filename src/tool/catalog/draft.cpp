#include "catalog/draft.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/text.h"
#include "catalog/reader.h"
#include "diagnostic/rules.h"
#include "yaml/values.h"

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
    } else {
      read_sections(root);
    }
    return std::move(catalog_);
  }

 private:
  // Counts errors of `read` as such of values.
  template <typename Read>
  auto read_value(Read read) {
    const std::size_t errors = reporter_.errors();
    auto value = read();
    catalog_.value_errors += reporter_.errors() - errors;
    return value;
  }

  void read_sections(const Node& root) {
    Fields fields(root, shape::catalog, reporter_);
    // Of a section that is given twice only the first part is read.
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
    fields.report_unknown(Severity::warning);
  }

  bool read_entries(const Node& node, std::string_view key, std::string_view expected,
                    void (Reader::*read_entry)(const Node&)) {
    const Node* list = yaml::read_list(node, key, expected, reporter_);
    if (list == nullptr) return false;
    for (const Node* entry : list->items) (this->*read_entry)(*entry);
    return true;
  }

  // Default values ---------------------------------------------------------------------------

  // The mappings of a list, or a single one. Published files write one key to a list entry.
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
      defaults.report_unknown(Severity::warning);
    }
    if (const Node* behaviors = fields.find("behaviors")) {
      Fields defaults(mappings_of(*behaviors, "behaviors"), shape::behavior_defaults, reporter_);
      catalog_.default_suitability = read_value([&] { return read_suitability(defaults); });
      catalog_.default_package = read_value([&] { return read_package(defaults); });
      defaults.report_unknown(Severity::warning);
    }
    fields.report_unknown(Severity::warning);
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
    fields.report_unknown(Severity::warning);
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
      fields.report_unknown(Severity::warning);
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
      // What could not be read excludes nothing.
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
    fields.report_unknown(Severity::warning);
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
      // Each of them with each requirement of the behavior is a constraint.
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
      fields.report_unknown(Severity::warning);
      if (!name) {
        ++catalog_.nameless_tasks;
        continue;
      }
      const auto [first, is_new] = known.try_emplace(name->text, name->range);
      if (is_new) {
        behavior.performs.push_back({*name, suitability});
      } else {
        reporter_.report(rule::invalid_value, name->range,
                         "task " + quote(name->text) + " stands twice in one behavior",
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
      fields.report_unknown(Severity::warning);
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
    fields.report_unknown(Severity::warning);
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

  // Where an entry begins, if all that it says was understood; `errors` are those before it.
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
    // A list of one name is understood, so that the name is not reported as undefined elsewhere.
    if (node->items.size() == 1 && node->items[0]->kind == Kind::scalar) {
      return Name{node->items[0]->text, node->items[0]->range};
    }
    return std::nullopt;
  }

  Reporter& reporter_;
  Catalog catalog_;
};

}  // namespace

Catalog read(const yaml::Node& root, Reporter& reporter) { return Reader(reporter).read(root); }

}  // namespace cbc::draft

namespace cbc {
namespace {

bool same_allowed(const Parameter& a, const Parameter& b) {
  return a.allowed_is_list == b.allowed_is_list && a.allowed_values == b.allowed_values;
}

/// The parameters of a task, without those that repeat the last one of their name.
std::vector<const Parameter*> without_repetitions(const Task& task) {
  std::vector<const Parameter*> parameters;
  std::map<std::string_view, const Parameter*> last;
  for (const Parameter& parameter : task.parameters) {
    const Parameter*& before = last[parameter.name];
    if (before == nullptr || !same_allowed(*before, parameter)) parameters.push_back(&parameter);
    before = &parameter;
  }
  return parameters;
}

bool same_parameters(const Task& a, const Task& b) {
  const std::vector<const Parameter*> of_a = without_repetitions(a);
  const std::vector<const Parameter*> of_b = without_repetitions(b);
  return std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
                    [](const Parameter* x, const Parameter* y) {
                      return x->name == y->name && same_allowed(*x, *y);
                    });
}

bool same_task(const Task& a, const Task& b) {
  return a.name == b.name && a.implicit == b.implicit && a.execution_goal == b.execution_goal &&
         a.start_on_request == b.start_on_request && a.reactive_start == b.reactive_start &&
         a.timeout == b.timeout && a.minimum_performance == b.minimum_performance &&
         same_parameters(a, b);
}

/// What a behavior requires of each task: the highest of the minimums.
std::map<TaskIndex, Millionths> requirements_of(const Behavior& behavior) {
  std::map<TaskIndex, Millionths> requirements;
  for (const Requirement& requirement : behavior.requirements) {
    Millionths& minimum = requirements[requirement.task];
    minimum = std::max(minimum, requirement.minimum_performance);
  }
  return requirements;
}

bool same_behavior(const Behavior& a, const Behavior& b) {
  const bool same_performs =
      std::equal(a.performs.begin(), a.performs.end(), b.performs.begin(), b.performs.end(),
                 [](const Performance& x, const Performance& y) {
                   return x.task == y.task && x.suitability == y.suitability;
                 });
  return same_performs && a.name == b.name && a.package == b.package && a.timeout == b.timeout &&
         requirements_of(a) == requirements_of(b);
}

/// The tasks of one list, ascending, each once.
using Clique = std::vector<TaskIndex>;

std::set<Clique> cliques_of(const Catalog& catalog) {
  std::set<Clique> cliques;
  for (const ExclusivityList& list : catalog.exclusivity) {
    Clique clique = list.tasks;
    std::sort(clique.begin(), clique.end());
    clique.erase(std::unique(clique.begin(), clique.end()), clique.end());
    if (clique.size() > 1) cliques.insert(std::move(clique));
  }
  return cliques;
}

/// Whether each of some cliques is one of `others`, or a part of one.
bool are_contained(const std::set<Clique>& cliques, const std::set<Clique>& others,
                   std::size_t tasks) {
  std::vector<std::vector<const Clique*>> others_of(tasks);
  for (const Clique& other : others) {
    for (const TaskIndex task : other) others_of[task].push_back(&other);
  }
  return std::all_of(cliques.begin(), cliques.end(), [&](const Clique& clique) {
    if (others.contains(clique)) return true;
    const TaskIndex rarest = *std::min_element(
        clique.begin(), clique.end(),
        [&](TaskIndex a, TaskIndex b) { return others_of[a].size() < others_of[b].size(); });
    return std::any_of(
        others_of[rarest].begin(), others_of[rarest].end(), [&clique](const Clique* other) {
          return std::includes(other->begin(), other->end(), clique.begin(), clique.end());
        });
  });
}

}  // namespace

bool same_meaning(const Catalog& a, const Catalog& b) {
  if (!std::equal(a.tasks.begin(), a.tasks.end(), b.tasks.begin(), b.tasks.end(), same_task)) {
    return false;
  }
  if (!std::equal(a.behaviors.begin(), a.behaviors.end(), b.behaviors.begin(), b.behaviors.end(),
                  same_behavior)) {
    return false;
  }
  const std::set<Clique> of_a = cliques_of(a);
  const std::set<Clique> of_b = cliques_of(b);
  return are_contained(of_a, of_b, a.tasks.size()) && are_contained(of_b, of_a, a.tasks.size());
}

}  // namespace cbc
