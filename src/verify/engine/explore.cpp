#include "verify/engine/explore.h"

#include <algorithm>
#include <memory>
#include <set>

#include "verify/engine/breadth_first.h"
#include "verify/engine/model.h"
#include "verify/engine/stepper.h"

namespace cbc {

namespace {

using Number = StateStore::Number;
constexpr Number never_seen = UINT32_MAX;

/// A condition on the states of a model.
class StateTest {
 public:
  StateTest(const Model& model, const StateCondition& condition);

  [[nodiscard]] bool holds(const Stepper& state) const;

 private:
  struct Part {
    std::uint32_t subject = 0;
    std::uint32_t wanted = 0;
  };

  bool is_false_ = false;
  std::vector<Part> values_;  ///< tasks and cells; `none`: any behavior
  std::vector<std::uint32_t> stopped_;
  std::vector<std::uint32_t> active_;
  std::vector<std::uint32_t> faulty_;
  std::vector<std::uint32_t> available_;
  std::vector<Part> requested_;  ///< tasks and the least rank + 1
  std::vector<Part> variables_;
  std::vector<Part> own_;  ///< behaviors and whether own(b) is true
};

StateTest::StateTest(const Model& model, const StateCondition& condition) {
  for (const StateCondition::Running& running : condition.running) {
    const std::uint32_t task = model.find_task(running.task);
    if (running.behavior == none) {
      values_.push_back({task, none});
      continue;
    }
    const BitRange values = model.tasks()[task].values;
    const std::uint32_t behavior = model.find_behavior(running.behavior);
    std::uint32_t cell = 0;
    for (std::uint32_t value = values.begin; value < values.end; ++value) {
      if (model.behavior_of(value) == behavior) cell = value - values.begin + 1;
    }
    if (cell == 0) is_false_ = true;
    values_.push_back({task, cell});
  }
  for (const TaskId task : condition.stopped) stopped_.push_back(model.find_task(task));
  const auto add_behaviors = [&](const std::vector<BehaviorId>& from, auto& to) {
    for (const BehaviorId behavior : from) to.push_back(model.find_behavior(behavior));
  };
  add_behaviors(condition.active, active_);
  add_behaviors(condition.faulty, faulty_);
  add_behaviors(condition.available, available_);
  for (const StateCondition::Requested& requested : condition.requested) {
    const Model::Rank rank = model.rank_of(requested.priority);
    requested_.push_back({model.find_task(requested.task), rank + 1U});
  }
  for (const SituationPart::Own& own : condition.situation.behaviors) {
    own_.push_back({model.find_behavior(own.behavior), own.available ? 1U : 0U});
  }
  for (const VariableValue& value : condition.situation.variables) {
    variables_.push_back({model.find_variable(value.variable), value.value});
  }
}

bool StateTest::holds(const Stepper& state) const {
  if (is_false_) return false;
  const std::uint16_t* const cells = state.cells();
  const auto all = [](const auto& parts, auto&& test) {
    return std::all_of(parts.begin(), parts.end(), test);
  };
  return all(values_,
             [&](Part part) {
               return part.wanted == none ? cells[part.subject] != 0
                                          : cells[part.subject] == part.wanted;
             }) &&
         all(stopped_, [&](std::uint32_t task) { return cells[task] == 0; }) &&
         all(active_,
             [&](std::uint32_t behavior) { return has_bit(state.active().data(), behavior); }) &&
         all(variables_, [&](Part part) { return state.value_of(part.subject) == part.wanted; }) &&
         all(own_,
             [&](Part part) { return state.is_denied(part.subject) != (part.wanted != 0); }) &&
         all(faulty_, [&](std::uint32_t behavior) { return state.is_faulty(behavior); }) &&
         all(available_, [&](std::uint32_t behavior) { return state.is_available(behavior); }) &&
         all(requested_, [&](Part part) { return state.request_of(part.subject) >= part.wanted; });
}

/// What is looked for in states.
class Goal {
 public:
  Goal(const Model& model, const Property& property) : property_(property) {
    if (property.kind == Property::Kind::can_start) {
      task_ = model.find_task(property.task);
      ranks_ = model.ranks_up_to(property.priority);
      return;
    }
    condition_.emplace(model, property.condition);
    if (property.when) when_.emplace(model, *property.when);
  }

  [[nodiscard]] bool is_start() const { return property_.kind == Property::Kind::can_start; }
  [[nodiscard]] std::uint32_t task() const { return task_; }
  [[nodiscard]] Model::Rank ranks() const { return ranks_; }

  /// Whether the state is a counterexample or, of reachable, a witness.
  [[nodiscard]] bool is_met(Stepper& state) const {
    if (is_start()) {
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
struct Sightings {
  std::vector<Number> runs;           ///< by task
  std::vector<Number> active;         ///< by behavior
  std::vector<Number> start_refused;  ///< by task
  std::vector<Number> together;       ///< by two tasks
  std::vector<Number> goals;

  /// Drops what was seen in this state and in later ones.
  void drop_from(Number end) {
    for (std::vector<Number>* const numbers : {&runs, &active, &start_refused, &together, &goals}) {
      for (Number& number : *numbers) {
        if (number >= end) number = never_seen;
      }
    }
  }

  void add(const Sightings& other) {
    const auto lower = [](std::vector<Number>& mine, const std::vector<Number>& theirs) {
      for (std::size_t place = 0; place < mine.size(); ++place) {
        mine[place] = std::min(mine[place], theirs[place]);
      }
    };
    lower(runs, other.runs);
    lower(active, other.active);
    lower(start_refused, other.start_refused);
    lower(together, other.together);
    lower(goals, other.goals);
  }
};

class GroupExpander final : public Expander {
 public:
  GroupExpander(const Model& model, const std::vector<Goal>& goals, const Stepper::Options& options)
      : model_(model), goals_(goals), stepper_(model, options) {
    const std::size_t tasks = model.tasks().size();
    seen_.runs.assign(tasks, never_seen);
    seen_.active.assign(model.behaviors().size(), never_seen);
    seen_.start_refused.assign(tasks, never_seen);
    seen_.together.assign(tasks * tasks, never_seen);
    seen_.goals.assign(goals.size(), never_seen);
    together_.assign(tasks * words_for(tasks), 0);
    find_unasked_starts();
  }

  void expand(const std::uint32_t* state, Number number, Successors& successors) override {
    stepper_.load(state);
    look(number, successors);
    for (const Model::Choice& choice : model_.moves()) {
      if (!successors.may_go_on()) return;
      if (!stepper_.has_move(choice) || !stepper_.take(choice)) continue;
      if (choice.move.kind == Move::Kind::start && choice.move.choice == 1 &&
          !stepper_.was_accepted()) {
        note_refusal(choice.subject, number);
      }
      stepper_.pack(successors.add());
    }
  }

  /// What was seen. Nothing can be expanded after it.
  [[nodiscard]] Sightings release() { return std::move(seen_); }
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

  void look(Number number, Successors& successors) {
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
    for (std::size_t place = 0; place < goals_.size(); ++place) {
      if (seen_.goals[place] == never_seen && goals_[place].is_met(stepper_)) {
        seen_.goals[place] = number;
      }
    }
  }

  const Model& model_;
  const std::vector<Goal>& goals_;
  Stepper stepper_;
  std::vector<std::uint32_t> unasked_;
  Sightings seen_;
  std::vector<Word> together_;  ///< by task: the tasks that were seen to run beside it
};

/// The first move that leads from one state to another.
Move find_move(const Model& model, Stepper& stepper, const std::uint32_t* from,
               const std::uint32_t* to) {
  std::vector<std::uint32_t> packed(model.packed_words());
  stepper.load(from);
  for (const Model::Choice& choice : model.moves()) {
    if (!stepper.has_move(choice) || !stepper.take(choice)) continue;
    stepper.pack(packed.data());
    if (std::equal(packed.begin(), packed.end(), to)) return stepper.move_of(choice);
  }
  return {};
}

std::vector<Move> moves_to(const Model& model, const BreadthFirst& search, Number number,
                           bool reduce) {
  Stepper stepper(model, {.reduce = reduce});
  std::vector<Move> moves;
  const std::vector<Number> path = search.path_to(number);
  for (std::size_t place = 1; place < path.size(); ++place) {
    moves.push_back(find_move(model, stepper, search.store().state(path[place - 1]),
                              search.store().state(path[place])));
  }
  return moves;
}

void report_sightings(const Model& model, const BreadthFirst& search, const Sightings& seen,
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
                   Number first, bool reduce) {
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
  verdict.script = moves_to(model, search, first, reduce);
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
Stepper::Options share_memory(ExplorationOptions& options) {
  Stepper::Options result;
  result.reduce = options.reduce;
  constexpr std::uint64_t most = std::uint64_t{256} << 20;
  const std::uint64_t jobs = options.jobs;
  std::uint64_t& memory = options.limits.max_memory;
  result.decision_bytes = memory == 0 ? most : std::min(most, memory / 4 / jobs);
  // An array that grows takes twice its size for a while.
  if (memory > 0) memory -= std::min(memory / 2, 2 * jobs * result.decision_bytes);
  return result;
}

}  // namespace

Exploration explore(const CompiledCatalog& catalog, const std::vector<std::uint32_t>& groups,
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
  if (options.on_progress && !options.on_progress({})) {
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
  ExplorationOptions of_search = options;
  of_search.jobs = std::max(1U, options.jobs);
  if (std::uint64_t& memory = of_search.limits.max_memory; memory > 0) {
    const std::uint64_t of_pairs = bytes_of_pairs(model, of_search.jobs);
    if (of_pairs >= memory) return end_before_moves(ExplorationEnd::max_memory);
    memory -= of_pairs;
  }
  std::vector<Goal> goals;
  goals.reserve(properties.size());
  for (const Property* const property : properties) goals.emplace_back(model, *property);

  const std::vector<std::uint16_t> cells = model.first_state();
  std::vector<std::uint32_t> first(model.packed_words());
  model.pack(cells.data(), first.data());
  const Stepper::Options of_steppers = share_memory(of_search);
  BreadthFirst search(first, of_search);
  std::vector<std::unique_ptr<Expander>> expanders;
  std::vector<GroupExpander*> of_groups;
  for (unsigned job = 0; job < of_search.jobs; ++job) {
    auto expander = std::make_unique<GroupExpander>(model, goals, of_steppers);
    of_groups.push_back(expander.get());
    expanders.push_back(std::move(expander));
  }
  search.run(expanders);

  Sightings seen = of_groups.front()->release();
  for (GroupExpander* const expander : of_groups) {
    if (expander != of_groups.front()) seen.add(expander->release());
    result.decisions_remembered += expander->decisions().remembered();
    result.decisions_computed += expander->decisions().computed();
  }
  // Of a batch that a limit cut short, some threads have seen more than others.
  seen.drop_from(search.expanded());
  result.complete = search.is_complete();
  result.reduced = options.reduce;
  if (!result.complete) result.end = search.end();
  result.states = search.store().size();
  result.transitions = search.transitions();
  result.depth = search.expanded_depth();
  result.states_at_depth = search.states_at_depth();
  result.bytes = search.store().bytes();
  report_sightings(model, search, seen, result);
  for (std::size_t place = 0; place < properties.size(); ++place) {
    result.verdicts.push_back(
        verdict_of(model, search, *properties[place], seen.goals[place], options.reduce));
  }
  return result;
}

}  // namespace cbc
