#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "core/check/proofs.h"
#include "core/check/together_search.h"

namespace cbc {
namespace {

/// Goes through the situations that differ in some variables; the others keep their first values.
class Situations {
 public:
  Situations(const CompiledCatalog& catalog, const std::vector<std::uint32_t>& variables)
      : catalog_(catalog), variables_(variables), values_(catalog.variables.size(), 0) {}

  /// By variable, its value.
  [[nodiscard]] const std::vector<std::uint32_t>& values() const { return values_; }

  /// False after the last one.
  [[nodiscard]] bool advance() {
    for (const std::uint32_t variable : variables_) {
      if (++values_[variable] < catalog_.variables[variable].value_count) return true;
      values_[variable] = 0;
    }
    return false;
  }

 private:
  const CompiledCatalog& catalog_;
  const std::vector<std::uint32_t>& variables_;
  std::vector<std::uint32_t> values_;
};

/// Appends the conditions of a behavior, one for each variable that it names.
void add_conditions(const CompiledCatalog& catalog, BehaviorId behavior,
                    std::vector<Reason>& reasons) {
  std::uint32_t last = none;
  for (const FittingValue& fitting : catalog.fitting_values_of(behavior)) {
    if (fitting.variable == std::exchange(last, fitting.variable)) continue;
    Reason reason;
    reason.kind = Reason::Kind::situation;
    reason.behavior = behavior;
    reason.variable = fitting.variable;
    reason.value = none;
    reasons.push_back(reason);
  }
}

bool is_met(const CompiledCatalog& catalog, const Reason& condition, std::uint32_t value) {
  const std::span<const FittingValue> fitting = catalog.fitting_values_of(condition.behavior);
  return std::binary_search(fitting.begin(), fitting.end(),
                            FittingValue{condition.behavior, condition.variable, value});
}

/// Solves demands in all situations, with only some reasons in force.
class ConflictInSituations {
 public:
  ConflictInSituations(const CompiledCatalog& catalog, const Demands& demands,
                       std::uint64_t& effort_left)
      : catalog_(catalog),
        nothing_present_(most_in_a_group(catalog.group_tasks), none),
        effort_left_(effort_left) {
    for (const Demand& demand : demands) {
      const GroupId group = catalog.tasks[demand.task].group;
      auto part = std::find_if(parts_.begin(), parts_.end(),
                               [group](const Part& one) { return one.group == group; });
      if (part == parts_.end()) part = parts_.insert(part, {group, {}, nullptr});
      part->demands.push_back(demand);
    }
    for (Part& part : parts_) {
      part.problem =
          std::make_unique<ConflictSearch>(catalog_, part.group, nothing_present_, part.demands);
    }
  }

  [[nodiscard]] std::vector<Reason> find() {
    const std::vector<Reason> candidates = all_reasons();
    if (candidates.size() > most_constraints) return {};
    std::vector<bool> is_used(candidates.size(), false);
    if (has_solution(candidates, &is_used)) return {};
    // Most of them have no part in the proofs, so it need not be found which of them are needed.
    std::vector<Reason> used;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (is_used[i]) used.push_back(candidates[i]);
    }
    std::vector<Reason> minimal = minimal_conflict_set(
        used, [this](std::span<const Reason> some) { return has_solution(some, nullptr); });
    return effort_left_ == 0 ? std::vector<Reason>{} : minimal;
  }

 private:
  /// The demands on one group of the catalog.
  struct Part {
    GroupId group;
    Demands demands;
    std::unique_ptr<ConflictSearch> problem;
  };

  [[nodiscard]] std::vector<Reason> all_reasons() const {
    std::vector<Reason> reasons;
    for (const Part& part : parts_) {
      RelevantTasks relevant(catalog_, part.group);
      for (const Demand& demand : part.demands) relevant.add(demand.task);
      relevant.close();
      for (const TaskId task : relevant.tasks()) {
        add_exclusions(catalog_, task, relevant, most_constraints + 1, reasons);
        add_minimum(catalog_, task, reasons);
      }
      for (const BehaviorId behavior : relevant.behaviors()) {
        add_requirements(catalog_, behavior, reasons);
        add_conditions(catalog_, behavior, reasons);
      }
    }
    return reasons;
  }

  /// Also true if that is not known. `is_used`: which of the reasons the proofs of the contrary
  /// use.
  [[nodiscard]] bool has_solution(std::span<const Reason> reasons, std::vector<bool>* is_used) {
    std::vector<std::uint32_t> variables;
    for (const Reason& reason : reasons) {
      if (reason.kind == Reason::Kind::situation) variables.push_back(reason.variable);
    }
    std::sort(variables.begin(), variables.end());
    variables.erase(std::unique(variables.begin(), variables.end()), variables.end());
    return ask_in_situations(catalog_, variables, [&](std::span<const std::uint32_t> values) {
             for (const Part& part : parts_) {
               const Feasibility answer = solve(part, reasons, values, is_used);
               if (answer != Feasibility::yes) return answer;
             }
             return Feasibility::yes;
           }) != Feasibility::no;
  }

  [[nodiscard]] Feasibility solve(const Part& part, std::span<const Reason> reasons,
                                  std::span<const std::uint32_t> values,
                                  std::vector<bool>* is_used) {
    std::vector<Reason> in_force;
    std::vector<std::size_t> places;
    for (std::size_t place = 0; place < reasons.size(); ++place) {
      const Reason& reason = reasons[place];
      const GroupId group = reason.behavior != none ? catalog_.group_of(reason.behavior)
                                                    : catalog_.tasks[reason.task].group;
      if (group != part.group) continue;
      if (reason.kind == Reason::Kind::situation &&
          is_met(catalog_, reason, values[reason.variable])) {
        continue;
      }
      in_force.push_back(reason);
      places.push_back(place);
    }
    if (effort_left_ == 0) return Feasibility::unknown;
    const std::uint64_t before = part.problem->effort();
    const Feasibility answer = part.problem->solve(in_force, effort_left_);
    const std::uint64_t effort = part.problem->effort() - before + reasons.size();
    effort_left_ -= std::min(effort, effort_left_);
    if (answer == Feasibility::no && is_used != nullptr) {
      for (std::size_t i = 0; i < places.size(); ++i) {
        if (part.problem->is_used()[i] != 0) (*is_used)[places[i]] = true;
      }
    }
    return answer;
  }

  const CompiledCatalog& catalog_;
  const std::vector<std::uint32_t> nothing_present_;
  std::vector<Part> parts_;
  std::uint64_t& effort_left_;
};

}  // namespace

std::vector<std::uint32_t> variables_of(const CompiledCatalog& catalog,
                                        std::span<const TaskId> tasks) {
  if (catalog.variables.empty()) return {};
  std::vector<std::uint32_t> variables;
  for (const TaskId task : tasks) {
    RelevantTasks relevant(catalog, catalog.tasks[task].group);
    relevant.add(task);
    relevant.close();
    for (const BehaviorId behavior : relevant.behaviors()) {
      for (const FittingValue& value : catalog.fitting_values_of(behavior)) {
        variables.push_back(value.variable);
      }
    }
  }
  std::sort(variables.begin(), variables.end());
  variables.erase(std::unique(variables.begin(), variables.end()), variables.end());
  return variables;
}

Feasibility ask_in_situations(const CompiledCatalog& catalog,
                              const std::vector<std::uint32_t>& variables,
                              const InSituation& question) {
  constexpr std::size_t most_situations = 10'000;
  Situations situations(catalog, variables);
  for (std::size_t asked = 0; asked < most_situations; ++asked) {
    const Feasibility answer = question(situations.values());
    if (answer != Feasibility::no) return answer;
    if (!situations.advance()) return Feasibility::no;
  }
  return Feasibility::unknown;
}

std::vector<Reason> conflict_in_all_situations(const CompiledCatalog& catalog,
                                               const Demands& demands, std::uint64_t& effort_left) {
  return ConflictInSituations(catalog, demands, effort_left).find();
}

}  // namespace cbc
