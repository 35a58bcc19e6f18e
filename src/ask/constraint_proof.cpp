// What breaks a promise is a condition on a state. Of a state, what the constraints say something
// about is looked at: which task runs with which behavior, the situation, and what is faulty; that
// a task is requested means only that it runs. The condition becomes a formula in negation normal
// form, whose cases are gone through one by one. Each says which tasks run, with which behaviors,
// and in which situations, so that a search for assignments settles it (fitting_search.h).
//
// A state has an assignment that satisfies all constraints, with behaviors that fit in its
// situation. Own(b) and faults are not among these: they do not end a behavior that is active.

#include "ask/constraint_proof.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "ask/fitting_search.h"

namespace cbc {

namespace {

/// What part of a state a formula may be about.
struct Literal {
  enum class Kind : std::uint8_t {
    task,        ///< runs with one of the values (ValueId), or if it may, does not run
    variable,    ///< has one of the values
    own,         ///< own(b) is as wanted
    fault,       ///< the behavior is faulty, or it is not, as wanted
    some_fault,  ///< some behavior is faulty
  };
  Kind kind = Kind::task;
  std::uint32_t subject = 0;
  std::vector<std::uint32_t> values;
  bool may_stop = false;
  bool wanted = true;
};

/// In negation normal form.
struct Formula {
  enum class Kind : std::uint8_t { literal, all, any };
  Kind kind = Kind::all;
  Literal literal;
  std::vector<Formula> parts;
};

/// Makes formulas of conditions, and of their negations.
class FormulaMaker {
 public:
  FormulaMaker(const CompiledCatalog& catalog, const std::vector<GroupId>& groups)
      : catalog_(catalog), groups_(groups) {}

  /// `holds`: of the condition, or else of its negation.
  [[nodiscard]] Formula make(const StateCondition& condition, bool holds) const {
    Formula formula = join(holds);
    auto& parts = formula.parts;
    for (const auto& running : condition.running) parts.push_back(runs(running, holds));
    for (const TaskId task : condition.stopped) parts.push_back(runs({task, {}}, !holds));
    for (const BehaviorId behavior : condition.active) parts.push_back(active(behavior, holds));
    if (condition.only_active) add_others(condition.active, holds, parts);
    for (const auto& requested : condition.requested) {
      // A task without such a request may run or not.
      if (holds) parts.push_back(runs({requested.task, {}}, true));
      if (!holds) parts.push_back(join(true));
    }
    for (const auto& situated : condition.variables) {
      parts.push_back(has_value(situated.variable, situated.values, holds));
    }
    for (const auto& own : condition.own) {
      parts.push_back(of_behavior(Literal::Kind::own, own.behavior, own.available == holds));
    }
    for (const BehaviorId behavior : condition.faulty) {
      parts.push_back(of_behavior(Literal::Kind::fault, behavior, holds));
    }
    if (condition.none_faulty) add_none_faulty(holds, parts);
    for (const BehaviorId behavior : condition.available) {
      parts.push_back(available(behavior, holds));
    }
    for (const StateCondition& part : condition.negated) parts.push_back(make(part, !holds));
    for (const StateCondition& part : condition.all) parts.push_back(make(part, holds));
    if (condition.any.empty()) return formula;
    Formula& one_of = parts.emplace_back(join(!holds));
    for (const StateCondition& part : condition.any) one_of.parts.push_back(make(part, holds));
    return formula;
  }

 private:
  /// Of parts that all hold, or else of which one does.
  static Formula join(bool all) { return {all ? Formula::Kind::all : Formula::Kind::any, {}, {}}; }
  static Formula of(Literal literal) { return {Formula::Kind::literal, std::move(literal), {}}; }
  static Formula of_behavior(Literal::Kind kind, BehaviorId behavior, bool wanted) {
    return of({kind, behavior, {}, false, wanted});
  }

  [[nodiscard]] Formula runs(const StateCondition::Running& running, bool holds) const {
    const auto& listed = running.behaviors;
    Literal literal{Literal::Kind::task, running.task, {}, !holds, true};
    for (ValueId value(catalog_.values.begin[running.task]);
         value < catalog_.values.begin[running.task + 1]; ++value) {
      const BehaviorId behavior = catalog_.values.items[value].behavior;
      const bool is_meant =
          listed.empty() || std::find(listed.begin(), listed.end(), behavior) != listed.end();
      if (is_meant == holds) literal.values.push_back(value);
    }
    return of(std::move(literal));
  }

  /// A behavior is active if it performs some task.
  [[nodiscard]] Formula active(BehaviorId behavior, bool holds) const {
    Formula formula = join(!holds);
    for (const ValueId value : catalog_.performs[behavior]) {
      formula.parts.push_back(runs({catalog_.task_of(value), {behavior}}, holds));
    }
    return formula;
  }

  /// No behavior of the groups is active that is not listed, or else some is.
  void add_others(const std::vector<BehaviorId>& listed, bool holds,
                  std::vector<Formula>& parts) const {
    for (const BehaviorId behavior : catalog_.behavior_ids) {
      if (!is_of_groups(behavior)) continue;
      if (std::find(listed.begin(), listed.end(), behavior) != listed.end()) continue;
      parts.push_back(active(behavior, !holds));
    }
  }

  [[nodiscard]] Formula has_value(std::uint32_t variable, const std::vector<std::uint32_t>& listed,
                                  bool holds) const {
    Literal literal{Literal::Kind::variable, variable, {}, false, true};
    for (std::uint32_t value = 0; value < catalog_.variables[variable].value_count; ++value) {
      const bool is_listed = std::find(listed.begin(), listed.end(), value) != listed.end();
      if (is_listed == holds) literal.values.push_back(value);
    }
    return of(std::move(literal));
  }

  void add_none_faulty(bool holds, std::vector<Formula>& parts) const {
    if (!holds) {
      parts.push_back(of({Literal::Kind::some_fault, 0, {}, false, true}));
      return;
    }
    for (const BehaviorId behavior : catalog_.behavior_ids) {
      if (!is_of_groups(behavior)) continue;
      parts.push_back(of_behavior(Literal::Kind::fault, behavior, false));
    }
  }

  /// It fits, and own(b) is true.
  [[nodiscard]] Formula available(BehaviorId behavior, bool holds) const {
    Formula formula = join(holds);
    formula.parts.push_back(of_behavior(Literal::Kind::own, behavior, holds));
    std::map<std::uint32_t, std::vector<std::uint32_t>> fitting;
    for (const FittingValue& value : catalog_.fitting_values_of(behavior)) {
      fitting[value.variable].push_back(value.value);
    }
    for (const auto& [variable, values] : fitting) {
      formula.parts.push_back(has_value(variable, values, holds));
    }
    return formula;
  }

  [[nodiscard]] bool is_of_groups(BehaviorId behavior) const {
    return std::binary_search(groups_.begin(), groups_.end(), catalog_.group_of(behavior));
  }

  const CompiledCatalog& catalog_;
  const std::vector<GroupId>& groups_;
};

/// What one case of a formula demands of a state.
struct Case {
  GroupDemand demand;
  ValueSets values;
  std::map<BehaviorId, bool> own;  ///< of those that may change
  std::map<BehaviorId, bool> faulty;
  bool some_fault = false;
};

/// Goes through the cases of a formula until one of them has a state.
class CaseSearch {
 public:
  CaseSearch(const CompiledCatalog& catalog, const std::vector<GroupId>& groups,
             const Assumptions& assumptions)
      : catalog_(catalog), groups_(groups), assumptions_(assumptions), search_(catalog, groups) {
    for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
      if (is_listed(assumptions.variables, variable)) continue;
      constants_.variables.push_back({variable, initial_value(assumptions, variable)});
    }
    for (const BehaviorId behavior : catalog.behavior_ids) {
      if (is_listed(assumptions.behaviors, behavior)) continue;
      constants_.behaviors.push_back({behavior, is_available_at_first(assumptions, behavior)});
    }
  }

  /// Whether it is certain that no case has a state.
  [[nodiscard]] bool refutes(const Formula& formula) {
    const SituationSpace space(catalog_, constants_, {});
    return !may_hold({GroupDemand(catalog_), space.all(), {}, {}, false}, {&formula});
  }

 private:
  template <typename Item>
  static bool is_listed(const std::vector<Item>& list, Item item) {
    return std::find(list.begin(), list.end(), item) != list.end();
  }

  /// Whether a case may have a state that satisfies these formulas, too.
  [[nodiscard]] bool may_hold(Case of_state, std::vector<const Formula*> open) {
    std::vector<const Formula*> choices;
    while (!open.empty()) {
      const Formula& next = *open.back();
      open.pop_back();
      switch (next.kind) {
        case Formula::Kind::literal:
          if (!add(next.literal, of_state)) return false;
          break;
        case Formula::Kind::all:
          for (const Formula& part : next.parts) open.push_back(&part);
          break;
        case Formula::Kind::any:
          choices.push_back(&next);
          break;
      }
    }
    if (choices.empty()) return settle(std::move(of_state));
    const Formula& choice = *choices.back();
    choices.pop_back();
    return std::any_of(choice.parts.begin(), choice.parts.end(), [&](const Formula& part) {
      std::vector<const Formula*> rest = choices;
      rest.push_back(&part);
      return spend(effort_of_case) || may_hold(of_state, std::move(rest));
    });
  }

  /// False if the case has no state with it, by itself.
  [[nodiscard]] bool add(const Literal& literal, Case& of_state) const {
    switch (literal.kind) {
      case Literal::Kind::task:
        return add_task(literal, of_state.demand);
      case Literal::Kind::variable:
        return add_variable(literal, of_state.values);
      case Literal::Kind::own: {
        const BehaviorId behavior(literal.subject);
        if (!is_listed(assumptions_.behaviors, behavior)) {
          return is_available_at_first(assumptions_, behavior) == literal.wanted;
        }
        return of_state.own.try_emplace(behavior, literal.wanted).first->second == literal.wanted;
      }
      case Literal::Kind::fault: {
        const BehaviorId behavior(literal.subject);
        if (!may_be_faulty(behavior)) return !literal.wanted;
        const bool is_faulty = of_state.faulty.try_emplace(behavior, literal.wanted).first->second;
        return is_faulty == literal.wanted && count_faults(of_state) <= assumptions_.faults;
      }
      case Literal::Kind::some_fault:
        of_state.some_fault = true;
        break;
    }
    return true;
  }

  [[nodiscard]] bool add_task(const Literal& literal, GroupDemand& demand) const {
    const TaskId task(literal.subject);
    bool may_run = false;
    for (ValueId value(catalog_.values.begin[task]); value < catalog_.values.begin[task + 1];
         ++value) {
      if (!is_listed<std::uint32_t>(literal.values, value)) demand.ruled_out[value] = true;
      may_run |= !demand.ruled_out[value];
    }
    if (!literal.may_stop) demand.runs[task] = true;
    return may_run || !demand.runs[task];
  }

  [[nodiscard]] bool add_variable(const Literal& literal, ValueSets& values) const {
    const CompiledVariable& variable = catalog_.variables[literal.subject];
    bool has_value = false;
    for (std::uint32_t value = 0; value < variable.value_count; ++value) {
      auto& is_open = values[variable.first_value + value];
      if (!is_listed(literal.values, value)) is_open = 0;
      has_value |= is_open != 0;
    }
    return has_value;
  }

  [[nodiscard]] bool may_be_faulty(BehaviorId behavior) const {
    return assumptions_.faults > 0 && can_become_faulty(assumptions_, behavior);
  }

  [[nodiscard]] static std::uint32_t count_faults(const Case& of_state) {
    return static_cast<std::uint32_t>(std::count_if(of_state.faulty.begin(), of_state.faulty.end(),
                                                    [](const auto& one) { return one.second; }));
  }

  /// Whether some behavior of the groups may be faulty.
  [[nodiscard]] bool may_have_fault(const Case& of_state) const {
    if (count_faults(of_state) > 0) return true;
    return std::any_of(
        catalog_.behavior_ids.begin(), catalog_.behavior_ids.end(), [&](BehaviorId behavior) {
          return may_be_faulty(behavior) && !of_state.faulty.contains(behavior) &&
                 std::binary_search(groups_.begin(), groups_.end(), catalog_.group_of(behavior));
        });
  }

  /// Whether a case that leaves no choice may have a state.
  [[nodiscard]] bool settle(Case of_state) {
    if (of_state.some_fault && !may_have_fault(of_state)) return false;
    if (const auto behavior = find_open_own(of_state)) {
      for (const bool is_available : {true, false}) {
        of_state.own[*behavior] = is_available;
        if (spend(effort_of_case) || settle(of_state)) return true;
      }
      return false;
    }
    const SituationSpace situations(catalog_, constants_, never_in(of_state));
    const auto answer = search_.find(situations, of_state.demand, of_state.values,
                                     [this](std::uint64_t decisions) { return !spend(decisions); });
    return answer != FittingSearch::Answer::impossible;
  }

  /// An own(b) that is not decided, but that an entry of `never` names.
  [[nodiscard]] std::optional<BehaviorId> find_open_own(const Case& of_state) const {
    for (const SituationPart& entry : assumptions_.never) {
      for (const SituationPart::Own& own : entry.behaviors) {
        if (is_listed(assumptions_.behaviors, own.behavior) &&
            !of_state.own.contains(own.behavior)) {
          return own.behavior;
        }
      }
    }
    return std::nullopt;
  }

  /// The entries of `never`, as far as all own(b) that may change are as decided.
  [[nodiscard]] std::vector<SituationPart> never_in(const Case& of_state) const {
    std::vector<SituationPart> entries;
    for (SituationPart entry : assumptions_.never) {
      const bool may_be = std::all_of(
          entry.behaviors.begin(), entry.behaviors.end(), [&](const SituationPart::Own& own) {
            const auto decided = of_state.own.find(own.behavior);
            return decided == of_state.own.end() || decided->second == own.available;
          });
      if (!may_be) continue;
      std::erase_if(entry.behaviors, [&](const SituationPart::Own& own) {
        return of_state.own.contains(own.behavior);
      });
      entries.push_back(std::move(entry));
    }
    return entries;
  }

  /// Counts effort, in decisions of the solver; true: it is too much.
  [[nodiscard]] bool spend(std::uint64_t decisions) {
    constexpr std::uint64_t most = 1'000 * effort_of_case;
    effort_ += decisions;
    return effort_ > most;
  }

  static constexpr std::uint64_t effort_of_case = 10'000;

  const CompiledCatalog& catalog_;
  const std::vector<GroupId>& groups_;
  const Assumptions& assumptions_;
  FittingSearch search_;
  SituationPart constants_;  ///< what cannot change
  std::uint64_t effort_ = 0;
};

}  // namespace

bool is_proved_by_constraints(const CompiledCatalog& catalog, const std::vector<GroupId>& groups,
                              const Assumptions& assumptions, const Property& property) {
  const bool is_always = property.kind == Property::Kind::always;
  if (!is_always && property.kind != Property::Kind::never) return false;
  const auto is_first = [&](const SituationPart& part) {
    return holds_at_first(assumptions, part);
  };
  if (std::any_of(assumptions.never.begin(), assumptions.never.end(), is_first)) return false;
  const FormulaMaker maker(catalog, groups);
  Formula broken{Formula::Kind::all, {}, {}};
  broken.parts.push_back(maker.make(property.condition, !is_always));
  if (property.when) broken.parts.push_back(maker.make(*property.when, true));
  return CaseSearch(catalog, groups, assumptions).refutes(broken);
}

}  // namespace cbc
