// What no state satisfies is made smaller, part by part, until with any part less some state
// satisfies it. A part of the result is reported and left out, and what is left is looked at again.
// Rules on names would find less: what two behaviors require may exclude one another in many ways.

#include "core/script/contradictions.h"

#include <algorithm>
#include <span>
#include <utility>

#include "ask/conflict/quickxplain.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

bool counts(Ground ground, const Reason& reason) {
  return ground == Ground::catalog ||
         (ground == Ground::exclusions &&
          (reason.kind == Reason::Kind::exclusive || reason.kind == Reason::Kind::limited));
}

bool is_possible(std::span<const Contradictions::Part* const> parts, Ground ground,
                 StateAsk& states) {
  StateAsk::Formulas formulas;
  for (const Contradictions::Part* part : parts) formulas.push_back(part->formula.get());
  const Feasibility answer = ground == Ground::catalog
                                 ? states.find(formulas)
                                 : states.find_under(formulas, [ground](const Reason& reason) {
                                     return counts(ground, reason);
                                   });
  return answer != Feasibility::no;
}

/// "behavior 'GPS' does not perform task 'LAND', it performs 'LOCALIZE'"
std::string describe_misplaced(const CompiledCatalog& catalog, BehaviorId behavior, TaskId task) {
  std::vector<std::uint32_t> performed;
  for (const ValueId value : catalog.performs[behavior]) {
    performed.push_back(catalog.tasks[catalog.task_of(value)].catalog_index);
  }
  const std::uint32_t first = *std::min_element(performed.begin(), performed.end());
  std::string tasks = quote(catalog.task_names[first]);
  if (performed.size() > 1) tasks += concat(" and ", performed.size() - 1, " more");
  return concat("behavior ", quote(catalog.name_of_behavior(behavior)), " does not perform task ",
                quote(catalog.name_of_task(task)), ", it performs ", tasks);
}

/// What to add where nothing performs a task.
std::string but_nothing_performs(const CompiledCatalog& catalog, TaskId task) {
  return catalog.values[task].empty() ? ", but no behavior performs it" : "";
}

std::string describe_without_line(const CompiledCatalog& catalog, const Reason& reason) {
  const auto task = [&] { return quote(catalog.name_of_task(reason.task)); };
  const auto behavior = [&] {
    return "behavior " + quote(catalog.name_of_behavior(reason.behavior));
  };
  if (reason.kind == Reason::Kind::exclusive) {
    return task() + " excludes " + quote(catalog.name_of_task(reason.other_task));
  }
  if (reason.kind == Reason::Kind::limited) {
    std::vector<std::string> names;
    for (const TaskId member : catalog.limited[reason.limit]) {
      names.push_back(quote(catalog.name_of_task(member)));
    }
    return concat("at most ", catalog.limits[reason.limit].most, " of ", list_with_and(names),
                  " run");
  }
  if (reason.kind == Reason::Kind::situation) {
    std::vector<std::string> values;
    for (const FittingValue& fitting : catalog.fitting_values_of(reason.behavior)) {
      if (fitting.variable != reason.variable) continue;
      values.push_back(quote(catalog.name_of_value({fitting.variable, fitting.value})));
    }
    return concat(behavior(), " fits only where ", quote(catalog.name_of_variable(reason.variable)),
                  " is ", list_with_or(values));
  }
  std::string text =
      reason.behavior == none ? task() + " runs" : concat(behavior(), " requires task ", task());
  if (reason.kind == Reason::Kind::performance) {
    text += " with at least " + format_percent(reason.minimum_performance);
  }
  return text;
}

/// "behavior 'GPS' requires task 'POWER' (a.yaml:7)". The compiled catalog has no lines of
/// conditions.
std::string describe_constraint(const CompiledCatalog& catalog, const Reason& reason) {
  const std::string text = describe_without_line(catalog, reason);
  if (reason.line == 0) return text;
  return concat(text, " (", catalog.file, ":", reason.line, ")") +
         (reason.kind == Reason::Kind::exclusive || reason.kind == Reason::Kind::limited
              ? ""
              : but_nothing_performs(catalog, reason.task));
}

}  // namespace

void Contradictions::add(const StateCondition& condition, Parts& parts) const {
  if (condition.kind == StateCondition::Kind::any) return;
  if (condition.kind != StateCondition::Kind::all &&
      condition.kind != StateCondition::Kind::only_active) {
    parts.push_back({&condition, std::make_shared<Formula>(formulas_.make(condition, true))});
    return;
  }
  for (const StateCondition& part : condition.parts) add(part, parts);
  if (condition.kind == StateCondition::Kind::all) return;
  parts.push_back({&condition, std::make_shared<Formula>(formulas_.no_other(condition, true))});
}

std::vector<Impossible> Contradictions::find(Parts& parts, Ground ground, StateAsk& states,
                                             const Reporter& reporter) const {
  std::vector<Impossible> found;
  while (!states.effort().is_over()) {
    std::vector<const Part*> left;
    for (const Part& part : parts) left.push_back(&part);
    if (is_possible(left, ground, states)) break;
    const std::vector<const Part*> reason = minimal(left, ground, states);
    if (reason.empty()) break;  // there is no state at all
    found.push_back(describe(reason, ground, states, reporter));
    const StateCondition* last = reason.back()->condition;
    std::erase_if(parts, [last](const Part& part) { return part.condition == last; });
  }
  return found;
}

std::vector<Impossible> Contradictions::take_misplaced(Parts& parts, Ground ground) const {
  std::vector<Impossible> found;
  std::erase_if(parts, [&](const Part& part) {
    const StateCondition& condition = *part.condition;
    if (condition.kind != StateCondition::Kind::running || condition.behaviors.empty())
      return false;
    const auto is_misplaced = [&](BehaviorId behavior) {
      return !catalog_.can_perform(behavior, condition.task);
    };
    const auto& listed = condition.behaviors;
    const bool are_all = std::all_of(listed.begin(), listed.end(), is_misplaced);
    if (!are_all && ground == Ground::words) return false;
    for (std::size_t place = 0; place < listed.size(); ++place) {
      if (!is_misplaced(listed[place])) continue;
      found.push_back({condition.behavior_ranges[place],
                       describe_misplaced(catalog_, listed[place], condition.task)});
    }
    return are_all;
  });
  return found;
}

std::vector<const Contradictions::Part*> Contradictions::minimal(std::span<const Part* const> parts,
                                                                 Ground ground,
                                                                 StateAsk& states) const {
  if (!is_possible({}, ground, states)) return {};
  const auto has_state = [&](std::span<const Part* const> some) {
    return is_possible(some, ground, states);
  };
  std::vector<const Part*> found =
      QuickXplain<const Part*, decltype(has_state)>(has_state).find(parts);
  std::reverse(found.begin(), found.end());
  return found;
}

Impossible Contradictions::describe(std::span<const Part* const> parts, Ground ground,
                                    StateAsk& states, const Reporter& reporter) const {
  constexpr std::size_t most_parts = 3;
  Impossible impossible;
  impossible.range = parts.back()->condition->range;
  StateAsk::Formulas formulas;
  for (std::size_t place = 0; place < parts.size(); ++place) {
    const StateCondition& condition = *parts[place]->condition;
    formulas.push_back(parts[place]->formula.get());
    if (place < most_parts) {
      impossible.why += (place == 0 ? "" : " and ") + words_of(condition);
    }
    if (place + 1 < parts.size()) {
      impossible.notes.push_back(reporter.note(condition.range, "expected here"));
    }
  }
  if (parts.size() > most_parts) {
    impossible.why += concat(" and ", parts.size() - most_parts, " more");
  }
  const std::vector<Reason> constraints =
      states.conflict(formulas, [ground](const Reason& reason) { return counts(ground, reason); });
  impossible.constraints = constraints.size();
  const std::span<const Reason> first(constraints.data(), std::min(constraints.size(), most_parts));
  impossible.because = join(first, " and ", [this](const Reason& reason) {
    return describe_constraint(catalog_, reason);
  });
  if (constraints.size() > first.size()) {
    impossible.because += concat(" and ", constraints.size() - first.size(), " more constraints");
  }
  return impossible;
}

std::string Contradictions::words_of(const StateCondition& condition) const {
  const std::string words = describe_condition(catalog_, condition);
  return condition.kind == StateCondition::Kind::running
             ? words + but_nothing_performs(catalog_, condition.task)
             : words;
}

}  // namespace cbc
