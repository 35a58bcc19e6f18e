// Whether two catalogs decide alike: no reachable state of their product has a move with two
// answers (equivalence of sequential machines: O. Coudert, C. Berthet and J. C. Madre,
// "Verification of synchronous sequential machines based on symbolic execution", 1989). Where two
// answers differ, all that follows would differ as well, so nothing behind such a move is visited,
// and each difference that is found is one by itself.
//
// To merge pairs whose states are known to be alike (J. E. Hopcroft and R. M. Karp, "A linear
// algorithm for testing equivalence of finite automata", 1971) would spare nothing: two catalogs
// that are alike have about as many pairs as states. And comparing the answers of each decision,
// whether it can come or not, would find differences that no event shows.

#include "versions/lockstep/same_as.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/support/wording.h"
#include "explore/moves/stepper.h"
#include "explore/space/first_states.h"
#include "explore/space/state_space.h"
#include "runtime/base/text.h"
#include "versions/lockstep/pair_system.h"
#include "versions/lockstep/paired_bits.h"
#include "versions/lockstep/same_as_answers.h"
#include "versions/lockstep/same_as_direct.h"
#include "versions/lockstep/same_as_pair.h"
#include "versions/names/translation.h"

namespace cbc {

namespace {

/// Looks in a part of the pairs for the first moves that are decided differently about each task.
class DifferenceVisitor {
 public:
  using States = StatePart::States;

  DifferenceVisitor(const PairSystem& system, StatePart& part, std::size_t tasks)
      : system_(system), found_(tasks, FirstStates(part)) {}

  void visit(const States& /*states*/, std::uint32_t depth) { depth_ = depth; }
  void on_refusal(std::uint32_t /*action*/, const States& /*states*/) const {}
  void on_result(std::uint32_t /*action*/, const States& /*states*/,
                 const Controls::NumberedResult& /*result*/) const {}
  void on_note(std::uint32_t note, const States& states) {
    for (const std::uint32_t task : system_.tasks_of(note)) found_[task].add(states, depth_);
    has_found_ = true;
  }

  /// By task: the first states with such a move.
  [[nodiscard]] const std::vector<FirstStates>& found() const { return found_; }
  [[nodiscard]] bool has_found() const { return has_found_; }

 private:
  const PairSystem& system_;
  std::vector<FirstStates> found_;
  std::uint32_t depth_ = 0;
  bool has_found_ = false;
};

/// The first move that is decided differently about some tasks, and the path to it.
struct Divergence {
  StateSpace::Path path;  ///< with the move, but its end is in the state before
  std::vector<std::uint32_t> tasks;
};
/// By the places of the moves, the shortest first.
using Divergences = std::map<std::pair<std::size_t, std::vector<std::size_t>>, Divergence>;

/// Of the first shortest path to a state with such a move, the first such move. `system`: of the
/// first part.
void add_divergence(std::uint32_t task, const std::vector<DifferenceVisitor>& visitors,
                    const PairSystem& system, StateSpace& space, Divergences& divergences) {
  std::vector<const FirstStates*> found;
  found.reserve(visitors.size());
  for (const DifferenceVisitor& visitor : visitors) found.push_back(&visitor.found()[task]);
  // There may be one before it, in a state that was not expanded.
  if (!space.is_expanded(StateSpace::least_depth(found))) return;
  StateSpace::Path path = space.path_to(found);
  const auto& moves = system.moves();
  const auto differs = [&](const ControlSystem::StateMove& move) {
    const auto result = path.end.try_move(static_cast<std::size_t>(&move - moves.data()));
    if (!result) return false;
    const auto& tasks = system.tasks_of(result->note);
    return std::binary_search(tasks.begin(), tasks.end(), task);
  };
  const auto last = std::find_if(moves.begin(), moves.end(), differs);
  path.moves.push_back(last->move);
  path.places.push_back(static_cast<std::size_t>(last - moves.begin()));
  const std::pair order(path.places.size(), path.places);
  divergences.try_emplace(order, Divergence{std::move(path), {}})
      .first->second.tasks.push_back(task);
}

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

/// Compares two catalogs group by group.
class GroupComparer {
 public:
  GroupComparer(const CompiledCatalog& old_catalog, const CompiledCatalog& new_catalog,
                const TranslationPair& translations, const Assumptions& old_assumptions,
                const Assumptions& new_assumptions, const ExplorationOptions& options,
                const ComparisonScope& scope)
      : old_catalog_(old_catalog),
        new_catalog_(new_catalog),
        translations_(translations),
        old_assumptions_(old_assumptions),
        new_assumptions_(new_assumptions),
        options_(options),
        scope_(scope) {}

  /// Returns why nothing can be explored, or nothing.
  std::optional<std::string> compare(const GroupPair& groups, GroupComparison& result) {
    result.old_groups = groups.old_groups;
    result.new_groups = groups.new_groups;
    const ModelPair models(old_catalog_, new_catalog_, groups, old_assumptions_, new_assumptions_,
                           translations_);
    std::optional<std::string> obstacle = models.new_model.find_obstacle();
    if (!obstacle) obstacle = models.old_model.find_obstacle();
    if (obstacle) return obstacle;
    const PairedBits bits(models);
    Budget budget = options_.budget;
    Stepper::Options of_stepper = share_memory(options_, budget);
    const std::size_t jobs = std::max(1U, options_.jobs);
    of_stepper.decision_bytes /= 2 * jobs;
    StateSpace::Systems systems;
    const auto of_parts = add_systems<PairSystem>(jobs, systems, models, bits, scope_, of_stepper);
    StateSpace space(std::move(systems), budget, name_groups(groups.new_groups));
    std::vector<DifferenceVisitor> visitors;
    for (std::size_t place = 0; place < jobs; ++place) {
      visitors.emplace_back(*of_parts[place], *space.parts()[place], models.tasks.size());
    }
    space.run(visitors, [&] {
      return scope_.only_first && std::any_of(visitors.begin(), visitors.end(),
                                              [](const auto& one) { return one.has_found(); });
    });
    if (!space.is_complete() && !space.is_decided()) result.end = space.end();
    result.states = space.states();
    result.transitions = space.transitions();
    result.depth = space.expanded_depth();
    for (const PairSystem* const system : of_parts) {
      result.is_compared = result.is_compared || system->is_compared();
    }
    Divergences divergences;
    for (std::uint32_t task = 0; task < models.tasks.size(); ++task) {
      result.tasks.push_back(of_parts.front()->answers().name_of(task));
      add_divergence(task, visitors, *of_parts.front(), space, divergences);
    }
    add_differences(divergences, *of_parts.front(), result);
    result.result = !result.differences.empty() ? Verdict::Result::violated
                    : result.end                ? Verdict::Result::undecided
                                                : Verdict::Result::proved;
    return std::nullopt;
  }

 private:
  void add_differences(Divergences& divergences, PairSystem& system,
                       GroupComparison& result) const {
    for (auto& [order, divergence] : divergences) {
      EventDifference& difference = result.differences.emplace_back();
      StateSpace::Path& path = divergence.path;
      difference.moves = path.moves;
      path.end.load();
      system.describe(system.moves()[path.places.back()], path.end.environment());
      for (const std::uint32_t task : divergence.tasks) {
        difference.tasks.push_back(describe(system.answers(), task));
      }
      write_scripts(result.new_groups, difference);
      if (scope_.only_first) return;
    }
  }

  /// What matters most about a task.
  static TaskDifference describe(const AnswerComparison& answers, std::uint32_t task) {
    const AnswerComparison::Note* most = nullptr;
    for (const AnswerComparison::Note& note : answers.notes()) {
      if (note.task == task && (most == nullptr || note.aspect < most->aspect)) most = &note;
    }
    return {most->aspect, answers.name_of(task), most->line};
  }

  void write_scripts(const std::vector<GroupId>& groups, EventDifference& difference) const {
    Witness& witness = difference.witness;
    witness = make_witness(new_catalog_, groups, new_assumptions_, difference.moves, nullptr, {});
    leave_out_missing(new_catalog_, translations_.to_old, *witness.script.steps.back().expect);
    const std::string comment = fmt::format(
        "Decided differently by {} and {}: the last event.\n{}\n"
        "What is expected at the end is the answer of the latter, in names that both "
        "have.\nRun it with: cbc solve CATALOG FILE\n",
        printable(old_catalog_.file), printable(new_catalog_.file),
        join(difference.tasks, "\n", [](const auto& task) { return task.line; }));
    witness.text = write_script(new_catalog_, witness.script, comment, witness.comments);
    Script& old_script = difference.old_script;
    old_script = translate(witness.script, new_catalog_, old_catalog_, translations_.to_old);
    std::string old_text = write_script(old_catalog_, old_script, comment, witness.comments);
    if (old_text != witness.text) difference.old_text = std::move(old_text);
    std::erase_if(old_script.steps, [](const Step& step) { return step.expect.has_value(); });
  }

  const CompiledCatalog& old_catalog_;
  const CompiledCatalog& new_catalog_;
  const TranslationPair& translations_;
  const Assumptions& old_assumptions_;
  const Assumptions& new_assumptions_;
  const ExplorationOptions& options_;
  const ComparisonScope& scope_;
};

/// What the old catalog may do by itself: `assumptions` in its numbers, and by default what the
/// other one does not have.
Assumptions with_missing(Assumptions assumptions, const CompiledCatalog& catalog,
                         const Translation& to_other) {
  const Assumptions by_default = default_assumptions(catalog);
  for (const Assumptions::Start& start : by_default.start) {
    if (to_other.tasks[start.task] == none) assumptions.start.push_back(start);
  }
  for (const TaskId task : by_default.stop) {
    if (to_other.tasks[task] == none) assumptions.stop.push_back(task);
  }
  for (const std::uint32_t variable : by_default.variables) {
    if (to_other.variables[variable] == none) assumptions.variables.push_back(variable);
  }
  return assumptions;
}

void find_direct_differences(const CompiledCatalog& old_catalog, const CompiledCatalog& new_catalog,
                             const TranslationPair& translations,
                             const Assumptions& old_assumptions, const Assumptions& assumptions,
                             const ExplorationOptions& options, const ComparisonScope& scope,
                             CatalogComparison& result) {
  const auto take = [&](MissingNames missing) {
    if (!result.end) result.end = missing.end;
    if (!result.error) result.error = std::move(missing.error);
    std::move(missing.differences.begin(), missing.differences.end(),
              std::back_inserter(result.direct));
  };
  if (!scope.allow_missing) {
    take(find_missing(old_catalog, translations.to_new,
                      scope.is_by_default
                          ? default_assumptions(old_catalog)
                          : with_missing(old_assumptions, old_catalog, translations.to_new),
                      options));
    take(find_missing(new_catalog, translations.to_old,
                      scope.is_by_default ? default_assumptions(new_catalog) : assumptions,
                      options));
  }
  for (DirectDifference& difference :
       compare_attributes(old_catalog, new_catalog, translations.to_old, scope.renames)) {
    result.direct.push_back(std::move(difference));
  }
}

}  // namespace

const EventDifference* CatalogComparison::first_difference() const {
  const EventDifference* first = nullptr;
  for (const GroupComparison& group : groups) {
    if (group.differences.empty()) continue;
    const EventDifference& candidate = group.differences.front();
    if (first == nullptr || comes_first(candidate.moves, first->moves)) first = &candidate;
  }
  return first;
}

Assumptions common_assumptions(const CompiledCatalog& old_catalog,
                               const CompiledCatalog& new_catalog, const Renames& renames) {
  const TranslationPair translations(old_catalog, new_catalog, renames);
  Assumptions assumptions = default_assumptions(new_catalog);
  assumptions.start.clear();
  assumptions.stop.clear();
  for (const TaskId task : new_catalog.task_ids) {
    const TaskId other = translations.to_old.tasks[task];
    if (other == none) continue;
    if (new_catalog.tasks[task].start_on_request == 0 &&
        old_catalog.tasks[other].start_on_request == 0) {
      continue;
    }
    if (new_catalog.rules_of(task).requestable == 0) continue;
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
  const TranslationPair translations(old_catalog, new_catalog, scope.renames);
  result.names = names_of(old_catalog, new_catalog, translations, scope.renames);
  Assumptions old_assumptions = translate(assumptions, translations.to_old);
  std::erase_if(old_assumptions.start, [&old_catalog](const Assumptions::Start& start) {
    return old_catalog.rules_of(start.task).requestable == 0;
  });
  // What only the new catalog has does not move.
  const Assumptions new_assumptions = translate(old_assumptions, translations.to_new);
  if (!scope.only_first) {
    find_direct_differences(old_catalog, new_catalog, translations, old_assumptions, assumptions,
                            options, scope, result);
    if (result.error) return result;
  }
  const CompiledCatalog of_old = without_missing_starts(old_catalog, translations.to_new);
  const CompiledCatalog of_new = without_missing_starts(new_catalog, translations.to_old);
  GroupComparer comparer(of_old, of_new, translations, old_assumptions, new_assumptions, options,
                         scope);
  for (const GroupPair& groups : join_groups(of_old, of_new, translations.to_old)) {
    if (const auto end = options.budget.find_end()) {
      result.end = result.end.value_or(*end);
      break;
    }
    if (scope.group && std::find(groups.new_groups.begin(), groups.new_groups.end(),
                                 *scope.group) == groups.new_groups.end()) {
      continue;
    }
    GroupComparison& compared = result.groups.emplace_back();
    result.error = comparer.compare(groups, compared);
    if (result.error) return result;
    if (!result.end) result.end = compared.end;
    result.is_compared = result.is_compared || compared.is_compared;
    result.states += compared.states;
    result.transitions += compared.transitions;
    result.depth = std::max(result.depth, compared.depth);
  }
  result.explored = result.first_difference() != nullptr ? Verdict::Result::violated
                    : result.end                         ? Verdict::Result::undecided
                                                         : Verdict::Result::proved;
  result.result = result.explored;
  if (!scope.only_first && !result.is_compared && result.explored == Verdict::Result::proved) {
    result.result = Verdict::Result::undecided;
  }
  if (!result.direct.empty()) result.result = Verdict::Result::violated;
  return result;
}

}  // namespace cbc
