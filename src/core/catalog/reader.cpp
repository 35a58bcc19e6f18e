#include "core/catalog/reader.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/catalog/draft.h"
#include "core/catalog/situation.h"
#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/support/wording.h"
#include "core/yaml/document.h"
#include "core/yaml/values.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

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

struct Flags {
  bool start_on_request = true;
  bool reactive_start = false;
};

Flags flags_of(const draft::TaskAttributes& own, const draft::TaskAttributes& defaults) {
  Flags flags;
  if (own.reactive_start) {
    flags.reactive_start = own.reactive_start->value;
  } else if (defaults.reactive_start) {
    flags.reactive_start = defaults.reactive_start->value;
  }
  if (own.start_on_request) {
    flags.start_on_request = own.start_on_request->value;
  } else if (own.reactive_start && own.reactive_start->value) {
    flags.start_on_request = false;
  } else if (defaults.start_on_request) {
    flags.start_on_request = defaults.start_on_request->value;
  }
  return flags;
}

std::string name_of(ExecutionGoal goal) {
  return goal == ExecutionGoal::achieve_goal ? "achieve_goal" : "keep_running";
}

std::string name_of(bool flag) { return flag ? "TRUE" : "FALSE"; }

std::string name_of(const std::optional<draft::Timeout>& timeout) {
  return timeout ? format_decimal(timeout->value, 6) + " s" : "none";
}

std::string name_of_minimum(const draft::Percent& minimum) {
  return minimum.value == 0 ? "none" : format_decimal(minimum.value, 4) + " %";
}

bool same_parameters(const std::vector<Parameter>& a, const std::vector<Parameter>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Parameter& x, const Parameter& y) {
                      return x.name == y.name && allow_the_same(x, y);
                    });
}

class Changes {
 public:
  void compare(const std::string& attribute, const std::string& before, const std::string& now) {
    if (before != now) add(attribute + " " + now + ", was " + before);
  }

  void add(const std::string& change) {
    if (!text_.empty()) text_ += "; ";
    text_ += change;
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Completes the attributes of tasks with the defaults.
class TaskAttributes {
 public:
  /// `defaults` must outlive this object.
  TaskAttributes(const draft::TaskAttributes& defaults, Reporter& reporter)
      : defaults_(defaults), reporter_(reporter) {}

  /// Fills in a task from its entry, which stands at `range`. Reports both start flags at once.
  void apply(const Range& range, const draft::TaskAttributes& own, Task& task);

  /// What a later entry of a task changes, in words: "timeout 15 s, was 180 s". Empty if nothing.
  [[nodiscard]] std::string describe_changes(const draft::Task& before,
                                             const draft::Task& now) const;

 private:
  void report_both_flags(const Range& range, const draft::TaskAttributes& own, const Task& task);

  const draft::TaskAttributes& defaults_;
  Reporter& reporter_;
};

void TaskAttributes::apply(const Range& range, const draft::TaskAttributes& own, Task& task) {
  task.is_unclear = own.is_unclear || defaults_.is_unclear;
  const Flags flags = flags_of(own, defaults_);
  task.start_on_request = flags.start_on_request;
  task.reactive_start = flags.reactive_start;
  task.execution_goal =
      own.execution_goal.value_or(defaults_.execution_goal.value_or(ExecutionGoal::achieve_goal));
  if (own.timeout) task.own_timeout_range = own.timeout->range;
  if (const auto& timeout = own.timeout ? own.timeout : defaults_.timeout) {
    task.timeout = timeout->value;
  }
  const bool is_certain = !task.is_unclear || (own.start_on_request && own.reactive_start);
  if (flags.start_on_request && flags.reactive_start && is_certain) {
    report_both_flags(range, own, task);
  }
}

// The place of the finding is the flag that the task itself gives; if it gives none, that of the
// defaults, once for all tasks.
void TaskAttributes::report_both_flags(const Range& range, const draft::TaskAttributes& own,
                                       const Task& task) {
  if (!own.start_on_request && !own.reactive_start) {
    reporter_.report(rule::on_request_and_reactive, defaults_.reactive_start->range,
                     "by default tasks have both reactive_start and start_on_request; one of them "
                     "must be FALSE",
                     {reporter_.note(range, "task " + quote(task.name) + " has both of them")});
    return;
  }
  const std::string message = "task " + quote(task.name) +
                              " has both reactive_start and start_on_request; one of them must be "
                              "FALSE";
  std::vector<Note> notes;
  Range place = range;
  if (own.start_on_request && own.reactive_start) {
    place = std::max(own.reactive_start->range, own.start_on_request->range);
    notes.push_back(reporter_.note(std::min(own.reactive_start->range, own.start_on_request->range),
                                   "the other one is given here"));
  } else if (own.start_on_request) {
    place = own.start_on_request->range;
    notes.push_back(reporter_.note(defaults_.reactive_start->range,
                                   "reactive_start is given here for all tasks"));
  }
  reporter_.report(rule::on_request_and_reactive, place, message, std::move(notes));
}

std::string TaskAttributes::describe_changes(const draft::Task& before,
                                             const draft::Task& now) const {
  const auto goal = [this](const draft::Task& task) {
    return name_of(task.attributes.execution_goal.value_or(
        defaults_.execution_goal.value_or(ExecutionGoal::achieve_goal)));
  };
  const auto timeout = [this](const draft::Task& task) {
    return name_of(task.attributes.timeout ? task.attributes.timeout : defaults_.timeout);
  };
  const Flags old_flags = flags_of(before.attributes, defaults_);
  const Flags new_flags = flags_of(now.attributes, defaults_);
  Changes changes;
  changes.compare("execution_goal", goal(before), goal(now));
  changes.compare("start_on_request", name_of(old_flags.start_on_request),
                  name_of(new_flags.start_on_request));
  changes.compare("reactive_start", name_of(old_flags.reactive_start),
                  name_of(new_flags.reactive_start));
  changes.compare("timeout", timeout(before), timeout(now));
  changes.compare("minimum_performance", name_of_minimum(before.minimum_performance),
                  name_of_minimum(now.minimum_performance));
  if (!same_parameters(before.parameters, now.parameters)) {
    changes.add(now.parameters.empty() ? "no parameters" : "other parameters");
  }
  return changes.text();
}

// Makes a catalog of a draft: gives tasks and behaviors their indices, resolves names, and applies
// defaults.
class Resolver {
 public:
  Resolver(const draft::Catalog& draft, Reporter& reporter)
      : draft_(draft),
        reporter_(reporter),
        attributes_(draft.task_defaults, reporter),
        situation_(reporter) {}

  Catalog resolve() {
    catalog_.has_task_section = draft_.has_task_section;
    catalog_.gives_goals =
        draft_.task_defaults.execution_goal ||
        std::any_of(draft_.tasks.begin(), draft_.tasks.end(), [](const draft::Task& task) {
          return task.attributes.execution_goal.has_value();
        });
    define_listed_tasks();
    define_implicit_tasks();
    read_situation([&] { catalog_.variables = situation_.read_variables(draft_.situation); });
    for (const draft::Behavior& behavior : draft_.behaviors) add_behavior(behavior);
    for (const draft::ExclusivityList& list : draft_.exclusivity) add_exclusivity_list(list);
    report_undefined();
    read_situation([&] { situation_.check_names(catalog_.behaviors); });
    return std::move(catalog_);
  }

  /// The names that the catalog leaves out.
  std::vector<UndefinedTask> undefined_tasks() { return std::move(undefined_tasks_); }
  /// The number of errors about the situation, on which no other entry depends.
  [[nodiscard]] std::size_t situation_errors() const { return situation_errors_; }

 private:
  /// A name that no task has, in a behavior or in an exclusivity list.
  struct Undefined {
    draft::Name name;
    const draft::Behavior* behavior = nullptr;
    const draft::ExclusivityList* list = nullptr;

    [[nodiscard]] std::string where() const {
      if (behavior == nullptr) return "named in an exclusivity list";
      const std::string_view owner = behavior->name.text;
      return "required by " + (owner.empty() ? "a behavior" : "behavior " + quote(owner));
    }

    /// Whether a task is named beside it.
    [[nodiscard]] bool is_beside(std::string_view task) const {
      const auto is_in = [task](const auto& entries, auto name_of_entry) {
        return std::any_of(entries.begin(), entries.end(),
                           [&](const auto& entry) { return name_of_entry(entry).text == task; });
      };
      if (list != nullptr) {
        return is_in(list->tasks, [](const draft::Name& entry) { return entry; });
      }
      return is_in(behavior->requirements, [](const auto& entry) { return entry.task; }) ||
             is_in(behavior->performs, [](const auto& entry) { return entry.task; });
    }
  };

  void define_listed_tasks() {
    std::vector<const draft::Task*> last;  // by task: the entry that counts
    for (const draft::Task& entry : draft_.tasks) {
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

  void report_duplicate_task(const draft::Task& before, const draft::Task& now, const Task& first) {
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

  void define_implicit_tasks() {
    for (const draft::Behavior& behavior : draft_.behaviors) {
      for (const draft::Performance& performance : behavior.performs) {
        const auto index = static_cast<TaskIndex>(catalog_.tasks.size());
        if (!tasks_.try_emplace(performance.task.text, index).second) continue;
        Task task;
        task.name = performance.task.text;
        task.range = performance.task.range;
        task.implicit = true;
        attributes_.apply(task.range, {}, task);
        // It may have an entry, one that could not be read.
        task.is_unclear |= draft_.lacks_a_section || draft_.nameless_tasks > 0;
        catalog_.tasks.push_back(std::move(task));
      }
    }
  }

  template <typename Read>
  void read_situation(const Read& read) {
    const std::size_t errors = reporter_.errors();
    read();
    situation_errors_ += reporter_.errors() - errors;
  }

  void add_behavior(const draft::Behavior& entry) {
    if (!entry.name.text.empty()) {
      const auto [known, is_new] = behaviors_.try_emplace(entry.name.text, entry.name.range);
      if (!is_new) {
        reporter_.report(rule::duplicate_behavior, entry.name.range,
                         "behavior " + quote(entry.name.text) + " is defined twice",
                         {reporter_.note(known->second, "first defined here")});
      }
    }
    Behavior behavior;
    behavior.name = entry.name.text;
    behavior.range = entry.name.range;
    behavior.package = entry.package.value_or(draft_.default_package.value_or(""));
    if (entry.timeout) {
      behavior.timeout = entry.timeout->value;
      behavior.timeout_range = entry.timeout->range;
    }
    for (const draft::Performance& performance : entry.performs) {
      behavior.performs.push_back(resolve(performance, entry));
    }
    for (const draft::Requirement& requirement : entry.requirements) {
      const auto task = find_task({requirement.task, &entry, nullptr});
      if (task) {
        behavior.requirements.push_back({*task, requirement.minimum_performance.value,
                                         requirement.minimum_performance.range,
                                         requirement.task.range, requirement.entry});
      } else {
        undefined_tasks_.push_back({std::string(requirement.task.text),
                                    static_cast<BehaviorIndex>(catalog_.behaviors.size()),
                                    requirement.minimum_performance.value, 0});
      }
    }
    read_situation(
        [&] { behavior.situation = situation_.read_conditions(entry.situation, entry.name.text); });
    if (entry.situation != nullptr)
      behavior.situation_range = range_of_conditions(*entry.situation);
    catalog_.behaviors.push_back(std::move(behavior));
  }

  Performance resolve(const draft::Performance& performance, const draft::Behavior& behavior) {
    Performance resolved;
    resolved.task = tasks_.at(performance.task.text);
    resolved.range = performance.task.range;
    for (const auto* suitability :
         {&performance.suitability, &behavior.suitability, &draft_.default_suitability}) {
      if (!*suitability) continue;
      resolved.suitability = (*suitability)->value;
      resolved.suitability_range = (*suitability)->range;
      break;
    }
    return resolved;
  }

  void add_exclusivity_list(const draft::ExclusivityList& entry) {
    ExclusivityList list;
    list.range = entry.range;
    list.entry = entry.entry;
    list.is_complete = entry.is_complete;
    for (const draft::Name& name : entry.tasks) {
      if (const auto task = find_task({name, nullptr, &entry})) {
        list.tasks.push_back(*task);
        list.ranges.push_back(name.range);
      } else {
        list.entry.reset();
        list.is_complete = false;
        undefined_tasks_.push_back(
            {std::string(name.text), std::nullopt, 0, catalog_.exclusivity.size()});
      }
    }
    catalog_.exclusivity.push_back(std::move(list));
  }

  std::optional<TaskIndex> find_task(const Undefined& use) {
    const auto found = tasks_.find(use.name.text);
    if (found != tasks_.end()) return found->second;
    undefined_.push_back(use);
    return std::nullopt;
  }

  // A name that resembles no other may be defined in a part of the file that was not understood;
  // that mistake has been reported.
  void report_undefined() {
    if (undefined_.empty() || draft_.lacks_a_section) return;
    std::vector<std::string_view> names;
    names.reserve(catalog_.tasks.size());
    for (const Task& task : catalog_.tasks) names.push_back(task.name);
    Suggestions suggestions(std::move(names));
    std::unordered_map<std::string_view, std::optional<std::string_view>> suggested;
    std::size_t strange = 0;
    for (const Undefined& undefined : undefined_) {
      const auto [entry, is_new] = suggested.try_emplace(undefined.name.text);
      if (!is_new) continue;
      entry->second = suggestions.nearest(undefined.name.text);
      if (!entry->second) ++strange;
    }
    std::set<Range> reported;  // aliases give a name several places in the tree
    for (const Undefined& undefined : undefined_) {
      auto suggestion = suggested.at(undefined.name.text);
      if (!suggestion && strange <= draft_.nameless_tasks) continue;
      if (!reported.insert(undefined.name.range).second) continue;
      std::string message =
          "task " + quote(undefined.name.text) + ", " + undefined.where() + ", is not defined";
      if (suggestion && undefined.is_beside(*suggestion)) {
        suggestion = suggestions.nearest(undefined.name.text, [&undefined](std::string_view task) {
          return undefined.is_beside(task);
        });
      }
      if (suggestion) {
        message += did_you_mean(suggestion);
      } else if (behaviors_.contains(undefined.name.text)) {
        message += ": there is a behavior of this name, but no task";
      }
      reporter_.report(rule::undefined_task, undefined.name.range, std::move(message));
    }
  }

  const draft::Catalog& draft_;
  Reporter& reporter_;
  TaskAttributes attributes_;
  SituationReader situation_;
  std::size_t situation_errors_ = 0;
  Catalog catalog_;
  std::unordered_map<std::string_view, TaskIndex> tasks_;
  std::unordered_map<std::string_view, Range> behaviors_;
  std::vector<Undefined> undefined_;
  std::vector<UndefinedTask> undefined_tasks_;
};

}  // namespace

CatalogReading understand_catalog(const yaml::Document& document, Diagnostics& diagnostics) {
  Reporter reporter(document.file(), diagnostics);
  CatalogReading reading;
  const draft::Catalog draft = draft::read(document.root(), reporter);
  Resolver resolver(draft, reporter);
  reading.catalog = resolver.resolve();
  reading.undefined_tasks = resolver.undefined_tasks();
  reading.catalog.file = document.file();
  const std::size_t hiding =
      draft::hiding_errors(reporter) - reporter.errors(rule::on_request_and_reactive);
  reading.is_complete = hiding == 0;
  reading.has_all_names = hiding == draft.value_errors + resolver.situation_errors();
  reading.has_all_behaviors = !draft.lacks_a_section && draft.nameless_tasks == 0 &&
                              reporter.errors(rule::duplicate_key) == 0;
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
