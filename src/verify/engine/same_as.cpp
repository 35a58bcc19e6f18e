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

#include "verify/engine/same_as.h"

#include <algorithm>
#include <deque>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/compare/translation.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"
#include "verify/engine/same_as_answers.h"
#include "verify/engine/same_as_direct.h"
#include "verify/engine/same_as_pair.h"
#include "verify/engine/stepper.h"

namespace cbc {

namespace {

using Number = StateStore::Number;

/// Takes pairs of states from one move to the next. A packed pair is the state of the new catalog,
/// then that of the old one. A move that is decided differently leads back to where it came from.
class PairStepper {
 public:
  PairStepper(const ModelPair& models, const ComparisonScope& scope, bool reduce)
      : moves_(models.moves),
        old_(models.old_model, {.reduce = reduce}),
        new_(models.new_model, {.reduce = reduce}),
        new_words_(models.new_model.packed_words()),
        loaded_(new_words_ + models.old_model.packed_words()),
        answers_(models, scope.differences, scope.allow_missing) {
    old_.set_trace(&old_trace_);
    new_.set_trace(&new_trace_);
  }
  void load(const std::uint32_t* state) {
    std::copy_n(state, loaded_.size(), loaded_.begin());
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
    if (!take(new_, move.of_new) || !take(old_, move.of_old)) return false;
    answers_.compare(new_trace_, old_trace_, new_.cells_after(), old_.cells_after());
    return true;
  }
  [[nodiscard]] const std::vector<ModelPair::PairedMove>& choices() const { return moves_; }
  void pack(std::uint32_t* packed) const {
    if (!answers_.is_alike()) {
      std::copy(loaded_.begin(), loaded_.end(), packed);
      return;
    }
    new_.pack(packed);
    old_.pack(packed + new_words_);
  }
  /// What the last move did.
  [[nodiscard]] const AnswerComparison& answers() const { return answers_; }
  [[nodiscard]] AnswerComparison& answers() { return answers_; }
  /// The move in the loaded states, as the new catalog counts.
  [[nodiscard]] Move move_of(const ModelPair::PairedMove& move) const {
    return move.of_new != nullptr ? new_.move_of(*move.of_new) : move.move;
  }

 private:
  static bool take(Stepper& stepper, const Model::Choice* choice) {
    if (choice != nullptr) return stepper.take(*choice);
    stepper.stay();
    return true;
  }

  const std::vector<ModelPair::PairedMove>& moves_;
  Stepper old_;
  Stepper new_;
  const std::size_t new_words_;
  std::vector<std::uint32_t> loaded_;
  MoveTrace old_trace_;
  MoveTrace new_trace_;
  AnswerComparison answers_;
};

/// A move from a state: the number of the state, and the place of the move.
struct MoveFrom {
  Number state = UINT32_MAX;
  std::size_t move = 0;

  [[nodiscard]] bool is_none() const { return state == UINT32_MAX; }
  auto operator<=>(const MoveFrom&) const = default;
};

/// Looks for the first move that is decided differently about each task.
class DifferenceVisitor {
 public:
  DifferenceVisitor(const ModelPair& models, const ComparisonScope& scope, bool reduce)
      : is_first_enough_(scope.differences == ComparisonScope::Differences::expectable),
        stepper_(models, scope, reduce),
        found_(models.tasks.size()) {}

  [[nodiscard]] PairStepper& system() { return stepper_; }
  [[nodiscard]] bool is_done() const { return is_done_; }
  void visit(Number /*number*/, Successors& /*successors*/) {}

  void on_move(Number number, const ModelPair::PairedMove& move,
               const std::uint32_t* /*successor*/) {
    const AnswerComparison& answers = stepper_.answers();
    is_compared_ = is_compared_ || answers.is_compared();
    for (const AnswerComparison::Note& note : answers.notes()) {
      MoveFrom& first = found_[note.task];
      if (!first.is_none()) continue;
      first = {number, static_cast<std::size_t>(&move - stepper_.choices().data())};
      is_done_ = is_first_enough_;
    }
  }

  /// By task of the pair of models.
  [[nodiscard]] const std::vector<MoveFrom>& found() const { return found_; }
  [[nodiscard]] bool is_compared() const { return is_compared_; }

 private:
  const bool is_first_enough_;
  PairStepper stepper_;
  std::vector<MoveFrom> found_;
  bool is_done_ = false;
  bool is_compared_ = false;
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
    std::vector<std::uint32_t> first = models.new_model.packed_first();
    const std::vector<std::uint32_t> old_first = models.old_model.packed_first();
    first.insert(first.end(), old_first.begin(), old_first.end());
    BreadthFirst search(first, options_.limits, [&](const ExplorationProgress& progress) {
      return !options_.on_progress || options_.on_progress(groups.new_groups, progress);
    });
    std::deque<DifferenceVisitor> visitors;
    while (visitors.size() < std::max(1U, options_.jobs)) {
      visitors.emplace_back(models, scope_, options_.reduce);
    }
    search.run(visitors);
    if (!search.is_complete()) result.end = search.end();
    result.states = search.store().size();
    result.transitions = search.transitions();
    result.depth = search.expanded_depth();
    add_differences(models, search, visitors, result);
    result.result = !result.differences.empty() ? Verdict::Result::violated
                    : result.end                ? Verdict::Result::undecided
                                                : Verdict::Result::proved;
    return std::nullopt;
  }

 private:
  void add_differences(const ModelPair& models, const BreadthFirst& search,
                       std::deque<DifferenceVisitor>& visitors, GroupComparison& result) const {
    PairStepper& stepper = visitors.front().system();
    for (const DifferenceVisitor& visitor : visitors) {
      result.is_compared = result.is_compared || visitor.is_compared();
    }
    std::map<MoveFrom, std::vector<std::uint32_t>> found;  // tasks
    for (std::uint32_t task = 0; task < models.tasks.size(); ++task) {
      result.tasks.push_back(stepper.answers().name_of(task));
      MoveFrom first;
      for (const DifferenceVisitor& visitor : visitors) {
        first = std::min(first, visitor.found()[task]);
      }
      // There may be one before it, in a state that was not expanded.
      const bool is_late = search.was_cut_short() && first.state > search.expanded();
      if (!first.is_none() && !is_late) found[first].push_back(task);
    }
    const bool is_first_enough = scope_.differences == ComparisonScope::Differences::expectable;
    for (const auto& [from, tasks] : found) {
      EventDifference& difference = result.differences.emplace_back();
      difference.moves = search.moves_to(stepper, from.state);
      stepper.load(search.store().state(from.state));
      const ModelPair::PairedMove& last = models.moves[from.move];
      difference.moves.push_back(stepper.move_of(last));
      stepper.answers().set_with_lines(true);
      static_cast<void>(stepper.try_move(last));
      stepper.answers().set_with_lines(false);
      for (const std::uint32_t task : tasks) {
        difference.tasks.push_back(describe(stepper.answers(), task));
      }
      write_scripts(result.new_groups, difference);
      if (is_first_enough) return;
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
       compare_attributes(old_catalog, new_catalog, translations.to_old)) {
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
  const Assumptions old_assumptions = translate(assumptions, translations.to_old);
  // What only the new catalog has does not move.
  const Assumptions new_assumptions = translate(old_assumptions, translations.to_new);
  const bool counts_all = scope.differences == ComparisonScope::Differences::all;
  if (counts_all) {
    find_direct_differences(old_catalog, new_catalog, translations, old_assumptions, assumptions,
                            options, scope, result);
    if (result.error) return result;
  }
  const CompiledCatalog of_old = without_missing_starts(old_catalog, translations.to_new);
  const CompiledCatalog of_new = without_missing_starts(new_catalog, translations.to_old);
  GroupComparer comparer(of_old, of_new, translations, old_assumptions, new_assumptions, options,
                         scope);
  for (const GroupPair& groups : join_groups(of_old, of_new, translations.to_old)) {
    if (options.on_progress && !options.on_progress(groups.new_groups, {})) {
      result.end = result.end.value_or(ExplorationEnd::stopped);
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
  if (counts_all && !result.is_compared && result.explored == Verdict::Result::proved) {
    result.result = Verdict::Result::undecided;
  }
  if (!result.direct.empty()) result.result = Verdict::Result::violated;
  return result;
}

}  // namespace cbc
