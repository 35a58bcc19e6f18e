#include "core/catalog/reader.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/catalog/no_catalog.h"
#include "core/catalog/shape.h"
#include "core/catalog/situation.h"
#include "core/catalog/task_attributes.h"
#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/support/wording.h"
#include "core/yaml/document.h"
#include "core/yaml/values.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

using yaml::Fields;
using yaml::Kind;
using yaml::Node;

/// From the beginning of the conditions of a behavior to the end of the last one.
Range range_of_conditions(const yaml::Node& conditions) {
  Range range = conditions.range;
  const auto extend = [&range](const yaml::Node& part) {
    range.end = std::max(range.end, part.range.end);
  };
  for (const auto& [key, value] : conditions.entries) {
    extend(*key);
    extend(*value);
    for (const yaml::Node* item : value->items) extend(*item);
  }
  return range;
}

constexpr std::size_t most_tasks = 100;  // of one behavior

/// The number of errors that left something of the file out. Where a key is unknown, the rest is
/// understood as if it were not there.
std::size_t hiding_errors(const Reporter& reporter) {
  return reporter.errors() - reporter.errors(rule::unknown_key);
}

/// Reads a catalog, section by section: entries get their indices, and defaults are applied. Names
/// of tasks in requirements and exclusivity lists are resolved last, when all tasks are known.
class Reader {
 public:
  Reader(const yaml::Document& document, Reporter& reporter)
      : document_(document),
        reporter_(reporter),
        attributes_(task_defaults_, reporter),
        situation_(names_, reporter) {}

  CatalogReading read() && {
    if (report_no_catalog(document_, reporter_)) {
      lacks_a_section_ = true;
    } else {
      read_sections(document_.root());
    }
    resolve_names();
    CatalogReading reading;
    const std::size_t hiding =
        hiding_errors(reporter_) - reporter_.errors(rule::on_request_and_reactive) -
        reporter_.errors(rule::unrequestable) - reporter_.errors(rule::cannot_resume) -
        reporter_.errors(rule::priority_without_reaction);
    reading.is_complete = hiding == 0;
    reading.has_all_names = hiding == value_errors_ + situation_errors_;
    const auto without_task = static_cast<std::size_t>(std::count_if(
        catalog_.behaviors.begin(), catalog_.behaviors.end(), [](const Behavior& behavior) {
          return behavior.performs.empty() && !behavior.name.empty();
        }));
    reading.has_all_behaviors = !lacks_a_section_ && nameless_tasks_ == without_task &&
                                reporter_.errors(rule::duplicate_key) == 0;
    reading.catalog = std::move(catalog_);
    reading.undefined_tasks = std::move(undefined_);
    reading.names = std::move(names_);
    reading.numbers = std::move(numbers_);
    return reading;
  }

 private:
  // Counts the errors that `read` reports as errors in values.
  template <typename Read>
  auto read_value(Read read) {
    const std::size_t errors = hiding_errors(reporter_);
    auto value = read();
    value_errors_ += hiding_errors(reporter_) - errors;
    return value;
  }

  // The same for errors about the situation, on which no other entry depends either.
  template <typename Read>
  void read_situation(const Read& read) {
    const std::size_t errors = reporter_.errors();
    read();
    situation_errors_ += reporter_.errors() - errors;
  }

  void read_sections(const Node& root) {
    Fields fields(root, shape::catalog, reporter_);
    // If a section is given twice, only the first is read.
    lacks_a_section_ = reporter_.errors(rule::duplicate_key) > 0;
    if (const Node* node = fields.find("default_values")) read_default_values(*node);
    if (const Node* node = fields.find("tasks")) {
      catalog_.has_task_section = true;
      lacks_a_section_ |= !read_entries(*node, "tasks", "a list of tasks", &Reader::read_task);
    }
    define_listed_tasks();
    read_situation(
        [&] { catalog_.variables = situation_.read_variables(fields.find("situation")); });
    if (const Node* node = fields.require("behaviors", root.range)) {
      lacks_a_section_ |=
          !read_entries(*node, "behaviors", "a list of behaviors", &Reader::read_behavior);
    } else {
      lacks_a_section_ = true;
    }
    if (const Node* node = fields.find("exclusivity_constraints")) {
      read_entries(*node, "exclusivity_constraints", "a list of 'mutually_exclusive' lists",
                   &Reader::read_exclusivity_list);
    }
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
      task_defaults_ = read_attributes(defaults);
      defaults.report_unknown(yaml::UnknownKeys::ignored);
    }
    if (const Node* behaviors = fields.find("behaviors")) {
      Fields defaults(mappings_of(*behaviors, "behaviors"), shape::behavior_defaults, reporter_);
      default_suitability_ = read_value([&] { return read_suitability(defaults); });
      if (default_suitability_) numbers_.back().is_default = true;
      default_package_ = read_value([&] { return read_package(defaults); });
      default_retry_ = read_value([&] { return read_retry(defaults); });
      defaults.report_unknown(yaml::UnknownKeys::ignored);
    }
    fields.report_unknown(yaml::UnknownKeys::ignored);
  }

  // Tasks ------------------------------------------------------------------------------------

  GivenAttributes read_attributes(const Fields& fields) {
    return read_value([&] { return read_flags_and_timeout(fields); });
  }

  GivenAttributes read_flags_and_timeout(const Fields& fields) {
    const std::size_t errors = reporter_.errors();
    GivenAttributes attributes;
    attributes.execution_goal = read_execution_goal(fields);
    attributes.start_on_request = read_flag(fields, "start_on_request");
    if (auto automatic = read_flag(fields, "automatic_activation")) {
      automatic->value = !automatic->value;
      attributes.start_on_request = automatic;
    }
    attributes.reactive_start = read_flag(fields, "reactive_start");
    if (const auto older = read_flag(fields, "default")) attributes.reactive_start = older;
    attributes.timeout = read_timeout(fields);
    if (const Node* node = fields.find("improve")) {
      const auto place = yaml::read_choice(*node, "improve", improve_words, reporter_);
      if (place) attributes.improve = Placed<Improve>{static_cast<Improve>(*place), node->range};
    }
    attributes.resume = read_flag(fields, "resume");
    attributes.requestable = read_flag(fields, "requestable");
    if (const Node* node = fields.find("reactive_priority")) {
      const auto number = yaml::read_integer(*node, "reactive_priority", 0, reporter_);
      if (number) attributes.reactive_priority = Placed<std::int32_t>{*number, node->range};
    }
    attributes.is_unclear = reporter_.errors() > errors;
    attributes.has_unknown_key = fields.has_unknown();
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
    const Millionths minimum =
        yaml::read_percent(*node, "minimum_performance", reporter_).value_or(0);
    numbers_.push_back({NumberPlace::Kind::minimum_performance, false, minimum, node->range});
    return {minimum, node->range};
  }

  void read_task(const Node& node) {
    if (!expect_entry(node, "a task", "task: NAME")) {
      // A bare name is understood, so that it is not reported as undefined elsewhere.
      if (node.kind == Kind::scalar && !node.text.empty()) {
        task_entries_.push_back({{node.text, node.range}, {}, {}, {}, {}});
      } else {
        ++nameless_tasks_;
      }
      return;
    }
    const std::size_t errors = reporter_.errors();
    Fields fields(node, shape::task, reporter_);
    TaskEntry task;
    const auto name = require_name(fields, NameKind::task, node.range);
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
      task_entries_.push_back(std::move(task));
    } else {
      ++nameless_tasks_;
    }
  }

  void define_listed_tasks() {
    catalog_.gives_goals =
        task_defaults_.execution_goal ||
        std::any_of(task_entries_.begin(), task_entries_.end(), [](const TaskEntry& entry) {
          return entry.attributes.execution_goal.has_value();
        });
    std::vector<const TaskEntry*> last;  // by task: the entry that counts
    for (const TaskEntry& entry : task_entries_) {
      const auto index = static_cast<TaskIndex>(last.size());
      const auto [known, is_new] = tasks_.try_emplace(entry.name.text, index);
      if (is_new) {
        Task task;
        task.name = entry.name.text;
        task.range = entry.name.range;
        catalog_.tasks.push_back(std::move(task));
        last.push_back(&entry);
      } else {
        report_duplicate_task(*last[known->second], entry, catalog_.tasks[known->second]);
        last[known->second] = &entry;
      }
    }
    for (std::size_t index = 0; index < last.size(); ++index) {
      Task& task = catalog_.tasks[index];
      attributes_.apply(last[index]->name.range, last[index]->attributes, task);
      task.minimum_performance = last[index]->minimum_performance.value;
      task.minimum_performance_range = last[index]->minimum_performance.range;
      task.parameters = last[index]->parameters;
    }
  }

  void report_duplicate_task(const TaskEntry& before, const TaskEntry& now, const Task& first) {
    std::string message = "task " + quote(now.name.text) + " is listed twice";
    const std::string changes = attributes_.describe_changes(before, now);
    std::vector<Edit> edits;
    if (changes.empty()) {
      message += ", with the same attributes";
      if (now.entry) edits.push_back({Edit::Kind::remove_entry, *now.entry, {}});
    } else {
      message += "; the last entry counts: " + changes;
    }
    reporter_.report(rule::duplicate_task, now.name.range, std::move(message),
                     {reporter_.note(first.range, "first listed here")}, std::move(edits));
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
              require_text(fields, "parameter", "the name of a parameter", item->range)) {
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
      const Millionths value = yaml::read_percent(*node, key, reporter_).value_or(one_million);
      numbers_.push_back({NumberPlace::Kind::suitability, false, value, node->range});
      return Percent{value, node->range};
    }
    return std::nullopt;
  }

  std::optional<std::string_view> read_package(const Fields& fields) {
    const Node* node = fields.find("package");
    if (node == nullptr) return std::nullopt;
    return yaml::read_text(*node, "package", "the name of a package", reporter_);
  }

  std::optional<Placed<Retry>> read_retry(const Fields& fields) {
    const Node* node = fields.find("retry");
    if (node == nullptr) return std::nullopt;
    const auto place = yaml::read_choice(*node, "retry", retry_words, reporter_);
    if (!place) return std::nullopt;
    return Placed<Retry>{static_cast<Retry>(*place), node->range};
  }

  void read_behavior(const Node& node) {
    if (!expect_entry(node, "a behavior", "behavior: NAME")) {
      ++nameless_tasks_;
      return;
    }
    Fields fields(node, shape::behavior, reporter_);
    Behavior behavior;
    behavior.range = node.range;
    if (const auto name = require_name(fields, NameKind::behavior, node.range)) {
      behavior.name = name->text;
      behavior.range = name->range;
      fields.call("behavior " + quote(name->text));
      report_duplicate_behavior(*name);
    }
    const auto package = read_value([&] { return read_package(fields); });
    behavior.package = package.value_or(default_package_.value_or(""));
    if (const auto timeout = read_value([&] { return read_timeout(fields); })) {
      behavior.timeout = timeout->value;
      behavior.timeout_range = timeout->range;
    }
    const auto retry = read_value([&] { return read_retry(fields); });
    if (const auto& given = retry ? retry : default_retry_) {
      behavior.retry = given->value;
      behavior.retry_range = given->range;
    }
    read_performed(fields, behavior);
    std::vector<std::string_view> required;
    if (const Node* list = fields.find("requires")) {
      required = read_requirements(*list, behavior.requirements);
    }
    required_.push_back(std::move(required));
    if (const Node* conditions = fields.find("situation")) {
      read_situation(
          [&] { behavior.situation = situation_.read_conditions(conditions, behavior.name); });
      behavior.situation_range = range_of_conditions(*conditions);
    }
    fields.report_unknown(yaml::UnknownKeys::ignored);
    catalog_.behaviors.push_back(std::move(behavior));
  }

  void report_duplicate_behavior(const Name& name) {
    const auto [known, is_new] = behaviors_.try_emplace(name.text, name.range);
    if (is_new) return;
    reporter_.report(rule::duplicate_behavior, name.range,
                     "behavior " + quote(name.text) + " is defined twice",
                     {reporter_.note(known->second, "first defined here")});
  }

  void read_performed(Fields& fields, Behavior& behavior) {
    const auto suitability = read_value([&] { return read_suitability(fields); });
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
      read_performances(*list, fields.range_of("tasks"), suitability, behavior);
    }
    if (list == nullptr || fields.find("task") != nullptr) {
      const auto task = require_name(fields, NameKind::task, behavior.range);
      if (task) {
        behavior.performs.push_back(performance_of(*task, {}, suitability));
      } else {
        ++nameless_tasks_;
      }
    }
  }

  /// `own`, `of_behavior`: the suitabilities that are given for the task, for all of the behavior.
  Performance performance_of(const Name& task, const std::optional<Percent>& own,
                             const std::optional<Percent>& of_behavior) {
    Performance performance;
    performance.task = task_performed(task);
    performance.range = task.range;
    const auto& given = own ? own : of_behavior ? of_behavior : default_suitability_;
    if (given) {
      performance.suitability = given->value;
      performance.suitability_range = given->range;
    }
    return performance;
  }

  /// A task without an entry is defined by the first behavior that performs it.
  TaskIndex task_performed(const Name& name) {
    const auto index = static_cast<TaskIndex>(catalog_.tasks.size());
    const auto [known, is_new] = tasks_.try_emplace(name.text, index);
    if (!is_new) return known->second;
    Task task;
    task.name = name.text;
    task.range = name.range;
    task.implicit = true;
    attributes_.apply(task.range, {}, task);
    catalog_.tasks.push_back(std::move(task));
    return index;
  }

  void read_performances(const Node& node, const Range& key,
                         const std::optional<Percent>& of_behavior, Behavior& behavior) {
    const Node* list = yaml::read_list(node, "tasks", "a list of tasks", reporter_);
    if (list == nullptr) {
      ++nameless_tasks_;
      return;
    }
    if (list->items.empty()) {
      reporter_.report(rule::invalid_value, key, "a behavior must have at least one task");
      ++nameless_tasks_;
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
        ++nameless_tasks_;
        continue;
      }
      Fields fields(*item, shape::performance, reporter_);
      const auto name = require_name(fields, NameKind::task, item->range);
      const auto suitability = read_value([&] { return read_suitability(fields); });
      fields.report_unknown(yaml::UnknownKeys::ignored);
      if (!name) {
        ++nameless_tasks_;
        continue;
      }
      const auto [first, is_new] = known.try_emplace(name->text, name->range);
      if (is_new) {
        behavior.performs.push_back(performance_of(*name, suitability, of_behavior));
      } else {
        reporter_.report(rule::invalid_value, name->range,
                         "task " + quote(name->text) + " is listed twice in one behavior",
                         {reporter_.note(first->second, "first given here")});
      }
    }
  }

  /// Returns the names of the tasks, which are not known yet.
  std::vector<std::string_view> read_requirements(const Node& node,
                                                  std::vector<Requirement>& requirements) {
    std::vector<std::string_view> names;
    const Node* list = yaml::read_list(node, "requires", "a list of requirements", reporter_);
    if (list == nullptr) return names;
    for (const Node* item : list->items) {
      if (!expect_entry(*item, "a requirement", "task: NAME")) continue;
      const std::size_t errors = reporter_.errors();
      Fields fields(*item, shape::requirement, reporter_);
      const auto name = require_name(fields, NameKind::task, item->range);
      const Percent minimum = read_value([&] { return read_minimum(fields); });
      fields.report_unknown(yaml::UnknownKeys::ignored);
      if (!name) continue;
      names.push_back(name->text);
      requirements.push_back(
          {0, minimum.value, minimum.range, name->range, entry_of(*item, fields, errors)});
    }
    return names;
  }

  // Exclusivity ------------------------------------------------------------------------------

  void read_exclusivity_list(const Node& node) {
    if (!expect_entry(node, "an exclusivity constraint", "mutually_exclusive: [A, B]")) return;
    const std::size_t errors = reporter_.errors();
    Fields fields(node, shape::exclusivity_list, reporter_);
    const Node* value = fields.require("mutually_exclusive", node.range);
    const Range range = value == nullptr ? node.range : fields.range_of("mutually_exclusive");
    const Node* const most = fields.find("at_most");
    const auto at_most = most == nullptr ? std::optional<std::int32_t>() : read_value([&] {
      return yaml::read_integer(*most, "at_most", 1, reporter_);
    });
    fields.report_unknown(yaml::UnknownKeys::ignored);
    if (value == nullptr) return;
    const Node* list =
        yaml::read_list(*value, "mutually_exclusive", "a list of names of tasks", reporter_);
    if (list == nullptr) return;
    ExclusivityList result;
    result.range = range;
    if (most != nullptr) {
      // A limit that could not be read must exclude nothing.
      result.at_most = at_most ? static_cast<std::uint32_t>(*at_most) : UINT32_MAX;
      result.at_most_range = most->range;
    }
    std::vector<std::string_view> names;
    for (const Node* item : list->items) {
      if (const auto name =
              yaml::read_name(*item, "mutually_exclusive", "a list of names of tasks", reporter_)) {
        names.push_back(*name);
        names_.push_back({NameKind::task, item->range});
        result.ranges.push_back(item->range);
      } else {
        result.is_complete = false;
      }
    }
    result.entry = entry_of(node, fields, errors);
    catalog_.exclusivity.push_back(std::move(result));
    excluded_.push_back(std::move(names));
  }

  // Names ------------------------------------------------------------------------------------

  void resolve_names() {
    // It may have an entry, one that could not be read.
    const bool may_lack_entries = lacks_a_section_ || nameless_tasks_ > 0;
    for (Task& task : catalog_.tasks) task.is_unclear |= task.implicit && may_lack_entries;
    for (BehaviorIndex index = 0; index < catalog_.behaviors.size(); ++index) {
      resolve_requirements(index);
    }
    for (std::size_t list = 0; list < catalog_.exclusivity.size(); ++list) resolve_list(list);
    report_undefined();
    read_situation([&] { situation_.check_names(catalog_.behaviors); });
  }

  void resolve_requirements(BehaviorIndex index) {
    std::vector<Requirement>& requirements = catalog_.behaviors[index].requirements;
    std::vector<Requirement> known;
    for (std::size_t place = 0; place < requirements.size(); ++place) {
      Requirement& requirement = requirements[place];
      const std::string_view name = required_[index][place];
      if (const auto task = tasks_.find(name); task != tasks_.end()) {
        requirement.task = task->second;
        known.push_back(requirement);
      } else {
        undefined_.push_back(
            {std::string(name), requirement.range, index, requirement.minimum_performance, 0});
      }
    }
    requirements = std::move(known);
  }

  void resolve_list(std::size_t place) {
    ExclusivityList& list = catalog_.exclusivity[place];
    const std::vector<Range> ranges = std::exchange(list.ranges, {});
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const std::string_view name = excluded_[place][i];
      if (const auto task = tasks_.find(name); task != tasks_.end()) {
        list.tasks.push_back(task->second);
        list.ranges.push_back(ranges[i]);
      } else {
        list.entry.reset();
        list.is_complete = false;
        undefined_.push_back({std::string(name), ranges[i], std::nullopt, 0, place});
      }
    }
  }

  [[nodiscard]] std::string place_of(const UndefinedTask& undefined) const {
    if (!undefined.behavior) return "named in an exclusivity list";
    return "required by " + describe(catalog_.behaviors[*undefined.behavior]);
  }

  /// Whether a task is named beside one that is not defined.
  [[nodiscard]] bool is_beside(const UndefinedTask& undefined, std::string_view task) const {
    const auto& names =
        undefined.behavior ? required_[*undefined.behavior] : excluded_[undefined.list];
    if (std::find(names.begin(), names.end(), task) != names.end()) return true;
    if (!undefined.behavior) return false;
    const auto& performs = catalog_.behaviors[*undefined.behavior].performs;
    return std::any_of(performs.begin(), performs.end(), [&](const Performance& performance) {
      return catalog_.tasks[performance.task].name == task;
    });
  }

  // A name that resembles no other may be defined in a part of the file that was not understood;
  // that mistake has been reported.
  void report_undefined() {
    if (undefined_.empty() || lacks_a_section_) return;
    std::vector<std::string_view> names;
    names.reserve(catalog_.tasks.size());
    for (const Task& task : catalog_.tasks) names.push_back(task.name);
    Suggestions suggestions(std::move(names));
    std::unordered_map<std::string_view, std::optional<std::string_view>> suggested;
    std::size_t strange = 0;
    for (const UndefinedTask& undefined : undefined_) {
      const auto [entry, is_new] = suggested.try_emplace(undefined.name);
      if (!is_new) continue;
      entry->second = suggestions.nearest(undefined.name);
      if (!entry->second) ++strange;
    }
    std::set<Range> reported;  // aliases give a name several places in the tree
    for (const UndefinedTask& undefined : undefined_) {
      auto suggestion = suggested.at(undefined.name);
      if (!suggestion && strange <= nameless_tasks_) continue;
      if (!reported.insert(undefined.range).second) continue;
      std::string message =
          "task " + quote(undefined.name) + ", " + place_of(undefined) + ", is not defined";
      if (suggestion && is_beside(undefined, *suggestion)) {
        suggestion = suggestions.nearest(
            undefined.name, [&](std::string_view task) { return is_beside(undefined, task); });
      }
      if (suggestion) {
        message += did_you_mean(suggestion);
      } else if (behaviors_.contains(undefined.name)) {
        message += ": there is a behavior of this name, but no task";
      }
      reporter_.report(rule::undefined_task, undefined.range, std::move(message));
    }
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

  // The name that an entry gives to what it defines, or by which it refers to something else.
  std::optional<Name> require_name(Fields& fields, NameKind kind, const Range& range) {
    const std::string expected = concat("the name of a ", name_of(kind));
    const auto name = require_text(fields, name_of(kind), expected, range);
    if (name) names_.push_back({kind, name->range});
    return name;
  }

  std::optional<Name> require_text(Fields& fields, std::string_view key, std::string_view expected,
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

  const yaml::Document& document_;
  Reporter& reporter_;
  GivenAttributes task_defaults_;
  std::optional<std::string_view> default_package_;
  std::optional<Percent> default_suitability_;
  std::optional<Placed<Retry>> default_retry_;
  TaskAttributes attributes_;
  std::vector<NamePlace> names_;
  std::vector<NumberPlace> numbers_;
  SituationReader situation_;
  std::vector<TaskEntry> task_entries_;
  Catalog catalog_;
  std::unordered_map<std::string_view, TaskIndex> tasks_;
  std::unordered_map<std::string_view, Range> behaviors_;
  /// The tasks that each behavior requires, that each list has.
  std::vector<std::vector<std::string_view>> required_;
  std::vector<std::vector<std::string_view>> excluded_;
  std::vector<UndefinedTask> undefined_;
  /// A section that defines tasks could not be read completely, so a task without a definition is
  /// no finding.
  bool lacks_a_section_ = false;
  /// Entries that define tasks whose names could not be read.
  std::size_t nameless_tasks_ = 0;
  /// Errors in values that no other entry depends on: flags, timeouts, percentages, parameters.
  std::size_t value_errors_ = 0;
  std::size_t situation_errors_ = 0;
};

}  // namespace

CatalogReading understand_catalog(const yaml::Document& document, Diagnostics& diagnostics) {
  Reporter reporter(document.file(), diagnostics);
  CatalogReading reading = Reader(document, reporter).read();
  reading.catalog.file = document.file();
  check_requirement_cycles(reading.catalog, reporter);
  reading.is_acyclic = reporter.errors(rule::requirement_cycle) == 0;
  check_exclusive_requirements(reading.catalog, reporter);
  return reading;
}

std::optional<Catalog> read_catalog(const yaml::Document& document, Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.count(Severity::error);
  CatalogReading reading = understand_catalog(document, diagnostics);
  if (diagnostics.count(Severity::error) > errors) return std::nullopt;
  return std::move(reading.catalog);
}

std::optional<Catalog> read_catalog(std::string_view text, std::string file,
                                    Diagnostics& diagnostics) {
  const auto document = yaml::parse(text, std::move(file), diagnostics);
  if (document == nullptr) return std::nullopt;
  return read_catalog(*document, diagnostics);
}

}  // namespace cbc
