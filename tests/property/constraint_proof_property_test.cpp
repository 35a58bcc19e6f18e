// What is proved by the constraints alone must hold in every state that satisfies them, reachable
// or not, and all of that must be proved; conditions that are said to contradict one another must
// do so, none of them left out, and all that do must be found: compared with a look at every
// assignment, situation, and set of faults. CBC_SEED and CBC_PROPERTY_CASES are as in
// property_test.cpp.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "compiled_model.h"
#include "core/property/constraint_proof.h"
#include "core/script/contradictions.h"
#include "demand.h"
#include "enumeration.h"
#include "explore/properties/verification.h"
#include "lint_oracle.h"
#include "plain_exploration.h"
#include "plain_model.h"
#include "random.h"
#include "random_cases.h"
#include "runtime/base/text.h"
#include "statistics.h"
#include "verify_case.h"

namespace cbc::plain::constraint_proof_property_test {
namespace {

using oracle::demand;

constexpr std::uint64_t default_cases = 1000;
constexpr std::uint64_t most_states = 1500;
constexpr std::uint64_t most_combinations = 200'000;
constexpr std::size_t most_tasks = 10;  // of a group; see LintOracle

/// All states of some groups that satisfy the constraints. Nothing in them is requested.
class ConsistentStates : private oracle::CompiledModel {
 public:
  ConsistentStates(const VerifyCase& sample, const oracle::LintOracle& constraints,
                   const std::vector<GroupId>& groups)
      : CompiledModel(sample.source, sample.catalog),
        constraints_(constraints),
        assumptions_(sample.question.assumptions),
        groups_(groups) {
    add_assignments();
    add_situations();
    add_faults();
  }

  [[nodiscard]] std::uint64_t count() const {
    return assignments_.size() * situations_.size() * faults_.size();
  }

  [[nodiscard]] bool any(const std::function<bool(const Snapshot&)>& holds) const {
    for (const Snapshot& assignment : assignments_) {
      for (const Snapshot& situation : situations_) {
        Snapshot state = assignment;
        state.variables = situation.variables;
        state.denied = situation.denied;
        if (!fits(state)) continue;
        for (const std::vector<BehaviorId>& faulty : faults_) {
          state.faulty = faulty;
          if (holds(state)) return true;
        }
      }
    }
    return false;
  }

  [[nodiscard]] bool is_first_excluded() const {
    Snapshot first;
    for (std::uint32_t variable = 0; variable < compiled_.variables.size(); ++variable) {
      first.variables.push_back(initial_value(assumptions_, variable));
    }
    for (const BehaviorId behavior : compiled_.behavior_ids) {
      if (!is_available_at_first(assumptions_, behavior)) first.denied.push_back(behavior);
    }
    return is_excluded(first);
  }

 private:
  [[nodiscard]] bool is_of_groups(GroupId group) const { return oracle::contains(groups_, group); }

  void add_assignments() {
    assignments_.emplace_back();
    for (const GroupId group : groups_) {
      std::vector<Snapshot> longer;
      std::size_t place = 0;
      while (compiled_.tasks[id_of_task(place)].group != group) ++place;
      const std::size_t number = constraints_.facts().group_of[place];
      static_cast<void>(
          constraints_.any(number, constraints_.all(number), [&](const oracle::Row& row) {
            for (const Snapshot& shorter : assignments_) longer.push_back(with(row, shorter));
            return longer.size() > most_combinations;
          }));
      assignments_ = std::move(longer);
    }
  }

  [[nodiscard]] Snapshot with(const oracle::Row& row, Snapshot state) const {
    for (std::size_t task = 0; task < row.values.size(); ++task) {
      if (row.values[task] == oracle::none) continue;
      const TaskId id = id_of_task(task);
      const BehaviorId behavior = id_of_behavior(row.values[task]);
      std::uint32_t value = 0;
      while (compiled_.values[id][value].behavior != behavior) ++value;
      state.running.push_back({id, value, 0, {}, false});
      if (!is_active(state, behavior)) state.active.emplace_back(behavior, 0);
    }
    return state;
  }

  void add_situations() {
    std::vector<Snapshot> found(1);
    for (std::uint32_t variable = 0; variable < compiled_.variables.size(); ++variable) {
      std::vector<Snapshot> longer;
      for (std::uint32_t value = 0; value < compiled_.variables[variable].value_count; ++value) {
        if (!oracle::contains(assumptions_.variables, variable) &&
            value != initial_value(assumptions_, variable)) {
          continue;
        }
        for (const Snapshot& shorter : found) {
          longer.push_back(shorter);
          longer.back().variables.push_back(value);
        }
      }
      found = std::move(longer);
    }
    for (const BehaviorId behavior : compiled_.behavior_ids) {
      const bool may_change = oracle::contains(assumptions_.behaviors, behavior);
      const bool is_denied = !is_available_at_first(assumptions_, behavior);
      const std::size_t count = found.size();
      for (std::size_t place = 0; place < count; ++place) {
        if (may_change) found.push_back(found[place]);
        if (may_change || is_denied) found[place].denied.push_back(behavior);
      }
      if (found.size() > most_combinations) break;
    }
    for (Snapshot& situation : found) {
      if (!is_excluded(situation)) situations_.push_back(std::move(situation));
    }
  }

  [[nodiscard]] bool is_excluded(const Snapshot& state) const {
    return std::any_of(
        assumptions_.never.begin(), assumptions_.never.end(), [&](const SituationPart& entry) {
          return std::all_of(entry.variables.begin(), entry.variables.end(),
                             [&](const VariableValue& value) {
                               return state.variables[value.variable] == value.value;
                             }) &&
                 std::all_of(entry.behaviors.begin(), entry.behaviors.end(),
                             [&](const SituationPart::Own& own) {
                               return oracle::contains(state.denied, own.behavior) != own.available;
                             });
        });
  }

  void add_faults() {
    faults_.emplace_back();
    for (const BehaviorId behavior : compiled_.behavior_ids) {
      if (!is_of_groups(compiled_.group_of(behavior))) continue;
      if (!can_become_faulty(assumptions_, behavior)) continue;
      const std::size_t count = faults_.size();
      for (std::size_t place = 0; place < count; ++place) {
        if (faults_[place].size() >= assumptions_.faults) continue;
        faults_.push_back(faults_[place]);
        faults_.back().push_back(behavior);
      }
    }
  }

  /// Whether what is active can be: what never becomes available is not.
  [[nodiscard]] bool fits(const Snapshot& state) const {
    return std::all_of(state.active.begin(), state.active.end(), [&](const auto& entry) {
      const BehaviorId behavior = entry.first;
      const bool may_be_available = !oracle::contains(state.denied, behavior) ||
                                    oracle::contains(assumptions_.behaviors, behavior);
      return may_be_available && !compiled_.find_misfit(behavior, state.variables);
    });
  }

  const oracle::LintOracle& constraints_;
  const Assumptions& assumptions_;
  const std::vector<GroupId>& groups_;
  std::vector<Snapshot> assignments_;  ///< only what runs
  std::vector<Snapshot> situations_;   ///< only variables and own(b)
  std::vector<std::vector<BehaviorId>> faults_;
};

bool names_requests(const Property& property) {
  const auto conditions = conditions_of(property);
  return std::any_of(conditions.begin(), conditions.end(), [](const StateCondition* part) {
    return part->kind == StateCondition::Kind::requested;
  });
}

/// What is found, and what is enumerated.
void compare_with_enumeration(const VerifyCase& sample, const Property& property,
                              const oracle::LintOracle& constraints, bool is_proved,
                              oracle::Statistics& statistics) {
  const Assumptions& assumptions = sample.question.assumptions;
  const std::vector<GroupId> groups = scope_of(sample.catalog, property).groups;
  const ConsistentStates states(sample, constraints, groups);
  if (states.is_first_excluded()) {
    demand(!is_proved, "proved, but the first situation is excluded");
    return;
  }
  // Requests are not looked at.
  if (names_requests(property) || states.count() > most_combinations) return;
  const PlainModel model(sample.catalog, groups, assumptions, variables_of(property));
  const bool is_broken = states.any([&](const Snapshot& state) {
    if (property.when && !model.holds(*property.when, state)) return false;
    return model.holds(property.condition, state) == (property.kind == Property::Kind::never);
  });
  demand(is_proved != is_broken,
         property.name + (is_proved ? ": proved, but a consistent state breaks it"
                                    : ": not proved, but no consistent state breaks it"));
  statistics.count(is_proved ? "proved as enumerated" : "not proved as enumerated");
  if (is_proved && groups.size() > 1) statistics.count("proved of several groups");
  if (is_proved && !assumptions.never.empty()) statistics.count("proved with never");
}

/// What is proved is so in all reachable states, and vacuous if that says nothing.
void compare_with_states(const VerifyCase& sample, const Property& property,
                         const PropertyAnswer& answer, oracle::Statistics& statistics) {
  const std::vector<GroupId> groups = scope_of(sample.catalog, property).groups;
  const Exploration expected = explore_plainly(sample.catalog, groups, sample.question.assumptions,
                                               {&property}, most_states);
  if (!expected.complete) return;
  demand(expected.verdicts.front().result == Verdict::Result::proved, "proved, but violated");
  demand(answer.verdict.is_vacuous == expected.verdicts.front().is_vacuous,
         answer.verdict.is_vacuous ? "vacuous, but some state counts" : "not vacuous");
  statistics.count("proved for all states");
  if (answer.verdict.is_vacuous) statistics.count("vacuous");
  if (!answer.verdict.is_vacuous && property.when) statistics.count("some state counts");
}

/// Up to so many conditions that are to hold together.
constexpr std::size_t most_parts = 6;
constexpr std::uint64_t most_states_of_parts = 20'000;

/// Some parts of the conditions of the properties, each with a line of its own.
std::vector<StateCondition> draw_parts(const VerifyCase& sample, oracle::Random& random) {
  using Kind = StateCondition::Kind;
  std::vector<StateCondition> all;
  for (const Property& property : sample.question.properties) {
    for (const StateCondition* condition : conditions_of(property)) {
      const bool is_joined = condition->kind == Kind::all || condition->kind == Kind::any;
      bool has_request = false;
      for_each_condition(*condition, [&](const StateCondition& part) {
        has_request |= part.kind == Kind::requested;
      });
      // Requests are not looked at.
      if (!is_joined && !has_request) all.push_back(*condition);
    }
  }
  std::vector<StateCondition> drawn;
  for (std::size_t wanted = 1 + random.below(most_parts); wanted > 0 && !all.empty(); --wanted) {
    drawn.push_back(random.pick(all));
    const auto line = static_cast<std::uint32_t>(100 * drawn.size());
    drawn.back().range = {{line, 1}, {line, 2}};
    std::uint32_t next = line;
    for (StateCondition& part : drawn.back().parts) {
      ++next;
      part.range = {{next, 1}, {next, 2}};
    }
  }
  return drawn;
}

/// Of contradictions, what is found, and what is enumerated.
class ComparedContradictions {
 public:
  ComparedContradictions(const VerifyCase& sample, const ConsistentStates& states)
      : sample_(sample),
        states_(states),
        model_(sample.catalog, sample.question.groups, sample.question.assumptions, {}) {}

  void compare(const std::vector<StateCondition>& conditions, oracle::Statistics& statistics) {
    const Contradictions contradictions(sample_.catalog);
    const StateCondition joined = StateCondition::join(StateCondition::Kind::all, conditions);
    contradictions.add(joined, parts_);
    StateAsk ask(sample_.catalog, possible_states(sample_.catalog, sample_.question.assumptions),
                 most_effort_of_assignments);
    Contradictions::Parts parts = parts_;
    Diagnostics diagnostics;
    const Reporter reporter("p.yaml", diagnostics);
    const auto found = contradictions.find(parts, Ground::catalog, ask, reporter);
    const bool is_over = ask.effort().is_over();  // what is found is true, but may not be all
    std::set<std::size_t> left = lines();
    if (!holds(left) && !holds({})) return;
    for (const Impossible& impossible : found) {
      std::set<std::size_t> reason{impossible.range.begin.line};
      for (const Note& note : impossible.notes) {
        if (note.message == "expected here") reason.insert(note.range.begin.line);
      }
      demand(!holds(reason), "possible: " + impossible.why);
      for (const std::size_t line : reason) {
        std::set<std::size_t> fewer = reason;
        fewer.erase(line);
        demand(is_over || holds(fewer), "impossible with less: " + impossible.why);
      }
      left.erase(impossible.range.begin.line);
      statistics.count(concat("contradiction of ", reason.size()));
    }
    if (is_over) {
      statistics.count("over");
      return;
    }
    demand(holds(left), "a contradiction is not found");
    statistics.count(found.empty() ? "no contradiction" : "contradictions");
  }

 private:
  [[nodiscard]] std::set<std::size_t> lines() const {
    std::set<std::size_t> all;
    for (const Contradictions::Part& part : parts_) all.insert(part.condition->range.begin.line);
    return all;
  }

  /// Whether some state satisfies the parts in these lines.
  [[nodiscard]] bool holds(const std::set<std::size_t>& lines) const {
    return states_.any([&](const Snapshot& state) {
      return std::all_of(parts_.begin(), parts_.end(), [&](const Contradictions::Part& part) {
        return !lines.contains(part.condition->range.begin.line) || holds(*part.condition, state);
      });
    });
  }

  /// The behaviors that are listed as all are parts of their own.
  [[nodiscard]] bool holds(const StateCondition& part, const Snapshot& state) const {
    if (part.kind != StateCondition::Kind::only_active) return model_.holds(part, state);
    return std::all_of(state.active.begin(), state.active.end(), [&](const auto& entry) {
      return std::any_of(part.parts.begin(), part.parts.end(), [&](const StateCondition& listed) {
        return listed.behavior == entry.first;
      });
    });
  }

  const VerifyCase& sample_;
  const ConsistentStates& states_;
  const PlainModel model_;
  Contradictions::Parts parts_;
};

void compare_contradictions(const VerifyCase& sample, const oracle::LintOracle& constraints,
                            std::uint64_t seed, oracle::Statistics& statistics) {
  const ConsistentStates states(sample, constraints, sample.question.groups);
  if (states.count() > most_states_of_parts) return;
  oracle::Random random(seed);
  for (int round = 0; round < 5; ++round) {
    ComparedContradictions(sample, states).compare(draw_parts(sample, random), statistics);
  }
}

void run_case(std::uint64_t seed, oracle::Results& results) {
  VerifyCase sample;
  try {
    sample = generate_verify_case(seed);
    const oracle::CatalogFacts facts(sample.source);
    for (const auto& group : facts.groups) {
      if (group.size() > most_tasks) return;
    }
    const oracle::LintOracle constraints(facts);
    PropertyFile file;
    file.assumptions = sample.question.assumptions;
    file.properties = sample.question.properties;
    ExplorationOptions options;
    options.budget.max_states = most_states;
    const Verification found = verify_properties(sample.catalog, file, options);
    for (const PropertyAnswer& answer : found.answers) {
      const Property& property = *answer.property;
      const bool is_proved = answer.verdict.by_constraints;
      if (property.kind == Property::Kind::always || property.kind == Property::Kind::never) {
        compare_with_enumeration(sample, property, constraints, is_proved, results.statistics);
      } else {
        demand(!is_proved, "proved, but neither always nor never");
      }
      if (is_proved) compare_with_states(sample, property, answer, results.statistics);
    }
    compare_contradictions(sample, constraints, seed, results.statistics);
  } catch (const std::exception& error) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n--- catalog\n" +
                                        text_of(sample) + "--- fault\n" + error.what() + "\n"});
  }
}

const oracle::LowerBound lower_bounds[] = {
    {"proved as enumerated", 200},    {"not proved as enumerated", 300},
    {"proved of several groups", 10}, {"proved with never", 50},
    {"proved for all states", 200},   {"vacuous", 30},
    {"some state counts", 30},        {"no contradiction", 300},
    {"contradictions", 300},
};

TEST(ConstraintProof, IsThatOfEnumeration) {
  oracle::run_random_cases(default_cases, run_case, lower_bounds);
}

}  // namespace
}  // namespace cbc::plain::constraint_proof_property_test
