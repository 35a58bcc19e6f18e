#include "versions/lockstep/same_as_direct.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "runtime/base/text.h"
#include "runtime/coordinator/state.h"
#include "versions/difference/catalog_diff.h"
#include "versions/difference/catalog_facts.h"

namespace cbc {

namespace {

using Kind = DirectDifference::Kind;

/// What tasks of both catalogs are set to, and timeouts of their behaviors, as lines.
class AttributeComparison {
 public:
  AttributeComparison(const CompiledCatalog& old_catalog, const CompiledCatalog& new_catalog,
                      const Translation& to_old)
      : old_(old_catalog), new_(new_catalog), to_old_(to_old) {}

  std::vector<DirectDifference> run(const Renames& renames) && {
    std::vector<CatalogChange> changes;
    compare_facts(ChangeSubject::task, with_new_names(old_, new_, renames), with_own_names(new_),
                  changes);
    std::map<std::string_view, const CatalogChange*> by_name;
    for (const CatalogChange& change : changes) {
      if (change.kind == CatalogChange::Kind::changed) by_name.emplace(change.task, &change);
    }
    for (const TaskId task : new_.task_ids) {
      const TaskId of_old = to_old_.tasks[task];
      if (of_old == none) continue;
      if (const auto found = by_name.find(new_.name_of_task(task)); found != by_name.end()) {
        add_attributes(*found->second);
      }
      if (old_.tasks[of_old].keep_running == new_.tasks[task].keep_running) {
        compare_timeouts(of_old, task);
      }
    }
    return std::move(differences_);
  }

 private:
  void add(Kind kind, std::string_view name, const std::string& what, const AttributeValue& before,
           const AttributeValue& after) {
    std::string line =
        fmt::format("{}: {} {} in {}, {} in {}", printable(name), what, describe(before),
                    printable(old_.file), describe(after), printable(new_.file));
    const bool is_known =
        std::any_of(differences_.begin(), differences_.end(),
                    [&](const DirectDifference& known) { return known.line == line; });
    if (!is_known) differences_.push_back({kind, std::move(line)});
  }

  /// Others show in events.
  void add_attributes(const CatalogChange& of_task) {
    for (const AttributeChange& change : of_task.attributes) {
      const auto kind = change.name == "execution_goal"             ? Kind::execution_goal
                        : change.name == "requestable"              ? Kind::requestable
                        : change.name.starts_with(parameter_prefix) ? std::optional(Kind::parameter)
                                                                    : std::nullopt;
      if (!kind) continue;
      add(*kind, of_task.task, printable(change.name), change.before, change.after);
    }
  }

  /// Of the task if its behaviors have none of their own, otherwise of the behavior.
  void compare_timeouts(TaskId of_old, TaskId of_new) {
    for (const Value& value : new_.values[of_new]) {
      const BehaviorId behavior = to_old_.behaviors[value.behavior];
      if (behavior == none || !old_.can_perform(behavior, of_old)) continue;
      const Microseconds before = timeout_of(old_, of_old, behavior);
      const Microseconds after = timeout_of(new_, of_new, value.behavior);
      if (before == after) continue;
      const bool is_of_task =
          old_.behaviors[behavior].timeout == 0 && new_.behaviors[value.behavior].timeout == 0;
      add(Kind::timeout,
          is_of_task ? new_.name_of_task(of_new) : new_.name_of_behavior(value.behavior), "timeout",
          unless_zero(before), unless_zero(after));
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
        property.condition = StateCondition::of_behavior(StateCondition::Kind::active, behavior);
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
                                                 const Translation& to_old,
                                                 const Renames& renames) {
  return AttributeComparison(old_catalog, new_catalog, to_old).run(renames);
}

MissingNames find_missing(const CompiledCatalog& catalog, const Translation& to_other,
                          const Assumptions& assumptions, const ExplorationOptions& options) {
  return MissingSearch(catalog, to_other, assumptions).run(options);
}

}  // namespace cbc
