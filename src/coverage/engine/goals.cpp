#include "coverage/engine/goals.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "runtime/base/text.h"

namespace cbc {
namespace {

/// What is known of the goals of a kind. A text names what a goal is about in braces.
struct KindOfGoal {
  std::string_view name;
  GoalSection section;
  std::string_view sentence;
  std::string_view words;  ///< in the name of a mission
};

/// In the order of the enumerators.
constexpr std::array<KindOfGoal, Goal::kinds> goal_kinds{{
    {"task_ran", GoalSection::tasks, "task {task} ran", "{task} runs"},
    {"behavior_active", GoalSection::behaviors, "behavior {behavior} was active",
     "{behavior} is active"},
    {"behavior_succeeded", GoalSection::behaviors, "behavior {behavior} achieved its goal",
     "{behavior} succeeds"},
    {"behavior_failed", GoalSection::behaviors, "behavior {behavior} failed", "{behavior} fails"},
    {"behavior_replaced", GoalSection::behaviors, "behavior {behavior} was replaced",
     "{behavior} is replaced"},
    {"failure_remembered", GoalSection::behaviors,
     "behavior {behavior} failed, and was not tried again", "{behavior} is not tried again"},
    {"requirement_used", GoalSection::requirements,
     "{behavior} was active with {task}, which it requires", "{behavior} with {task}"},
    {"requirement_decided", GoalSection::requirements, "it matters that {behavior} requires {task}",
     "{behavior} requires {task}"},
    {"minimum_decided", GoalSection::minimums,
     "the minimum that {behavior} requires of {task} matters", "minimum of {task} {behavior}"},
    {"exclusion_decided", GoalSection::exclusions, "it matters that {task} excludes {other}",
     "{task} excludes {other}"},
    {"timeout_fired", GoalSection::timeouts, "behavior {behavior} ran into its timeout",
     "{behavior} times out"},
    {"reactive_started", GoalSection::reactive, "task {task} started by itself",
     "{task} starts by itself"},
    {"reactive_gave_way", GoalSection::reactive, "task {task} gave way", "{task} gives way"},
    {"reactive_returned", GoalSection::reactive, "task {task} returned by itself after it gave way",
     "{task} returns"},
    {"variable_value", GoalSection::situation, "{variable} was {value}", "{variable} is {value}"},
    {"behavior_began_to_fit", GoalSection::situation,
     "behavior {behavior} began to fit the situation", "{behavior} begins to fit"},
    {"behavior_ceased_to_fit", GoalSection::situation,
     "behavior {behavior} ceased to fit while active", "{behavior} ceases to fit"},
    {"improved_at_once", GoalSection::situation, "task {task} improved at once",
     "{task} improves at once"},
    {"higher_displaced", GoalSection::priorities, "a start of {task} displaced a lower priority",
     "{task} displaces lower"},
    {"lower_rejected", GoalSection::priorities,
     "a start of {task} was rejected for a higher priority", "{task} yields to higher"},
    {"equal_displaced", GoalSection::priorities, "a start of {task} displaced an equal priority",
     "{task} displaces equal"},
    {"request_suspended", GoalSection::priorities, "the request of {task} was suspended",
     "{task} waits"},
    {"request_resumed", GoalSection::priorities, "task {task} resumed", "{task} resumes"},
}};
// Goals that may be about a task alone.
constexpr std::string_view sentence_of_minimum = "the minimum of {task} matters";
constexpr std::string_view sentence_of_timeout = "task {task} ran into its timeout";
constexpr std::string_view words_of_timeout = "{task} times out";

constexpr const KindOfGoal& row_of(Goal::Kind kind) {
  return goal_kinds[static_cast<std::size_t>(kind)];
}

/// Fills in the names, each as `show` has it.
template <typename Show>
std::string fill_in(std::string_view text, const CompiledCatalog& catalog, const Goal& goal,
                    Show show) {
  using Name = decltype(show(std::string_view()));
  const auto task = [&](TaskId id) { return id == none ? Name() : show(catalog.name_of_task(id)); };
  const bool has_value = goal.variable != none;
  return fmt::format(
      fmt::runtime(text), fmt::arg("task", task(goal.task)),
      fmt::arg("other", task(goal.other_task)),
      fmt::arg("behavior",
               goal.behavior == none ? Name() : show(catalog.name_of_behavior(goal.behavior))),
      fmt::arg("variable", has_value ? show(catalog.name_of_variable(goal.variable)) : Name()),
      fmt::arg("value",
               has_value ? show(catalog.name_of_value({goal.variable, goal.value})) : Name()));
}

constexpr std::array<std::string_view, goal_sections> section_names = {
    "tasks",    "behaviors", "requirements", "minimums",  "exclusions",
    "timeouts", "reactive",  "situation",    "priorities"};

class GoalFinder {
 public:
  explicit GoalFinder(const CompiledCatalog& catalog) : catalog_(catalog) {}

  std::vector<Goal> find() {
    for (const TaskId task : catalog_.task_ids) add_task(Goal::Kind::task_ran, task);
    for (const BehaviorId behavior : catalog_.behavior_ids) add_behavior_goals(behavior);
    add_requirements();
    add_minimums();
    add_exclusions();
    add_timeouts();
    for (const TaskId task : catalog_.task_ids) {
      if (catalog_.tasks[task].reactive_start == 0) continue;
      add_task(Goal::Kind::reactive_started, task);
      add_task(Goal::Kind::reactive_gave_way, task);
      add_task(Goal::Kind::reactive_returned, task);
    }
    add_situation();
    add_priorities();
    return std::move(goals_);
  }

 private:
  Goal& add(Goal::Kind kind) {
    Goal& goal = goals_.emplace_back();
    goal.kind = kind;
    return goal;
  }
  void add_task(Goal::Kind kind, TaskId task) { add(kind).task = task; }
  void add_behavior(Goal::Kind kind, BehaviorId behavior) { add(kind).behavior = behavior; }

  template <typename Test>
  [[nodiscard]] bool performs_any(BehaviorId behavior, Test test) const {
    const auto values = catalog_.performs[behavior];
    return std::any_of(values.begin(), values.end(),
                       [&](ValueId value) { return test(catalog_.task_of(value)); });
  }
  [[nodiscard]] bool may_succeed(BehaviorId behavior) const {
    return performs_any(behavior,
                        [&](TaskId task) { return catalog_.tasks[task].keep_running == 0; });
  }

  /// A task that keeps running has no goal to achieve, and without another behavior there is
  /// nothing to replace one by.
  void add_behavior_goals(BehaviorId behavior) {
    add_behavior(Goal::Kind::behavior_active, behavior);
    if (may_succeed(behavior)) add_behavior(Goal::Kind::behavior_succeeded, behavior);
    add_behavior(Goal::Kind::behavior_failed, behavior);
    if (performs_any(behavior, [&](TaskId task) { return catalog_.values[task].size() > 1; })) {
      add_behavior(Goal::Kind::behavior_replaced, behavior);
    }
    if (catalog_.retry_of(behavior) != Retry::at_events) {
      add_behavior(Goal::Kind::failure_remembered, behavior);
    }
  }

  void add_requirements() {
    for (const BehaviorId behavior : catalog_.behavior_ids) {
      for (const CompiledRequirement& requirement : catalog_.requirements[behavior]) {
        for (const Goal::Kind kind :
             {Goal::Kind::requirement_used, Goal::Kind::requirement_decided}) {
          Goal& goal = add(kind);
          goal.behavior = behavior;
          goal.task = requirement.task;
        }
      }
    }
  }

  void add_minimums() {
    for (const TaskId task : catalog_.task_ids) {
      if (catalog_.tasks[task].minimum_performance > 0) {
        add_task(Goal::Kind::minimum_decided, task);
      }
    }
    for (const BehaviorId behavior : catalog_.behavior_ids) {
      for (const CompiledRequirement& requirement : catalog_.requirements[behavior]) {
        if (requirement.minimum_performance == 0) continue;
        Goal& goal = add(Goal::Kind::minimum_decided);
        goal.behavior = behavior;
        goal.task = requirement.task;
      }
    }
  }

  void add_exclusions() {
    const auto index_of = [&](TaskId task) { return catalog_.tasks[task].catalog_index; };
    std::vector<TaskId> rivals;
    for (const TaskId task : catalog_.task_ids) {
      rivals.clear();
      for (const std::uint32_t clique : catalog_.task_cliques[task]) {
        for (const TaskId rival : catalog_.cliques[clique]) {
          if (index_of(rival) > index_of(task)) rivals.push_back(rival);
        }
      }
      std::sort(rivals.begin(), rivals.end(),
                [&](TaskId a, TaskId b) { return index_of(a) < index_of(b); });
      rivals.erase(std::unique(rivals.begin(), rivals.end()), rivals.end());
      for (const TaskId rival : rivals) {
        Goal& goal = add(Goal::Kind::exclusion_decided);
        goal.task = task;
        goal.other_task = rival;
      }
    }
  }

  void add_timeouts() {
    for (const TaskId task : catalog_.task_ids) {
      const CompiledTask& compiled = catalog_.tasks[task];
      const auto values = catalog_.values[task];
      if (compiled.keep_running == 0 && compiled.timeout > 0 &&
          std::any_of(values.begin(), values.end(), [&](const Value& value) {
            return catalog_.behaviors[value.behavior].timeout == 0;
          })) {
        add_task(Goal::Kind::timeout_fired, task);
      }
    }
    for (const BehaviorId behavior : catalog_.behavior_ids) {
      if (catalog_.behaviors[behavior].timeout > 0 && may_succeed(behavior)) {
        add_behavior(Goal::Kind::timeout_fired, behavior);
      }
    }
  }

  void add_situation() {
    for (std::uint32_t variable = 0; variable < catalog_.variables.size(); ++variable) {
      for (std::uint32_t value = 0; value < catalog_.variables[variable].value_count; ++value) {
        Goal& goal = add(Goal::Kind::variable_value);
        goal.variable = variable;
        goal.value = value;
      }
    }
    for (const BehaviorId behavior : catalog_.behavior_ids) {
      if (!may_misfit(behavior)) continue;
      add_behavior(Goal::Kind::behavior_began_to_fit, behavior);
      add_behavior(Goal::Kind::behavior_ceased_to_fit, behavior);
    }
    for (const TaskId task : catalog_.task_ids) {
      const auto values = catalog_.values[task];
      const bool may_improve =
          !values.empty() && values.front().suitability != values.back().suitability;
      if (may_improve && catalog_.rules_of(task).improve == Improve::at_once) {
        add_task(Goal::Kind::improved_at_once, task);
      }
    }
  }

  /// Whether some variable has a value that the behavior does not fit.
  [[nodiscard]] bool may_misfit(BehaviorId behavior) const {
    std::map<std::uint32_t, std::uint32_t> named;
    for (const FittingValue& fitting : catalog_.fitting_values_of(behavior)) {
      ++named[fitting.variable];
    }
    return std::any_of(named.begin(), named.end(), [&](const auto& entry) {
      return entry.second < catalog_.variables[entry.first].value_count;
    });
  }

  void add_priorities() {
    for (const TaskId task : catalog_.task_ids) {
      if (catalog_.rules_of(task).resume != 0) {
        add_task(Goal::Kind::request_suspended, task);
        add_task(Goal::Kind::request_resumed, task);
      }
      if (catalog_.tasks[task].start_on_request == 0) continue;
      const auto [any, requested] = find_opponents(task);
      if (any) add_task(Goal::Kind::higher_displaced, task);
      if (!requested) continue;
      add_task(Goal::Kind::lower_rejected, task);
      add_task(Goal::Kind::equal_displaced, task);
    }
  }

  struct Opponents {
    bool any = false;
    bool requested = false;  ///< among them one that starts on request
  };

  /// Other tasks with requests of which something that they may need excludes something that the
  /// task may need.
  [[nodiscard]] Opponents find_opponents(TaskId task) const {
    std::vector<TaskId> needed{task};
    std::vector<std::uint8_t> is_needed(catalog_.tasks.size(), 0);
    is_needed[task] = 1;
    for (std::size_t next = 0; next < needed.size(); ++next) {
      for (const Arc& arc : catalog_.arcs[needed[next]]) {
        if (std::exchange(is_needed[arc.target], std::uint8_t{1}) == 0) {
          needed.push_back(arc.target);
        }
      }
    }
    std::vector<TaskId> hindering;
    std::vector<std::uint8_t> hinders(catalog_.tasks.size(), 0);
    const auto add_hindering = [&](TaskId other) {
      if (std::exchange(hinders[other], std::uint8_t{1}) == 0) hindering.push_back(other);
    };
    for (const TaskId one : needed) {
      for (const std::uint32_t clique : catalog_.task_cliques[one]) {
        for (const TaskId rival : catalog_.cliques[clique]) {
          if (rival != one) add_hindering(rival);
        }
      }
    }
    Opponents found;
    for (std::size_t next = 0; next < hindering.size() && !found.requested; ++next) {
      const TaskId other = hindering[next];
      const CompiledTask& compiled = catalog_.tasks[other];
      if (other != task) {
        found.any = found.any || compiled.reactive_start != 0 || compiled.start_on_request != 0;
        found.requested = found.requested || compiled.start_on_request != 0;
      }
      for (const std::uint32_t arc : catalog_.incoming[other]) {
        add_hindering(catalog_.arcs.items[arc].source);
      }
    }
    return found;
  }

  const CompiledCatalog& catalog_;
  std::vector<Goal> goals_;
};

class LineFinder {
 public:
  LineFinder(const Catalog& source, const CompiledCatalog& catalog)
      : source_(source), catalog_(catalog), exclusions_(source) {}

  std::vector<std::uint32_t> lines_of(const Goal& goal) {
    switch (goal.kind) {
      case Goal::Kind::requirement_used:
      case Goal::Kind::requirement_decided:
        return {requirement_of(goal).range.begin.line};
      case Goal::Kind::minimum_decided:
        return {(goal.behavior == none ? task_of(goal.task).minimum_performance_range
                                       : requirement_of(goal).minimum_performance_range)
                    .begin.line};
      case Goal::Kind::exclusion_decided:
        return lines_of_pair(index_of(goal.task), index_of(goal.other_task));
      case Goal::Kind::timeout_fired:
        if (goal.behavior != none) return {behavior_of(goal.behavior).timeout_range.begin.line};
        return {task_of(goal.task).own_timeout_range.value_or(task_of(goal.task).range).begin.line};
      case Goal::Kind::variable_value:
        return {source_.variables[goal.variable].range.begin.line};
      case Goal::Kind::behavior_began_to_fit:
      case Goal::Kind::behavior_ceased_to_fit: {
        const Behavior& behavior = behavior_of(goal.behavior);
        return {behavior.situation_range.value_or(behavior.range).begin.line};
      }
      default:
        return {(goal.task != none ? task_of(goal.task).range : behavior_of(goal.behavior).range)
                    .begin.line};
    }
  }

 private:
  [[nodiscard]] TaskIndex index_of(TaskId task) const { return catalog_.tasks[task].catalog_index; }
  [[nodiscard]] const Task& task_of(TaskId task) const { return source_.tasks[index_of(task)]; }
  [[nodiscard]] const Behavior& behavior_of(BehaviorId behavior) const {
    return source_.behaviors[catalog_.behaviors[behavior].catalog_index];
  }
  [[nodiscard]] const Requirement& requirement_of(const Goal& goal) const {
    return strongest_requirement(behavior_of(goal.behavior), index_of(goal.task));
  }

  /// Those of both names in the first list that has both.
  std::vector<std::uint32_t> lines_of_pair(TaskIndex a, TaskIndex b) {
    const auto place = exclusions_.find(a, b);
    if (!place) return {};
    const ExclusivityList& list = source_.exclusivity[*place];
    std::vector<std::uint32_t> lines;
    for (const TaskIndex task : {a, b}) {
      const auto found = std::find(list.tasks.begin(), list.tasks.end(), task);
      lines.push_back(list.ranges[static_cast<std::size_t>(found - list.tasks.begin())].begin.line);
    }
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    return lines;
  }

  const Catalog& source_;
  const CompiledCatalog& catalog_;
  Exclusions exclusions_;
};

}  // namespace

std::string_view name_of(Goal::Kind kind) { return row_of(kind).name; }

std::string_view name_of(GoalSection section) {
  return section_names[static_cast<std::size_t>(section)];
}

GoalSection section_of(Goal::Kind kind) { return row_of(kind).section; }

std::optional<std::string> find_too_many_pairs(const CompiledCatalog& catalog) {
  constexpr std::uint64_t most = 500'000;
  std::uint64_t pairs = 0;
  for (std::uint32_t list = 0; list < catalog.cliques.size(); ++list) {
    const std::uint64_t tasks = catalog.cliques[list].size();
    pairs += tasks * (tasks - 1) / 2;
  }
  if (pairs <= most) return std::nullopt;
  return fmt::format("the exclusivity lists of {} have {} pairs of tasks; expected at most {}",
                     quote(catalog.file), pairs, most);
}

std::vector<Goal> find_goals(const CompiledCatalog& catalog) { return GoalFinder(catalog).find(); }

void add_lines(const Catalog& source, const CompiledCatalog& catalog, std::vector<Goal>& goals) {
  LineFinder finder(source, catalog);
  for (Goal& goal : goals) goal.lines = finder.lines_of(goal);
}

std::string describe(const CompiledCatalog& catalog, const Goal& goal) {
  std::string_view sentence = row_of(goal.kind).sentence;
  if (goal.behavior == none && goal.kind == Goal::Kind::minimum_decided) {
    sentence = sentence_of_minimum;
  }
  if (goal.behavior == none && goal.kind == Goal::Kind::timeout_fired) {
    sentence = sentence_of_timeout;
  }
  return fill_in(sentence, catalog, goal, [](std::string_view name) { return printable(name); });
}

std::string name_after(const CompiledCatalog& catalog, const Goal& goal) {
  const bool is_task = goal.behavior == none && goal.kind == Goal::Kind::timeout_fired;
  const std::string words = fill_in(is_task ? words_of_timeout : row_of(goal.kind).words, catalog,
                                    goal, [](std::string_view name) { return name; });
  constexpr std::size_t longest = 100;
  std::string name;
  for (const char character : words) {
    const bool is_upper = character >= 'A' && character <= 'Z';
    const bool is_kept = is_upper || (character >= 'a' && character <= 'z') ||
                         (character >= '0' && character <= '9');
    if (is_kept) {
      name += is_upper ? static_cast<char>(character - 'A' + 'a') : character;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  name.resize(std::min(name.size(), longest));
  while (name.ends_with('-')) name.pop_back();
  return name;
}

}  // namespace cbc
