// What holds in all reachable states of some groups: explicit-state model checking of invariants
// (G. J. Holzmann, "The SPIN Model Checker", 2003; "Handbook of Model Checking", edited by E. M.
// Clarke, T. A. Henzinger, H. Veith and R. Bloem, 2018, chapter 5). The search of BreadthFirst
// makes every move of every state once. A visitor notes the first state in which a task ran, a
// start was refused, a property was violated; states are numbered breadth first, so the path to the
// first is a shortest one.
//
// A depth-first search finds long counterexamples, and other ones for each number of threads. A
// symbolic search (binary decision diagrams) or a bounded one (SAT) would need every decision as a
// formula, but a decision is an optimum over all assignments: here the solver makes it, and
// Decisions remembers it.

#include "verify/engine/explore.h"

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/report/words.h"
#include "runtime/base/text.h"
#include "verify/engine/stepper.h"

namespace cbc {

namespace {

using Number = StateStore::Number;
constexpr Number never_seen = UINT32_MAX;

/// A condition on the states of a model.
class StateTest {
 public:
  StateTest(const Model& model, const StateCondition& condition) {
    for (const StateCondition::Running& running : condition.running) {
      const std::uint32_t task = model.find_task(running.task);
      if (running.behavior == none) {
        add([](const Stepper& state, Part part) { return state.cells()[part.subject] != 0; }, task);
      } else {
        add([](const Stepper& state,
               Part part) { return state.cells()[part.subject] == part.wanted; },
            task, cell_of(model, task, model.find_behavior(running.behavior)));
      }
    }
    for (const TaskId task : condition.stopped) {
      add([](const Stepper& state, Part part) { return state.cells()[part.subject] == 0; },
          model.find_task(task));
    }
    for (const BehaviorId behavior : condition.active) {
      add([](const Stepper& state,
             Part part) { return has_bit(state.active().data(), part.subject); },
          model.find_behavior(behavior));
    }
    if (condition.only_active) add_others(model, condition.active);
    for (const VariableValue& value : condition.situation.variables) {
      add([](const Stepper& state,
             Part part) { return state.value_of(part.subject) == part.wanted; },
          model.find_variable(value.variable), value.value);
    }
    for (const SituationPart::Own& own : condition.situation.behaviors) {
      add([](const Stepper& state,
             Part part) { return state.is_denied(part.subject) == (part.wanted == 0); },
          model.find_behavior(own.behavior), own.available ? 1 : 0);
    }
    for (const BehaviorId behavior : condition.faulty) {
      add([](const Stepper& state, Part part) { return state.is_faulty(part.subject); },
          model.find_behavior(behavior));
    }
    for (const BehaviorId behavior : condition.available) {
      add([](const Stepper& state, Part part) { return state.is_available(part.subject); },
          model.find_behavior(behavior));
    }
    for (const StateCondition::Requested& requested : condition.requested) {
      add([](const Stepper& state,
             Part part) { return state.request_of(part.subject) >= part.wanted; },
          model.find_task(requested.task), model.rank_of(requested.priority) + 1U);
    }
  }

  [[nodiscard]] bool holds(const Stepper& state) const {
    return std::all_of(tests_.begin(), tests_.end(),
                       [&](const Test& test) { return test.holds(state, test.part); });
  }

 private:
  struct Part {
    std::uint32_t subject = 0;
    std::uint32_t wanted = 0;
  };
  struct Test {
    bool (*holds)(const Stepper& state, Part part);
    Part part;
  };

  void add(bool (*test)(const Stepper&, Part), std::uint32_t subject, std::uint32_t wanted = 0) {
    tests_.push_back({test, {subject, wanted}});
  }
  /// The behaviors that are not listed are not active.
  void add_others(const Model& model, const std::vector<BehaviorId>& listed) {
    for (std::uint32_t behavior = 0; behavior < model.behaviors().size(); ++behavior) {
      const BehaviorId id = model.behaviors()[behavior].id;
      if (std::find(listed.begin(), listed.end(), id) != listed.end()) continue;
      add([](const Stepper& state,
             Part part) { return !has_bit(state.active().data(), part.subject); },
          behavior);
    }
  }
  /// None, which no cell has, if the behavior does not perform the task.
  [[nodiscard]] static std::uint32_t cell_of(const Model& model, std::uint32_t task,
                                             std::uint32_t behavior) {
    const BitRange values = model.tasks()[task].values;
    for (std::uint32_t value = values.begin; value < values.end; ++value) {
      if (model.behavior_of(value) == behavior) return value - values.begin + 1;
    }
    return none;
  }

  std::vector<Test> tests_;
};

/// A property on the states of a model.
class PropertyTest {
 public:
  PropertyTest(const Model& model, const Property& property) : property_(property) {
    if (property.kind == Property::Kind::can_start) {
      task_ = model.find_task(property.task);
      ranks_ = model.ranks_up_to(property.priority);
      return;
    }
    condition_.emplace(model, property.condition);
    if (property.when) when_.emplace(model, *property.when);
  }

  /// Whether the state is a counterexample or, of reachable, a witness.
  [[nodiscard]] bool is_met(Stepper& state) const {
    if (property_.kind == Property::Kind::can_start) {
      return state.cells()[task_] == 0 && !state.would_start(task_, ranks_);
    }
    if (property_.settled && !state.is_settled()) return false;
    if (when_ && !when_->holds(state)) return false;
    return condition_->holds(state) == (property_.kind != Property::Kind::always);
  }

 private:
  const Property& property_;
  std::uint32_t task_ = none;
  Model::Rank ranks_ = 0;
  std::optional<StateTest> condition_;
  std::optional<StateTest> when_;
};

/// The lowest numbers of states in which something was seen.
struct FirstSeen {
  std::vector<Number> runs;           ///< by task
  std::vector<Number> active;         ///< by behavior
  std::vector<Number> start_refused;  ///< by task
  std::vector<Number> together;       ///< by two tasks
  std::vector<Number> decided;        ///< by property

  std::array<std::vector<Number>*, 5> all() {
    return {&runs, &active, &start_refused, &together, &decided};
  }
  /// Adds what another thread saw, and drops what was seen in this state and later ones.
  void add(FirstSeen& other, Number end) {
    for (std::size_t list = 0; list < all().size(); ++list) {
      std::vector<Number>& mine = *all().at(list);
      const std::vector<Number>& theirs = *other.all().at(list);
      for (std::size_t place = 0; place < mine.size(); ++place) {
        const Number first = std::min(mine[place], theirs[place]);
        mine[place] = first < end ? first : never_seen;
      }
    }
  }
};

class PropertyVisitor {
 public:
  PropertyVisitor(const Model& model, const std::vector<PropertyTest>& properties,
                  const Stepper::Options& options)
      : model_(model), properties_(properties), stepper_(model, options) {
    const std::size_t tasks = model.tasks().size();
    seen_.runs.assign(tasks, never_seen);
    seen_.active.assign(model.behaviors().size(), never_seen);
    seen_.start_refused.assign(tasks, never_seen);
    seen_.together.assign(tasks * tasks, never_seen);
    seen_.decided.assign(properties.size(), never_seen);
    together_.assign(tasks * words_for(tasks), 0);
    find_unasked_starts();
  }

  [[nodiscard]] Stepper& system() { return stepper_; }
  [[nodiscard]] bool is_done() const { return false; }

  void visit(Number number, Successors& successors) {
    const auto& running = stepper_.running();
    const std::size_t words = running.size();
    const std::size_t tasks = model_.tasks().size();
    for_each_bit(running.data(), words, [&](std::uint32_t task) {
      note(seen_.runs[task], number);
      Word* const known = &together_[task * words];
      for (std::size_t word = 0; word < words; ++word) {
        Word fresh = running[word] & ~known[word];
        known[word] |= fresh;
        for (; fresh != 0; fresh &= fresh - 1) {
          const auto other = word * 64 + static_cast<unsigned>(std::countr_zero(fresh));
          seen_.together[task * tasks + other] = number;
        }
      }
    });
    for_each_bit(stepper_.active().data(), stepper_.active().size(),
                 [&](std::uint32_t behavior) { note(seen_.active[behavior], number); });
    for (const std::uint32_t task : unasked_) {
      if (seen_.start_refused[task] != never_seen || stepper_.cells()[task] != 0) continue;
      if (!successors.may_go_on()) return;
      if (!stepper_.would_start(task, model_.ranks_up_to(1))) note_refusal(task, number);
    }
    for (std::size_t place = 0; place < properties_.size(); ++place) {
      if (seen_.decided[place] == never_seen && properties_[place].is_met(stepper_)) {
        seen_.decided[place] = number;
      }
    }
  }

  void on_move(Number number, const Model::Choice& choice, const std::uint32_t* /*successor*/) {
    if (choice.move.kind == Move::Kind::start && choice.move.choice == 1 &&
        !stepper_.was_accepted()) {
      note_refusal(choice.subject, number);
    }
  }

  [[nodiscard]] FirstSeen& seen() { return seen_; }
  [[nodiscard]] const Decisions& decisions() const { return stepper_.decisions(); }

 private:
  /// Tasks that start on request, but are not started with priority 1 by a move.
  void find_unasked_starts() {
    for (std::uint32_t task = 0; task < model_.tasks().size(); ++task) {
      if (!model_.tasks()[task].start_on_request) continue;
      const auto& moves = model_.moves();
      const bool is_asked = std::any_of(moves.begin(), moves.end(), [&](const auto& choice) {
        return choice.move.kind == Move::Kind::start && choice.subject == task &&
               choice.move.choice == 1;
      });
      if (!is_asked) unasked_.push_back(task);
    }
  }

  static void note(Number& first, Number number) {
    if (first == never_seen) first = number;
  }
  void note_refusal(std::uint32_t task, Number number) {
    if (stepper_.cells()[task] == 0 && model_.tasks()[task].start_on_request) {
      note(seen_.start_refused[task], number);
    }
  }

  const Model& model_;
  const std::vector<PropertyTest>& properties_;
  Stepper stepper_;
  std::vector<std::uint32_t> unasked_;
  FirstSeen seen_;
  std::vector<Word> together_;  ///< by task: the tasks that were seen to run beside it
};

void report_first_seen(const Model& model, const BreadthFirst& search, const FirstSeen& seen,
                       Exploration& result) {
  const CompiledCatalog& catalog = model.catalog();
  const auto index_of = [&](std::uint32_t task) {
    return catalog.tasks[model.tasks()[task].id].catalog_index;
  };
  for (const std::uint32_t task : model.tasks_in_order()) {
    if (seen.runs[task] != never_seen) {
      result.runs.emplace_back(index_of(task), search.depth_of(seen.runs[task]));
    }
    if (seen.start_refused[task] != never_seen) {
      result.start_refused.emplace_back(index_of(task), search.depth_of(seen.start_refused[task]));
    }
  }
  for (const std::uint32_t behavior : model.behaviors_in_order()) {
    if (seen.active[behavior] == never_seen) continue;
    result.active.emplace_back(catalog.behaviors[model.behaviors()[behavior].id].catalog_index,
                               search.depth_of(seen.active[behavior]));
  }
  const auto& tasks = model.tasks_in_order();
  for (auto a = tasks.begin(); a != tasks.end(); ++a) {
    for (auto b = a + 1; b != tasks.end(); ++b) {
      const Number first = seen.together[*a * tasks.size() + *b];
      if (first == never_seen) continue;
      result.together.push_back({index_of(*a), index_of(*b), search.depth_of(first)});
    }
  }
}

Verdict verdict_of(const Model& model, const BreadthFirst& search, const Property& property,
                   Number first, Stepper& stepper) {
  Verdict verdict;
  const bool is_reachable = property.kind == Property::Kind::reachable;
  if (first == never_seen) {
    if (search.is_complete()) {
      verdict.result = is_reachable ? Verdict::Result::violated : Verdict::Result::proved;
    }
    return verdict;
  }
  verdict.result = is_reachable ? Verdict::Result::proved : Verdict::Result::violated;
  verdict.has_script = true;
  verdict.script = search.moves_to(stepper, first);
  if (property.kind == Property::Kind::can_start) {
    const std::uint32_t index = model.catalog().tasks[property.task].catalog_index;
    verdict.script.push_back({Move::Kind::start, index, property.priority});
  }
  return verdict;
}

/// What the tables of pairs of tasks take, before any state is visited: in the model, the needs and
/// the rivals; for each job, what was seen to run together, and where first.
std::uint64_t bytes_of_pairs(const Model& model, unsigned jobs) {
  const std::uint64_t pairs = std::uint64_t{model.tasks().size()} * model.tasks().size();
  return pairs / 4 + jobs * (pairs / 8 + pairs * sizeof(Number));
}

/// Sets apart a quarter of the memory for remembered decisions.
Stepper::Options share_memory(const ExplorationOptions& options, unsigned jobs,
                              std::uint64_t& memory) {
  Stepper::Options result;
  result.reduce = options.reduce;
  constexpr std::uint64_t most = std::uint64_t{256} << 20;
  result.decision_bytes = memory == 0 ? most : std::min(most, memory / 4 / jobs);
  // An array that grows takes twice its size for a while.
  if (memory > 0) memory -= std::min(memory / 2, std::uint64_t{2} * jobs * result.decision_bytes);
  return result;
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
  for (const auto& own : condition.situation.behaviors) add_behavior(own.behavior);
}

void add_groups_of_variables(const CompiledCatalog& catalog, const StateCondition& condition,
                             std::set<GroupId>& groups) {
  for (const VariableValue& value : condition.situation.variables) {
    for (const FittingValue& fitting : catalog.fitting_values) {
      if (fitting.variable == value.variable) groups.insert(catalog.group_of(fitting.behavior));
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
  const unsigned jobs = std::max(1U, options.jobs);
  ExplorationLimits limits = options.limits;
  if (std::uint64_t& memory = limits.max_memory; memory > 0) {
    const std::uint64_t of_pairs = bytes_of_pairs(model, jobs);
    if (of_pairs >= memory) return end_before_moves(ExplorationEnd::max_memory);
    memory -= of_pairs;
  }
  std::vector<PropertyTest> tests;
  tests.reserve(properties.size());
  for (const Property* const property : properties) tests.emplace_back(model, *property);

  const Stepper::Options of_steppers = share_memory(options, jobs, limits.max_memory);
  BreadthFirst search(model.packed_first(), limits, [&](const ExplorationProgress& progress) {
    return !options.on_progress || options.on_progress(groups, progress);
  });
  std::deque<PropertyVisitor> visitors;
  while (visitors.size() < jobs) visitors.emplace_back(model, tests, of_steppers);
  search.run(visitors);

  FirstSeen& seen = visitors.front().seen();
  for (PropertyVisitor& visitor : visitors) {
    // Of a batch that a limit cut short, some threads have seen more than others.
    seen.add(visitor.seen(), search.expanded());
    result.decisions_remembered += visitor.decisions().remembered();
    result.decisions_computed += visitor.decisions().computed();
  }
  result.complete = search.is_complete();
  result.reduced = options.reduce;
  if (!result.complete) result.end = search.end();
  result.states = search.store().size();
  result.transitions = search.transitions();
  result.depth = search.expanded_depth();
  result.states_at_depth = search.states_at_depth();
  result.bytes = search.store().bytes();
  report_first_seen(model, search, seen, result);
  for (std::size_t place = 0; place < properties.size(); ++place) {
    result.verdicts.push_back(verdict_of(model, search, *properties[place], seen.decided[place],
                                         visitors.front().system()));
  }
  return result;
}

bool Verification::is_complete() const {
  return std::all_of(explorations.begin(), explorations.end(),
                     [](const Exploration& exploration) { return exploration.complete; });
}

PropertyScope scope_of(const CompiledCatalog& catalog, const Property& property) {
  std::set<GroupId> groups;
  if (property.task != none) groups.insert(catalog.tasks[property.task].group);
  add_groups(catalog, property.condition, groups);
  if (property.when) add_groups(catalog, *property.when, groups);
  if (groups.empty()) {
    add_groups_of_variables(catalog, property.condition, groups);
    if (property.when) add_groups_of_variables(catalog, *property.when, groups);
  }
  std::set<std::uint32_t> variables = variables_of(property);
  for (const FittingValue& fitting : catalog.fitting_values) {
    if (groups.contains(catalog.group_of(fitting.behavior))) variables.erase(fitting.variable);
  }
  return {{groups.begin(), groups.end()}, std::move(variables)};
}

namespace {

std::vector<Exploration> explore_groups(const CompiledCatalog& catalog,
                                        const Assumptions& assumptions,
                                        const ExplorationOptions& options) {
  std::vector<Exploration> explorations;
  for (GroupId group(0); group < catalog.group_count(); ++group) {
    const std::vector<GroupId> groups{group};
    explorations.push_back(explore(catalog, groups, assumptions, {}, options));
  }
  return explorations;
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
  for (const auto& [scope, places] : by_scope) {
    std::vector<const Property*> properties;
    for (const std::size_t place : places) properties.push_back(&file.properties[place]);
    const std::vector<GroupId>& explored = scope.groups;
    result.explorations.push_back(
        explore(catalog, explored, file.assumptions, properties, options));
    const Exploration& exploration = result.explorations.back();
    for (std::size_t number = 0; number < places.size(); ++number) {
      Answer& answer = result.answers[places[number]];
      answer.property = properties[number];
      answer.exploration = result.explorations.size() - 1;
      answer.verdict = exploration.verdicts[number];
      if (!answer.verdict.has_script) continue;
      const bool is_witness = answer.verdict.result == Verdict::Result::proved;
      const std::string comment = fmt::format("{}: {}\nRun it with: cbc solve CATALOG FILE\n",
                                              is_witness ? "Witness" : "Counterexample",
                                              title_of(catalog, file, *answer.property));
      answer.witness = make_witness(catalog, explored, file.assumptions, answer.verdict.script,
                                    answer.property, comment);
    }
  }
  return result;
}

}  // namespace cbc
