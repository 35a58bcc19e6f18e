// What holds in all reachable states of some groups: model checking of invariants ("Handbook of
// Model Checking", edited by E. M. Clarke, T. A. Henzinger, H. Veith and R. Bloem, 2018, chapter
// 5). StateSpace goes by the number of moves, so where something is seen first, it is at the end of
// a shortest path: a task runs, a start is refused, a property is violated.
//
// A depth-first search finds long counterexamples. A bounded search (SAT) would need every decision
// as a formula, but a decision is an optimum over all assignments.

#include "verify/engine/explore.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/report/words.h"
#include "core/support/system.h"
#include "runtime/base/text.h"
#include "verify/engine/state_space.h"
#include "verify/engine/state_test.h"
#include "verify/engine/stepper.h"

namespace cbc {

namespace {

using Set = Environments::Set;
using States = StateSpace::States;
constexpr std::uint32_t never_seen = UINT32_MAX;

/// Looks for the first states that break a property or, of reachable, show it.
class PropertyTest {
 public:
  PropertyTest(const Property& property, const Model& model, StateSpace& space)
      : property_(property) {
    if (property.kind == Property::Kind::can_start) {
      start_ = space.controls().find_start(model.find_task(property.task),
                                           model.ranks_up_to(property.priority));
    } else {
      condition_.emplace(model, property.condition, space);
    }
    if (property.when) when_.emplace(model, *property.when, space);
  }

  void visit(const States& states, std::uint32_t depth, StateSpace& space) {
    if (!condition_ || first_ < depth) return;
    const Stepper& control = space.controls().stepper();
    if (property_.settled && !control.is_settled()) return;
    Diagrams& sets = space.environments().sets();
    Set met = states.environments;
    if (when_) met = sets.both(met, when_->holds_in(control, sets));
    const Set holds = condition_->holds_in(control, sets);
    met =
        property_.kind == Property::Kind::always ? sets.without(met, holds) : sets.both(met, holds);
    note({states.control, met}, depth, space);
  }

  /// Of states in which the task does not run.
  void on_refusal(std::uint32_t action, const States& states, std::uint32_t depth,
                  StateSpace& space) {
    if (action != start_ || first_ < depth) return;
    Set met = states.environments;
    if (when_) {
      Diagrams& sets = space.environments().sets();
      met = sets.both(met, when_->holds_in(space.controls().stepper(), sets));
    }
    note({states.control, met}, depth, space);
  }

  [[nodiscard]] Verdict verdict(const CompiledCatalog& catalog, StateSpace& space) const {
    Verdict verdict;
    const bool is_reachable = property_.kind == Property::Kind::reachable;
    if (first_ == never_seen) {
      if (space.is_complete()) {
        verdict.result = is_reachable ? Verdict::Result::violated : Verdict::Result::proved;
      }
      return verdict;
    }
    verdict.result = is_reachable ? Verdict::Result::proved : Verdict::Result::violated;
    verdict.has_script = true;
    verdict.script = space.path_to(met_, first_);
    if (property_.kind == Property::Kind::can_start) {
      const std::uint32_t index = catalog.tasks[property_.task].catalog_index;
      verdict.script.push_back({Move::Kind::start, index, property_.priority});
    }
    return verdict;
  }

 private:
  void note(const States& states, std::uint32_t depth, StateSpace& space) {
    if (states.environments == Diagrams::empty) return;
    first_ = depth;
    if (met_.empty() || met_.back().control != states.control) {
      met_.push_back({states.control, Diagrams::empty});
    }
    Set& known = met_.back().environments;
    known = space.environments().sets().either(known, states.environments);
    space.keep(met_.back());
  }

  const Property& property_;
  std::uint32_t start_ = none;  ///< of can_start: the action
  std::optional<StateTest> condition_;
  std::optional<StateTest> when_;
  std::uint32_t first_ = never_seen;  ///< the depth
  std::vector<States> met_;           ///< of that depth, one after the other by control
};

/// Notes the least depth at which something was seen, and looks at properties.
class PropertyVisitor {
 public:
  PropertyVisitor(const Model& model, StateSpace& space, std::vector<PropertyTest>& properties)
      : model_(model),
        space_(space),
        properties_(properties),
        runs_(model.tasks().size(), never_seen),
        active_(model.behaviors().size(), never_seen),
        start_refused_(model.tasks().size(), never_seen),
        together_(model.tasks().size() * words_for(model.tasks().size()), 0) {
    for (std::uint32_t task = 0; task < model.tasks().size(); ++task) {
      if (!model.tasks()[task].start_on_request) continue;
      const std::uint32_t trial = space.controls().find_start(task, model.ranks_up_to(1));
      trials_.resize(space.controls().actions().size(), none);
      trials_[trial] = task;
    }
  }

  void visit(const States& states, std::uint32_t depth) {
    depth_ = depth;
    if (states.control >= is_known_.size()) is_known_.resize(space_.controls().size(), 0);
    if (std::exchange(is_known_[states.control], std::uint8_t{1}) == 0) visit_control();
    for (PropertyTest& property : properties_) property.visit(states, depth, space_);
  }

  void on_refusal(std::uint32_t action, const States& states) {
    const Controls& controls = space_.controls();
    if (controls.stepper().cells()[controls.actions()[action].choice.subject] != 0) return;
    if (action < trials_.size() && trials_[action] != none) note(start_refused_[trials_[action]]);
    for (PropertyTest& property : properties_) {
      property.on_refusal(action, states, depth_, space_);
    }
  }

  void report(Exploration& result) const;

 private:
  struct Together {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    std::uint32_t depth = 0;
  };

  void note(std::uint32_t& first) const { first = std::min(first, depth_); }

  /// What is the same in all environments.
  void visit_control() {
    const Stepper& control = space_.controls().stepper();
    const auto& running = control.running();
    const std::size_t words = running.size();
    for_each_bit(running.data(), words, [&](std::uint32_t task) {
      note(runs_[task]);
      Word* const known = &together_[task * words];
      for (std::size_t word = 0; word < words; ++word) {
        Word fresh = running[word] & ~known[word];
        known[word] |= fresh;
        for (; fresh != 0; fresh &= fresh - 1) {
          const auto other = static_cast<std::uint32_t>(
              word * 64 + static_cast<unsigned>(std::countr_zero(fresh)));
          if (other != task) pairs_.push_back({task, other, depth_});
        }
      }
    });
    for_each_bit(control.active().data(), control.active().size(),
                 [&](std::uint32_t behavior) { note(active_[behavior]); });
  }

  const Model& model_;
  StateSpace& space_;
  std::vector<PropertyTest>& properties_;
  std::vector<std::uint32_t> trials_;  ///< by action: the task whose start is tried, or none
  std::uint32_t depth_ = 0;
  std::vector<std::uint8_t> is_known_;  ///< by control
  std::vector<std::uint32_t> runs_;
  std::vector<std::uint32_t> active_;
  std::vector<std::uint32_t> start_refused_;
  std::vector<Word> together_;   ///< by task: the tasks that were seen to run beside it
  std::vector<Together> pairs_;  ///< each in both orders
};

void PropertyVisitor::report(Exploration& result) const {
  const CompiledCatalog& catalog = model_.catalog();
  const auto index_of = [&](std::uint32_t task) {
    return catalog.tasks[model_.tasks()[task].id].catalog_index;
  };
  for (const std::uint32_t task : model_.tasks_in_order()) {
    if (runs_[task] != never_seen) result.runs.emplace_back(index_of(task), runs_[task]);
    if (start_refused_[task] != never_seen) {
      result.start_refused.emplace_back(index_of(task), start_refused_[task]);
    }
  }
  for (const std::uint32_t behavior : model_.behaviors_in_order()) {
    if (active_[behavior] == never_seen) continue;
    result.active.emplace_back(catalog.behaviors[model_.behaviors()[behavior].id].catalog_index,
                               active_[behavior]);
  }
  for (const Together& pair : pairs_) {
    const std::uint32_t a = index_of(pair.a);
    const std::uint32_t b = index_of(pair.b);
    if (a < b) result.together.push_back({a, b, pair.depth});
  }
  std::sort(result.together.begin(), result.together.end(),
            [](const auto& a, const auto& b) { return std::pair(a.a, a.b) < std::pair(b.a, b.b); });
}

/// What the tables of pairs of tasks take, before any state is visited: in the model, the needs and
/// the rivals; and what was seen to run together.
std::uint64_t bytes_of_pairs(const Model& model) {
  const std::uint64_t pairs = std::uint64_t{model.tasks().size()} * model.tasks().size();
  return pairs / 4 + pairs / 8;
}

/// Sets apart a quarter of the memory for remembered decisions.
Stepper::Options share_memory(const ExplorationOptions& options, std::uint64_t& memory) {
  Stepper::Options result;
  result.reduce = options.reduce;
  constexpr std::uint64_t most = std::uint64_t{256} << 20;
  result.decision_bytes = memory == 0 ? most : std::min(most, memory / 4);
  // An array that grows takes twice its size for a while.
  if (memory > 0) memory -= std::min(memory / 2, 2 * result.decision_bytes);
  return result;
}

/// The conditions of a property, and those that stand in them.
std::vector<const StateCondition*> conditions_of(const Property& property) {
  std::vector<const StateCondition*> conditions;
  const auto add = [&conditions](const StateCondition& part) { conditions.push_back(&part); };
  for_each_condition(property.condition, add);
  if (property.when) for_each_condition(*property.when, add);
  return conditions;
}

void add_groups(const CompiledCatalog& catalog, const StateCondition& condition,
                std::set<GroupId>& groups) {
  const auto add_task = [&](TaskId task) { groups.insert(catalog.tasks[task].group); };
  const auto add_behavior = [&](BehaviorId behavior) { groups.insert(catalog.group_of(behavior)); };
  for (const auto& running : condition.running) add_task(running.task);
  for (const TaskId task : condition.stopped) add_task(task);
  for (const auto& requested : condition.requested) add_task(requested.task);
  for (const BehaviorId behavior : condition.active) add_behavior(behavior);
  for (const BehaviorId behavior : condition.faulty) add_behavior(behavior);
  for (const BehaviorId behavior : condition.available) add_behavior(behavior);
  for (const auto& own : condition.own) add_behavior(own.behavior);
}

void add_groups_of_variables(const CompiledCatalog& catalog, const StateCondition& condition,
                             std::set<GroupId>& groups) {
  for (const StateCondition::Situated& situated : condition.variables) {
    for (const FittingValue& fitting : catalog.fitting_values) {
      if (fitting.variable == situated.variable) groups.insert(catalog.group_of(fitting.behavior));
    }
  }
}

std::string title_of(const CompiledCatalog& catalog, const PropertyFile& file,
                     const Property& property) {
  const std::string place = fmt::format("{}:{}", printable(file.path), property.line);
  const std::string words = describe_property(catalog, property);
  return property.name.empty()
             ? fmt::format("{}\n({})", words, place)
             : fmt::format("{}: {}\n({})", printable(property.name), words, place);
}

}  // namespace

Exploration explore(const CompiledCatalog& catalog, const std::vector<GroupId>& groups,
                    const Assumptions& assumptions, const std::vector<const Property*>& properties,
                    const ExplorationOptions& options) {
  Exploration result;
  result.groups = groups;
  const auto end_before_moves = [&](ExplorationEnd end) {
    result.end = end;
    result.states = 1;
    result.states_at_depth = {1};
    result.verdicts.resize(properties.size());
    return std::move(result);
  };
  // The model of a group takes a while, and there may be thousands of groups.
  if (options.on_progress && !options.on_progress(groups, {})) {
    return end_before_moves(ExplorationEnd::stopped);
  }
  std::set<std::uint32_t> variables;
  for (const Property* const property : properties) variables.merge(variables_of(*property));
  const Model model(catalog, groups, assumptions, variables);
  result.error = model.find_obstacle();
  if (result.error) {
    result.verdicts.resize(properties.size());
    return result;
  }
  ExplorationLimits limits = options.limits;
  if (std::uint64_t& memory = limits.max_memory; memory > 0) {
    const std::uint64_t of_pairs = bytes_of_pairs(model);
    if (of_pairs >= memory) return end_before_moves(ExplorationEnd::max_memory);
    memory -= of_pairs;
  }
  const Stepper::Options of_stepper = share_memory(options, limits.max_memory);
  StateSpace space(model, of_stepper, limits, [&](const ExplorationProgress& progress) {
    return !options.on_progress || options.on_progress(groups, progress);
  });
  std::vector<PropertyTest> tests;
  tests.reserve(properties.size());
  for (const Property* const property : properties) tests.emplace_back(*property, model, space);
  PropertyVisitor visitor(model, space, tests);
  space.run(visitor);

  const Decisions& decisions = space.controls().stepper().decisions();
  result.decisions_remembered = decisions.remembered();
  result.decisions_computed = decisions.computed();
  result.complete = space.is_complete();
  result.reduced = options.reduce;
  if (!result.complete) result.end = space.end();
  result.states = space.states();
  result.transitions = space.transitions();
  result.depth = space.expanded_depth();
  result.states_at_depth = space.states_at_depth();
  result.bytes = space.bytes();
  result.controls = space.controls().size();
  result.regions = space.controls().regions();
  result.diagram_nodes = space.environments().sets().nodes();
  visitor.report(result);
  for (const PropertyTest& test : tests) result.verdicts.push_back(test.verdict(catalog, space));
  return result;
}

bool Verification::is_complete() const {
  return std::all_of(explorations.begin(), explorations.end(),
                     [](const Exploration& exploration) { return exploration.complete; });
}

PropertyScope scope_of(const CompiledCatalog& catalog, const Property& property) {
  const std::vector<const StateCondition*> conditions = conditions_of(property);
  std::set<GroupId> groups;
  if (property.task != none) groups.insert(catalog.tasks[property.task].group);
  for (const StateCondition* condition : conditions) add_groups(catalog, *condition, groups);
  if (groups.empty()) {
    for (const StateCondition* condition : conditions) {
      add_groups_of_variables(catalog, *condition, groups);
    }
  }
  const bool is_about_faults =
      std::any_of(conditions.begin(), conditions.end(),
                  [](const StateCondition* condition) { return condition->none_faulty; });
  if (groups.empty() && is_about_faults) {
    for (GroupId group(0); group < catalog.group_count(); ++group) groups.insert(group);
  }
  std::set<std::uint32_t> variables = variables_of(property);
  for (const FittingValue& fitting : catalog.fitting_values) {
    if (groups.contains(catalog.group_of(fitting.behavior))) variables.erase(fitting.variable);
  }
  return {{groups.begin(), groups.end()}, std::move(variables)};
}

namespace {

/// What one exploration is about.
struct ExplorationTask {
  std::vector<GroupId> groups;
  std::vector<const Property*> properties;
};

/// Several explorations, up to `jobs` at a time.
std::vector<Exploration> explore_all(const CompiledCatalog& catalog, const Assumptions& assumptions,
                                     const std::vector<ExplorationTask>& tasks,
                                     const ExplorationOptions& options) {
  std::vector<Exploration> explorations(tasks.size());
  std::mutex telling;
  ExplorationOptions each = options;
  if (options.on_progress) {
    each.on_progress = [&](const std::vector<GroupId>& groups,
                           const ExplorationProgress& progress) {
      const std::lock_guard lock(telling);
      return options.on_progress(groups, progress);
    };
  }
  for_each_in_threads(tasks.size(), options.jobs, [&](std::size_t, std::size_t place) {
    const ExplorationTask& task = tasks[place];
    explorations[place] = explore(catalog, task.groups, assumptions, task.properties, each);
  });
  return explorations;
}

std::vector<Exploration> explore_groups(const CompiledCatalog& catalog,
                                        const Assumptions& assumptions,
                                        const ExplorationOptions& options) {
  std::vector<ExplorationTask> tasks;
  tasks.reserve(catalog.group_count());
  for (GroupId group(0); group < catalog.group_count(); ++group) tasks.push_back({{group}, {}});
  return explore_all(catalog, assumptions, tasks, options);
}

}  // namespace

Verification verify_groups(const CompiledCatalog& catalog, const ExplorationOptions& options) {
  Verification result;
  result.explorations = explore_groups(catalog, default_assumptions(catalog), options);
  return result;
}

Verification verify_properties(const CompiledCatalog& catalog, const PropertyFile& file,
                               const ExplorationOptions& options) {
  Verification result;
  result.file = &file;
  if (file.properties.empty()) {
    result.explorations = explore_groups(catalog, file.assumptions, options);
    return result;
  }
  result.answers.resize(file.properties.size());
  std::map<PropertyScope, std::vector<std::size_t>> by_scope;
  for (std::size_t place = 0; place < file.properties.size(); ++place) {
    by_scope[scope_of(catalog, file.properties[place])].push_back(place);
  }
  std::vector<ExplorationTask> tasks;
  for (const auto& [scope, places] : by_scope) {
    ExplorationTask& task = tasks.emplace_back();
    task.groups = scope.groups;
    for (const std::size_t place : places) task.properties.push_back(&file.properties[place]);
  }
  result.explorations = explore_all(catalog, file.assumptions, tasks, options);
  std::size_t explored = 0;
  for (const auto& [scope, places] : by_scope) {
    const Exploration& exploration = result.explorations[explored];
    for (std::size_t number = 0; number < places.size(); ++number) {
      Answer& answer = result.answers[places[number]];
      answer.property = tasks[explored].properties[number];
      answer.exploration = explored;
      answer.verdict = exploration.verdicts[number];
      if (!answer.verdict.has_script) continue;
      const bool is_witness = answer.verdict.result == Verdict::Result::proved;
      const std::string comment = fmt::format("{}: {}\nRun it with: cbc solve CATALOG FILE\n",
                                              is_witness ? "Witness" : "Counterexample",
                                              title_of(catalog, file, *answer.property));
      answer.witness = make_witness(catalog, scope.groups, file.assumptions, answer.verdict.script,
                                    answer.property, comment);
    }
    ++explored;
  }
  return result;
}

}  // namespace cbc
