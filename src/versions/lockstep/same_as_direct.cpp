#include "versions/lockstep/same_as_direct.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/catalog/allowed_values.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"
#include "runtime/coordinator/state.h"

namespace cbc {

namespace {

using Kind = DirectDifference::Kind;

/// The attributes of two catalogs, as lines.
class AttributeComparison {
 public:
  AttributeComparison(const CompiledCatalog& old_catalog, const CompiledCatalog& new_catalog,
                      const Translation& to_old)
      : old_(old_catalog), new_(new_catalog), to_old_(to_old) {}

  std::vector<DirectDifference> run() && {
    for (const TaskId task : new_.task_ids) {
      const TaskId of_old = to_old_.tasks[task];
      if (of_old == none) continue;
      const bool has_same_goal = compare_goals(of_old, task);
      if (has_same_goal) compare_timeouts(of_old, task);
      compare_parameters(of_old, task);
    }
    return std::move(differences_);
  }

 private:
  void add(Kind kind, std::string_view name, const std::string& what, const std::string& before,
           const std::string& after) {
    std::string line = fmt::format("{}: {} {} in {}, {} in {}", printable(name), what, before,
                                   printable(old_.file), after, printable(new_.file));
    const bool is_known =
        std::any_of(differences_.begin(), differences_.end(),
                    [&](const DirectDifference& known) { return known.line == line; });
    if (!is_known) differences_.push_back({kind, std::move(line)});
  }

  bool compare_goals(TaskId of_old, TaskId of_new) {
    const auto goal_of = [](const CompiledCatalog& catalog, TaskId task) {
      return catalog.tasks[task].keep_running != 0 ? "keep_running" : "achieve_goal";
    };
    if (old_.tasks[of_old].keep_running == new_.tasks[of_new].keep_running) return true;
    add(Kind::execution_goal, new_.name_of_task(of_new), "execution_goal", goal_of(old_, of_old),
        goal_of(new_, of_new));
    return false;
  }

  /// Of the task if its behaviors have none of their own, otherwise of the behavior.
  void compare_timeouts(TaskId of_old, TaskId of_new) {
    for (const Value& value : new_.values[of_new]) {
      const BehaviorId behavior = to_old_.behaviors[value.behavior];
      if (behavior == none || !performs(behavior, of_old)) continue;
      const Microseconds before = timeout_of(old_, of_old, behavior);
      const Microseconds after = timeout_of(new_, of_new, value.behavior);
      if (before == after) continue;
      const bool is_of_task =
          old_.behaviors[behavior].timeout == 0 && new_.behaviors[value.behavior].timeout == 0;
      add(Kind::timeout,
          is_of_task ? new_.name_of_task(of_new) : new_.name_of_behavior(value.behavior), "timeout",
          describe(before), describe(after));
    }
  }
  [[nodiscard]] bool performs(BehaviorId behavior, TaskId task) const {
    const auto values = old_.performs[behavior];
    return std::any_of(values.begin(), values.end(),
                       [&](ValueId value) { return old_.task_of(value) == task; });
  }
  static std::string describe(Microseconds timeout) {
    return timeout == 0 ? "none" : format_decimal(timeout, 6) + " s";
  }

  void compare_parameters(TaskId of_old, TaskId of_new) {
    using Allowed = std::map<std::string, std::set<std::string>>;
    const auto allowed_by = [](const CompiledCatalog& catalog, TaskId task) {
      Allowed allowed;
      for (const Parameter& one : parameters_of(catalog, catalog.tasks[task].catalog_index)) {
        allowed[one.name].insert(describe_allowed(one));
      }
      return allowed;
    };
    const Allowed before = allowed_by(old_, of_old);
    const Allowed after = allowed_by(new_, of_new);
    const auto describe_one = [](const Allowed& allowed, const std::string& name) {
      const auto found = allowed.find(name);
      if (found == allowed.end()) return std::string("none");
      return join(found->second, " or ", [](const std::string& text) {
        return text.empty() ? std::string("any") : printable(text);
      });
    };
    std::set<std::string> names;
    for (const auto& [name, texts] : before) names.insert(name);
    for (const auto& [name, texts] : after) names.insert(name);
    for (const std::string& name : names) {
      const auto of_before = before.find(name);
      const auto of_after = after.find(name);
      if (of_before != before.end() && of_after != after.end() &&
          of_before->second == of_after->second) {
        continue;
      }
      add(Kind::parameter, new_.name_of_task(of_new), "parameter " + printable(name),
          describe_one(before, name), describe_one(after, name));
    }
  }

  const CompiledCatalog& old_;
  const CompiledCatalog& new_;
  const Translation& to_old_;
  std::vector<DirectDifference> differences_;
};

/// Finds what another catalog lacks.
class MissingSearch {
 public:
  MissingSearch(const CompiledCatalog& catalog, const Translation& to_other,
                const Assumptions& assumptions)
      : catalog_(catalog), to_other_(to_other), assumptions_(assumptions) {}

  MissingNames run(const ExplorationOptions& options) && {
    for (const TaskId task : catalog_.task_ids) {
      const bool can_start =
          std::any_of(assumptions_.start.begin(), assumptions_.start.end(),
                      [&](const Assumptions::Start& start) { return start.task == task; });
      if (can_start && to_other_.tasks[task] == none) {
        add(Kind::task,
            fmt::format("task {} can be requested", printable(catalog_.name_of_task(task))));
      }
    }
    add_behaviors(options);
    add_variables();
    return std::move(result_);
  }

 private:
  void add(Kind kind, const std::string& what) {
    result_.differences.push_back(
        {kind, fmt::format("{} in {} only", what, printable(catalog_.file))});
  }

  void add_behaviors(const ExplorationOptions& options) {
    std::set<BehaviorId> active;
    for (GroupId group(0); group < catalog_.group_count(); ++group) {
      const std::vector<BehaviorId> missing = missing_of(group);
      if (missing.empty()) continue;
      std::vector<Property> properties;
      for (const BehaviorId behavior : missing) {
        Property& property = properties.emplace_back();
        property.kind = Property::Kind::reachable;
        property.condition.active.push_back(behavior);
      }
      std::vector<const Property*> asked;
      asked.reserve(properties.size());
      for (const Property& property : properties) asked.push_back(&property);
      const Exploration found = explore(catalog_, {group}, assumptions_, asked, options);
      if (found.error) result_.error = found.error;
      if (found.error) return;
      for (std::size_t place = 0; place < missing.size(); ++place) {
        const Verdict::Result result = found.verdicts[place].result;
        if (result == Verdict::Result::proved) active.insert(missing[place]);
        if (result == Verdict::Result::undecided && !result_.end) result_.end = found.end;
      }
    }
    for (const BehaviorId behavior : catalog_.behavior_ids) {
      if (!active.contains(behavior)) continue;
      add(Kind::behavior,
          fmt::format("behavior {} can be active", printable(catalog_.name_of_behavior(behavior))));
    }
  }
  [[nodiscard]] std::vector<BehaviorId> missing_of(GroupId group) const {
    std::vector<BehaviorId> missing;
    for (BehaviorId behavior = catalog_.group_behaviors[group];
         behavior < catalog_.group_behaviors[group + 1]; ++behavior) {
      if (to_other_.behaviors[behavior] == none) missing.push_back(behavior);
    }
    return missing;
  }

  /// Variables that may change, and their values, that decide about a behavior which both have.
  void add_variables() {
    for (const std::uint32_t variable : assumptions_.variables) {
      const BehaviorId behavior = behavior_that_names(variable);
      if (behavior == none) continue;
      const std::string name = printable(catalog_.name_of_variable(variable));
      const std::string who = printable(catalog_.name_of_behavior(behavior));
      if (to_other_.variables[variable] == none) {
        add(Kind::variable, fmt::format("{} depends on variable {}", who, name));
        continue;
      }
      const auto& values = to_other_.values[variable];
      for (std::uint32_t value = 0; value < values.size(); ++value) {
        if (values[value] != none) continue;
        add(Kind::value, fmt::format("{} depends on {}, which has the value {}", who, name,
                                     printable(catalog_.name_of_value({variable, value}))));
      }
    }
  }
  /// The first one, in catalog order, that both catalogs have; or none.
  [[nodiscard]] BehaviorId behavior_that_names(std::uint32_t variable) const {
    for (const BehaviorId behavior : catalog_.behavior_ids) {
      if (to_other_.behaviors[behavior] == none) continue;
      const auto values = catalog_.fitting_values_of(behavior);
      if (std::any_of(values.begin(), values.end(),
                      [&](const FittingValue& value) { return value.variable == variable; })) {
        return behavior;
      }
    }
    return none;
  }

  const CompiledCatalog& catalog_;
  const Translation& to_other_;
  const Assumptions& assumptions_;
  MissingNames result_;
};

}  // namespace

std::vector<DirectDifference> compare_attributes(const CompiledCatalog& old_catalog,
                                                 const CompiledCatalog& new_catalog,
                                                 const Translation& to_old) {
  return AttributeComparison(old_catalog, new_catalog, to_old).run();
}

MissingNames find_missing(const CompiledCatalog& catalog, const Translation& to_other,
                          const Assumptions& assumptions, const ExplorationOptions& options) {
  return MissingSearch(catalog, to_other, assumptions).run(options);
}

}  // namespace cbc
