// Whether two catalogs decide alike: no reachable state of their product has a move with two
// answers (equivalence of sequential machines: O. Coudert, C. Berthet and J. C. Madre,
// "Verification of synchronous sequential machines based on symbolic execution", 1989).
//
// To merge pairs whose states are known to be alike (J. E. Hopcroft and R. M. Karp, "A linear
// algorithm for testing equivalence of finite automata", 1971) would spare nothing: two catalogs
// that are alike have about as many pairs as states. And comparing the answers of each decision,
// whether it can come or not, would find differences that no event shows.

#include "verify/engine/same_as.h"

#include <algorithm>
#include <deque>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "runtime/base/disjoint_sets.h"
#include "runtime/base/text.h"
#include "runtime/coordinator/record.h"
#include "verify/engine/stepper.h"

namespace cbc {

namespace {

using Number = StateStore::Number;

/// The numbers that one catalog's tasks, behaviors and variables have in another; none: it does not
/// have them. From TaskId to TaskId, BehaviorId to BehaviorId, place to place.
struct Translation {
  Translation(const CompiledCatalog& from, const CompiledCatalog& to) {
    for (TaskId task(0); task < from.tasks.size(); ++task) {
      const auto found = to.find_task(from.name_of_task(task));
      tasks.push_back(found ? to.task_ids[*found] : none);
    }
    for (BehaviorId behavior(0); behavior < from.behaviors.size(); ++behavior) {
      const auto found = to.find_behavior(from.name_of_behavior(behavior));
      behaviors.push_back(found ? to.behavior_ids[*found] : none);
    }
    for (std::uint32_t variable = 0; variable < from.variables.size(); ++variable) {
      const auto found = to.find_variable(from.name_of_variable(variable));
      variables.push_back(found.value_or(none));
      auto& of_variable = values.emplace_back(from.variables[variable].value_count, none);
      for (std::uint32_t value = 0; found && value < of_variable.size(); ++value) {
        of_variable[value] =
            to.find_value(*found, from.name_of_value({variable, value})).value_or(none);
      }
    }
  }

  std::vector<TaskId> tasks;
  std::vector<BehaviorId> behaviors;
  std::vector<std::uint32_t> variables;
  std::vector<std::vector<std::uint32_t>> values;  ///< by variable
};

void list_missing(const CompiledCatalog& catalog, const Translation& translation,
                  std::vector<std::string>& names) {
  for (const TaskId task : catalog.task_ids) {
    if (translation.tasks[task] == none) {
      names.push_back(fmt::format("task {}", printable(catalog.name_of_task(task))));
    }
  }
  for (const BehaviorId behavior : catalog.behavior_ids) {
    if (translation.behaviors[behavior] == none) {
      names.push_back(fmt::format("behavior {}", printable(catalog.name_of_behavior(behavior))));
    }
  }
  for (std::uint32_t variable = 0; variable < translation.variables.size(); ++variable) {
    const std::string name = printable(catalog.name_of_variable(variable));
    if (translation.variables[variable] == none) {
      names.push_back(fmt::format("variable {}", name));
      continue;
    }
    for (std::uint32_t value = 0; value < translation.values[variable].size(); ++value) {
      if (translation.values[variable][value] != none) continue;
      names.push_back(
          fmt::format("value {} of {}", printable(catalog.name_of_value({variable, value})), name));
    }
  }
}

SituationPart translate(const SituationPart& part, const Translation& to, bool& is_whole) {
  SituationPart result;
  for (const VariableValue& value : part.variables) {
    const std::uint32_t variable = to.variables[value.variable];
    const std::uint32_t translated =
        variable == none ? none : to.values[value.variable][value.value];
    if (translated == none) {
      is_whole = false;
    } else {
      result.variables.push_back({variable, translated});
    }
  }
  for (const SituationPart::Own& own : part.behaviors) {
    if (to.behaviors[own.behavior] == none) {
      is_whole = false;
    } else {
      result.behaviors.push_back({to.behaviors[own.behavior], own.available});
    }
  }
  return result;
}

/// The numbers of another catalog for those of a list, without what it does not have.
template <typename Number>
std::vector<Number> translate(const std::vector<Number>& from, const std::vector<Number>& to) {
  std::vector<Number> result;
  for (const Number number : from) {
    if (to[number] != none) result.push_back(to[number]);
  }
  return result;
}

Assumptions translate(const Assumptions& from, const Translation& to) {
  Assumptions result = from;
  result.start.clear();
  for (const Assumptions::Start& start : from.start) {
    if (to.tasks[start.task] == none) continue;
    result.start.push_back({to.tasks[start.task], start.priorities});
  }
  result.stop = translate(from.stop, to.tasks);
  result.variables = translate(from.variables, to.variables);
  result.behaviors = translate(from.behaviors, to.behaviors);
  result.never.clear();
  for (const SituationPart& part : from.never) {
    bool is_whole = true;
    SituationPart translated = translate(part, to, is_whole);
    if (is_whole) result.never.push_back(std::move(translated));
  }
  bool is_whole = true;
  result.initially = translate(from.initially, to, is_whole);
  return result;
}

Situation translate(const Situation& situation, const CompiledCatalog& from,
                    const CompiledCatalog& to, const Translation& translation) {
  SituationPart part{situation.variables, {}};
  for (const Availability& entry : situation.availability) {
    part.behaviors.push_back({from.behavior_ids[entry.behavior], entry.available});
  }
  bool is_whole = true;
  part = translate(part, translation, is_whole);
  Situation result{{}, part.variables};
  for (const SituationPart::Own& own : part.behaviors) {
    result.availability.push_back({to.behaviors[own.behavior].catalog_index, own.available});
  }
  return result;
}

/// The events of a script for the other catalog, which knows all that they name.
Script translate(const Script& script, const CompiledCatalog& from, const CompiledCatalog& to,
                 const Translation& translation) {
  Script result = script;
  std::erase_if(result.steps, [](const Step& step) { return step.expect.has_value(); });
  result.situation = translate(script.situation, from, to, translation);
  for (Step& step : result.steps) {
    switch (form_of(step.verb).subject) {
      case VerbForm::SubjectKind::nothing:
        break;
      case VerbForm::SubjectKind::task:
        step.subject = to.tasks[translation.tasks[from.task_ids[step.subject]]].catalog_index;
        break;
      case VerbForm::SubjectKind::behavior:
        step.subject =
            to.behaviors[translation.behaviors[from.behavior_ids[step.subject]]].catalog_index;
        break;
      case VerbForm::SubjectKind::situation:
        step.situation = translate(step.situation, from, to, translation);
        break;
    }
  }
  return result;
}

/// Groups of both catalogs that are explored together.
struct GroupPair {
  std::vector<GroupId> old_groups;
  std::vector<GroupId> new_groups;
};

std::vector<GroupPair> join_groups(const CompiledCatalog& old_catalog,
                                   const CompiledCatalog& new_catalog, const Translation& to_old) {
  const auto count = static_cast<std::uint32_t>(new_catalog.group_count());
  const auto old_count = static_cast<std::uint32_t>(old_catalog.group_count());
  DisjointSets sets(std::size_t{count} + old_count);
  for (TaskId task(0); task < new_catalog.tasks.size(); ++task) {
    if (to_old.tasks[task] == none) continue;
    sets.join(new_catalog.tasks[task].group, count + old_catalog.tasks[to_old.tasks[task]].group);
  }
  for (BehaviorId behavior(0); behavior < new_catalog.behaviors.size(); ++behavior) {
    if (to_old.behaviors[behavior] == none) continue;
    sets.join(new_catalog.group_of(behavior),
              count + old_catalog.group_of(to_old.behaviors[behavior]));
  }
  const std::vector<std::uint32_t> numbers = sets.numbers();
  std::map<std::uint32_t, GroupPair> pairs;
  for (std::uint32_t place = 0; place < numbers.size(); ++place) {
    GroupPair& pair = pairs[numbers[place]];
    place < count ? pair.new_groups.emplace_back(place)
                  : pair.old_groups.emplace_back(place - count);
  }
  std::vector<GroupPair> result;
  result.reserve(pairs.size());
  for (auto& [number, pair] : pairs) result.push_back(std::move(pair));
  return result;
}

/// The models of both catalogs, and what is the same in them.
struct ModelPair {
  ModelPair(const CompiledCatalog& old_catalog, const CompiledCatalog& new_catalog,
            const GroupPair& groups, const Assumptions& old_assumptions,
            const Assumptions& new_assumptions, const Translation& to_old,
            const Translation& to_new)
      : old_model(old_catalog, groups.old_groups, old_assumptions),
        new_model(new_catalog, groups.new_groups, new_assumptions),
        to_new_(to_new) {
    add_moves(to_old);
    add_variables_of_old();
    for (std::uint32_t task = 0; task < old_model.tasks().size(); ++task) {
      const TaskId known = to_new.tasks[old_model.tasks()[task].id];
      tasks.emplace_back(known != none ? new_model.find_task(known) : none, task);
    }
    for (std::uint32_t task = 0; task < new_model.tasks().size(); ++task) {
      if (to_old.tasks[new_model.tasks()[task].id] == none) tasks.emplace_back(task, none);
    }
  }

  [[nodiscard]] bool is_same_task(std::uint32_t of_new, std::uint32_t of_old) const {
    return new_model.tasks()[of_new].id == to_new_.tasks[old_model.tasks()[of_old].id];
  }
  [[nodiscard]] bool is_same_behavior(std::uint32_t of_new, std::uint32_t of_old) const {
    return new_model.behaviors()[of_new].id == to_new_.behaviors[old_model.behaviors()[of_old].id];
  }
  /// A task of the new model and the same of the old one; none: one of them does not have it.
  using TaskPair = std::pair<std::uint32_t, std::uint32_t>;
  /// Their numbers among the reactive tasks; none: it is not one of them.
  [[nodiscard]] TaskPair reactive_of(const TaskPair& task) const {
    return {task.first == none ? none : new_model.tasks()[task.first].reactive,
            task.second == none ? none : old_model.tasks()[task.second].reactive};
  }

  Model old_model;
  Model new_model;
  /// The same move in both.
  struct PairedMove {
    const Model::Choice* of_new = nullptr;  ///< null: the new one does not have it
    const Model::Choice* of_old = nullptr;  ///< null: the old one does not have it
    Move move;                              ///< as the new catalog counts
  };
  std::vector<PairedMove> moves;
  std::vector<TaskPair> tasks;

 private:
  /// A move, with the id of its task, behavior or variable, and its priority or value.
  using Key = std::tuple<Move::Kind, std::uint32_t, std::int64_t>;

  /// As the catalog of the model counts, or as the other one does.
  [[nodiscard]] static Key key_of(const Model& model, const Model::Choice& choice,
                                  const Translation* to_other) {
    const Move::Kind kind = choice.move.kind;
    const auto id_of = [&](auto id, auto ids) {
      return to_other == nullptr ? id : (to_other->*ids)[id];
    };
    switch (kind) {
      case Move::Kind::due:
        return {kind, 0, 0};
      case Move::Kind::start:
      case Move::Kind::stop:
        return {kind, id_of(model.tasks()[choice.subject].id, &Translation::tasks),
                choice.move.choice};
      case Move::Kind::variable: {
        const std::uint32_t variable = model.variables()[choice.subject].id;
        return {kind, id_of(variable, &Translation::variables),
                to_other == nullptr ? choice.choice : to_other->values[variable][choice.choice]};
      }
      default:
        return {kind, id_of(model.behaviors()[choice.subject].id, &Translation::behaviors), 0};
    }
  }

  /// Adds the moves of the new model together with those of the old one.
  void add_moves(const Translation& to_old) {
    std::map<Key, const Model::Choice*> of_old;
    for (const Model::Choice& choice : old_model.moves()) {
      of_old[key_of(old_model, choice, nullptr)] = &choice;
    }
    for (const Model::Choice& choice : new_model.moves()) {
      const Key key = key_of(new_model, choice, &to_old);
      const auto found = of_old.find(key);
      const bool is_in_both = found != of_old.end();
      // The old catalog may have a variable and its value, although no behavior of its groups names
      // it.
      const bool is_known = choice.move.kind == Move::Kind::variable && std::get<1>(key) != none &&
                            std::get<2>(key) != none;
      if (is_in_both || is_known || choice.move.kind == Move::Kind::due) {
        moves.push_back({&choice, is_in_both ? found->second : nullptr, choice.move});
      }
    }
    if (new_model.reactive().empty() && !old_model.reactive().empty()) {
      moves.push_back({nullptr, &old_model.moves().back(), old_model.moves().back().move});
    }
  }

  /// Adds the changes of variables that both catalogs have and only behaviors of the old groups
  /// name.
  void add_variables_of_old() {
    for (const Model::Choice& choice : old_model.moves()) {
      if (choice.move.kind != Move::Kind::variable) continue;
      const auto [kind, variable, value] = key_of(old_model, choice, &to_new_);
      if (variable == none || value == none || new_model.find_variable(variable) != none) continue;
      moves.push_back({nullptr, &choice, {kind, variable, static_cast<std::int32_t>(value)}});
    }
    // Those of the new groups are in order, and so are moves of one kind that is no change.
    std::stable_sort(moves.begin(), moves.end(), [](const PairedMove& a, const PairedMove& b) {
      if (a.move.kind != b.move.kind) return a.move.kind < b.move.kind;
      return a.move.kind == Move::Kind::variable &&
             std::tie(a.move.subject, a.move.choice) < std::tie(b.move.subject, b.move.choice);
    });
  }

  const Translation& to_new_;
};

/// Takes pairs of states from one move to the next. A packed pair is the state of the new catalog,
/// then that of the old one.
class PairStepper {
 public:
  PairStepper(const ModelPair& models, bool reduce)
      : moves_(models.moves),
        old_(models.old_model, {.reduce = reduce}),
        new_(models.new_model, {.reduce = reduce}),
        new_words_(models.new_model.packed_words()) {
    old_.set_trace(&old_trace_);
    new_.set_trace(&new_trace_);
  }
  void load(const std::uint32_t* state) {
    new_.load(state);
    old_.load(state + new_words_);
  }
  /// Makes a move in both; one that does not know it stays as it is. False: neither state has the
  /// move, or it leads into an excluded situation.
  bool try_move(const ModelPair::PairedMove& move) {
    const bool is_new = move.of_new != nullptr && new_.has_move(*move.of_new);
    const bool is_old = move.of_old != nullptr && old_.has_move(*move.of_old);
    if (!is_new && !is_old) return false;
    old_trace_.events.clear();
    new_trace_.events.clear();
    const bool is_situation = move.move.kind == Move::Kind::variable;
    return take(new_, move.of_new, is_situation) && take(old_, move.of_old, is_situation);
  }
  [[nodiscard]] const std::vector<ModelPair::PairedMove>& choices() const { return moves_; }
  /// Writes the states after the move.
  void pack(std::uint32_t* packed) const {
    new_.pack(packed);
    old_.pack(packed + new_words_);
  }
  /// The events of the move.
  [[nodiscard]] const std::vector<MoveTrace::Happening>& old_events() const {
    return old_trace_.events;
  }
  [[nodiscard]] const std::vector<MoveTrace::Happening>& new_events() const {
    return new_trace_.events;
  }
  /// The move in the loaded states, as the new catalog counts.
  [[nodiscard]] Move move_of(const ModelPair::PairedMove& move) const {
    return move.of_new != nullptr ? new_.move_of(*move.of_new) : move.move;
  }

 private:
  static bool take(Stepper& stepper, const Model::Choice* choice, bool is_situation) {
    if (choice != nullptr) return stepper.take(*choice);
    stepper.stay(is_situation);
    return true;
  }

  const std::vector<ModelPair::PairedMove>& moves_;
  Stepper old_;
  Stepper new_;
  const std::size_t new_words_;
  MoveTrace old_trace_;
  MoveTrace new_trace_;
};

/// Looks for the first move that is decided differently.
class DifferenceVisitor {
 public:
  DifferenceVisitor(const ModelPair& models, ComparisonScope::Differences differences, bool reduce)
      : models_(models),
        differences_(differences),
        stepper_(models, reduce),
        new_cells_(models.new_model.layout().cells),
        old_cells_(models.old_model.layout().cells) {}

  [[nodiscard]] PairStepper& system() { return stepper_; }
  [[nodiscard]] bool is_done() const { return first_difference_ != UINT32_MAX; }
  void visit(Number /*number*/, Successors& /*successors*/) {}

  void on_move(Number number, const ModelPair::PairedMove& move, const std::uint32_t* successor) {
    if (is_decided_alike(successor)) return;
    first_difference_ = number;
    difference_ = stepper_.move_of(move);
  }

  /// The first state with a move that is decided differently, and that move; UINT32_MAX: none.
  [[nodiscard]] Number first_difference() const { return first_difference_; }
  [[nodiscard]] const Move& difference() const { return difference_; }

 private:
  [[nodiscard]] bool is_decided_alike(const std::uint32_t* successor) {
    models_.new_model.unpack(successor, new_cells_.data());
    models_.old_model.unpack(successor + models_.new_model.packed_words(), old_cells_.data());
    const std::vector<MoveTrace::Happening>& ours = stepper_.new_events();
    const std::vector<MoveTrace::Happening>& theirs = stepper_.old_events();
    if (differences_ == ComparisonScope::Differences::expectable) {
      return outcome_of(ours) == outcome_of(theirs) && run_alike();
    }
    return std::equal(ours.begin(), ours.end(), theirs.begin(), theirs.end(),
                      [&](const auto& a, const auto& b) { return are_alike(a, b); }) &&
           run_alike() &&
           wait_alike(part_of(models_.new_model, new_cells_, models_.new_model.layout().queue),
                      part_of(models_.old_model, old_cells_, models_.old_model.layout().queue),
                      part_of(models_.new_model, new_cells_, models_.new_model.layout().waiting),
                      part_of(models_.old_model, old_cells_, models_.old_model.layout().waiting));
  }

  /// That of the event of the script, if it is one that an expectation knows.
  [[nodiscard]] static std::optional<Outcome> outcome_of(
      const std::vector<MoveTrace::Happening>& events) {
    const bool is_known = !events.empty() && events.front().origin == Origin::script &&
                          form_of(events.front().verb).is_decided;
    return is_known ? std::optional(events.front().outcome) : std::nullopt;
  }

  [[nodiscard]] bool are_alike(const MoveTrace::Happening& ours,
                               const MoveTrace::Happening& theirs) const {
    if (ours.verb != theirs.verb || ours.origin != theirs.origin ||
        ours.outcome != theirs.outcome) {
      return false;
    }
    if (ours.verb == Verb::finish
            ? !models_.is_same_behavior(ours.subject, theirs.subject)
            : ours.verb != Verb::situation && !models_.is_same_task(ours.subject, theirs.subject)) {
      return false;
    }
    const auto is_same_change = [&](const MoveTrace::Change& a, const MoveTrace::Change& b) {
      return a.is_activation == b.is_activation && a.success == b.success &&
             models_.is_same_behavior(a.behavior, b.behavior);
    };
    const auto is_same_stop = [&](const auto& a, const auto& b) {
      return models_.is_same_task(a.first, b.first) && a.second == b.second;
    };
    return std::equal(ours.changes.begin(), ours.changes.end(), theirs.changes.begin(),
                      theirs.changes.end(), is_same_change) &&
           std::is_permutation(ours.stopped.begin(), ours.stopped.end(), theirs.stopped.begin(),
                               theirs.stopped.end(), is_same_stop) &&
           wait_alike(ours.queue, theirs.queue, ours.waiting, theirs.waiting);
  }

  /// Whether the same tasks run with the same behaviors.
  [[nodiscard]] bool run_alike() const {
    const auto behavior_in = [](const Model& model, const std::vector<std::uint16_t>& cells,
                                std::uint32_t task) {
      return task == none || cells[task] == 0
                 ? none
                 : model.behavior_of(model.tasks()[task].values.begin + cells[task] - 1U);
    };
    return std::all_of(models_.tasks.begin(), models_.tasks.end(), [&](const auto& task) {
      const std::uint32_t ours = behavior_in(models_.new_model, new_cells_, task.first);
      const std::uint32_t theirs = behavior_in(models_.old_model, old_cells_, task.second);
      return ours == none || theirs == none ? ours == theirs
                                            : models_.is_same_behavior(ours, theirs);
    });
  }

  using Part = std::span<const std::uint16_t>;
  [[nodiscard]] static Part part_of(const Model& model, const std::vector<std::uint16_t>& cells,
                                    std::uint32_t begin) {
    return Part(cells).subspan(begin, model.layout().reactive_count);
  }

  /// Whether the same reactive tasks are in the queue, in the same order, and the same ones wait.
  [[nodiscard]] bool wait_alike(Part new_queue, Part old_queue, Part new_waiting,
                                Part old_waiting) const {
    const auto entry = [](Part part, std::uint32_t reactive) {
      return reactive == none ? std::uint16_t{0} : part[reactive];
    };
    // Sets that correspond have the same order, but not always the same numbers.
    const auto rank = [](Part queue, std::uint16_t set) {
      std::set<std::uint16_t> before;
      std::copy_if(queue.begin(), queue.end(), std::inserter(before, before.end()),
                   [&](std::uint16_t other) { return other < set && other != 0; });
      return before.size();
    };
    return std::all_of(models_.tasks.begin(), models_.tasks.end(), [&](const auto& task) {
      const auto [ours, theirs] = models_.reactive_of(task);
      const std::uint16_t our_set = entry(new_queue, ours);
      const std::uint16_t their_set = entry(old_queue, theirs);
      return (entry(new_waiting, ours) != 0) == (entry(old_waiting, theirs) != 0) &&
             (our_set != 0) == (their_set != 0) &&
             (our_set == their_set || rank(new_queue, our_set) == rank(old_queue, their_set));
    });
  }

  const ModelPair& models_;
  const ComparisonScope::Differences differences_;
  PairStepper stepper_;
  std::vector<std::uint16_t> new_cells_;  ///< after the move
  std::vector<std::uint16_t> old_cells_;  ///< the same
  Number first_difference_ = UINT32_MAX;
  Move difference_;
};

/// Whether one path comes before another: the shorter one, then the first in the order of moves.
/// The paths are about different groups, so only variables can be in both.
bool comes_first(const std::vector<Move>& a, const std::vector<Move>& b) {
  if (a.size() != b.size()) return a.size() < b.size();
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                      [](const Move& one, const Move& other) {
                                        return std::tie(one.kind, one.subject, one.choice) <
                                               std::tie(other.kind, other.subject, other.choice);
                                      });
}

}  // namespace

Assumptions common_assumptions(const CompiledCatalog& old_catalog,
                               const CompiledCatalog& new_catalog) {
  const Translation to_old(new_catalog, old_catalog);
  Assumptions assumptions = default_assumptions(new_catalog);
  assumptions.start.clear();
  assumptions.stop.clear();
  for (const TaskId task : new_catalog.task_ids) {
    const TaskId other = to_old.tasks[task];
    if (other == none) continue;
    if (new_catalog.tasks[task].start_on_request == 0 &&
        old_catalog.tasks[other].start_on_request == 0) {
      continue;
    }
    assumptions.start.push_back({task, {1}});
    assumptions.stop.push_back(task);
  }
  return assumptions;
}

CatalogComparison compare_catalogs(const CompiledCatalog& old_catalog,
                                   const CompiledCatalog& new_catalog,
                                   const Assumptions& assumptions,
                                   const ExplorationOptions& options,
                                   const ComparisonScope& scope) {
  CatalogComparison result;
  const Translation to_old(new_catalog, old_catalog);
  const Translation to_new(old_catalog, new_catalog);
  list_missing(old_catalog, to_new, result.names.only_old);
  list_missing(new_catalog, to_old, result.names.only_new);
  const Assumptions old_assumptions = translate(assumptions, to_old);
  // What only the new catalog has does not move.
  const Assumptions new_assumptions = translate(old_assumptions, to_new);
  for (const GroupPair& groups : join_groups(old_catalog, new_catalog, to_old)) {
    if (options.on_progress && !options.on_progress(groups.new_groups, {})) {
      result.end = result.end.value_or(ExplorationEnd::stopped);
      break;
    }
    if (scope.group && std::find(groups.new_groups.begin(), groups.new_groups.end(),
                                 *scope.group) == groups.new_groups.end()) {
      continue;
    }
    const ModelPair models(old_catalog, new_catalog, groups, old_assumptions, new_assumptions,
                           to_old, to_new);
    result.error = models.new_model.find_obstacle();
    if (!result.error) result.error = models.old_model.find_obstacle();
    if (result.error) return result;
    std::vector<std::uint32_t> first = models.new_model.packed_first();
    const std::vector<std::uint32_t> old_first = models.old_model.packed_first();
    first.insert(first.end(), old_first.begin(), old_first.end());
    BreadthFirst search(first, options.limits, [&](const ExplorationProgress& progress) {
      return !options.on_progress || options.on_progress(groups.new_groups, progress);
    });
    std::deque<DifferenceVisitor> visitors;
    while (visitors.size() < std::max(1U, options.jobs)) {
      visitors.emplace_back(models, scope.differences, options.reduce);
    }
    search.run(visitors);
    if (!search.is_complete() && !result.end) result.end = search.end();
    result.states += search.store().size();
    result.transitions += search.transitions();
    result.depth = std::max(result.depth, search.expanded_depth());

    DifferenceVisitor& found = *std::min_element(
        visitors.begin(), visitors.end(), [](const DifferenceVisitor& a, const auto& b) {
          return a.first_difference() < b.first_difference();
        });
    if (!found.is_done()) continue;
    // There may be one before it, in a state that was not expanded.
    if (search.was_cut_short() && found.first_difference() > search.expanded()) continue;
    std::vector<Move> moves = search.moves_to(found.system(), found.first_difference());
    moves.push_back(found.difference());
    if (result.result == Verdict::Result::violated && !comes_first(moves, result.moves)) continue;
    result.result = Verdict::Result::violated;
    result.moves = std::move(moves);
    result.witness =
        make_witness(new_catalog, groups.new_groups, new_assumptions, result.moves, nullptr,
                     fmt::format("Decided differently by {} and {}: the last event.\n"
                                 "What is expected at the end is the answer of the latter.\n"
                                 "Run it with: cbc solve CATALOG FILE\n",
                                 printable(old_catalog.file), printable(new_catalog.file)));
    result.old_script = translate(result.witness->script, new_catalog, old_catalog, to_old);
  }
  if (result.result != Verdict::Result::violated && !result.end) {
    result.result = Verdict::Result::proved;
  }
  return result;
}

}  // namespace cbc
