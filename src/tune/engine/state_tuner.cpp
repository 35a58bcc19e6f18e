// The decisions of all reachable states are those that an exploration asks for, and as long as all
// of them stay, so do the states. But an exploration asks about whole sets of environments at once,
// so a question may change whose new answer no environment allows. So where a question changes, the
// catalogs are compared event by event, as `cbc verify --same-as` does: if all is alike, the search
// goes on from there with the questions of the changed catalog. If not, the comparison has a
// shortest script to the first event that differs.

#include "tune/engine/state_tuner.h"

#include <algorithm>
#include <mutex>
#include <set>
#include <utility>

#include "core/compile/compile.h"
#include "explore/properties/verification.h"
#include "tune/engine/decision_range.h"

namespace cbc {
namespace {

/// The answers to all properties, or the limit that ended the search for one.
struct Answers {
  std::vector<Verdict::Result> results;  ///< by property
  std::optional<Budget::End> end;
};

Answers find_answers(const CompiledCatalog& catalog, const PropertyFile& file,
                     const ExplorationOptions& options) {
  Answers answers;
  if (file.properties.empty()) return answers;
  const Verification verification = verify_properties(catalog, file, options);
  for (const PropertyAnswer& answer : verification.answers) {
    answers.results.push_back(answer.verdict.result);
  }
  for (const Exploration& exploration : verification.explorations) {
    if (exploration.end) answers.end = exploration.end;
  }
  return answers;
}

ExplorationOptions of_one_thread(ExplorationOptions options) {
  options.budget.max_memory /= std::max(1U, std::exchange(options.jobs, 1));
  options.budget.tell = {};
  return options;
}

}  // namespace

StateTuner::StateTuner(const Catalog& catalog, const std::vector<TunableNumber>& numbers,
                       const PropertyFile& file, const ExplorationOptions& options)
    : catalog_(catalog),
      compiled_(compile(catalog)),
      numbers_(numbers),
      file_(file),
      options_(of_one_thread(options)) {
  std::vector<GroupId> groups;
  for (std::uint32_t group = 0; group < compiled_.group_count(); ++group)
    groups.emplace_back(group);
  present_ = survey(compiled_, groups, options);
  if (present_.end || present_.error) return;
  Answers answers = find_answers(compiled_, file, options);
  results_ = std::move(answers.results);
  present_.end = answers.end;
}

StateTuner::StateTolerance StateTuner::tolerance(std::size_t number) const {
  StateTolerance found;
  find_end(number, false, found);
  if (!found.end) find_end(number, true, found);
  return found;
}

bool StateTuner::is_used(std::size_t number) const {
  return std::any_of(present_.decisions.begin(), present_.decisions.end(),
                     [&](const SolvedProblem& decision) {
                       return uses(compiled_, decision.problem, numbers_[number]);
                     });
}

/// Decisions of other groups do not depend on the number.
std::vector<GroupId> StateTuner::groups_of(const TunableNumber& number) const {
  std::set<GroupId> groups;
  for (const TunableNumber::Use& use : number.uses) {
    groups.insert(compiled_.tasks[compiled_.task_ids[use.task]].group);
  }
  return {groups.begin(), groups.end()};
}

StateSurvey StateTuner::survey(const CompiledCatalog& catalog, const std::vector<GroupId>& groups,
                               const ExplorationOptions& options) const {
  StateSurvey survey;
  SolvedProblems decisions;
  std::mutex mutex;
  ExplorationOptions listening = options;
  listening.on_decision = [&](const Problem& problem, const Assignment* answer) {
    const std::lock_guard lock(mutex);
    decisions.add(problem, answer);
  };
  for (const GroupId group : groups) {
    const Exploration exploration = explore(catalog, {group}, file_.assumptions, {}, listening);
    survey.states += exploration.states;
    survey.transitions += exploration.transitions;
    survey.end = exploration.end;
    survey.error = exploration.error;
    if (survey.end || survey.error) break;
  }
  survey.decisions = decisions.take();
  return survey;
}

CatalogComparison StateTuner::compare(const CompiledCatalog& changed,
                                      const std::vector<GroupId>& groups) const {
  ComparisonScope scope;
  scope.only_first = true;
  if (groups.size() == 1) scope.group = groups.front();
  return compare_catalogs(changed, compiled_, file_.assumptions, options_, scope);
}

/// The event in both catalogs, as the script of the comparison shows it.
RunDifference StateTuner::describe(const EventDifference& difference,
                                   const CompiledCatalog& changed) const {
  const Missions missions{&difference.witness.script};
  const Recording before = record(compiled_, missions, Until::end);
  const Recording now = record(changed, missions, Until::end);
  RunDifference result;
  if (const auto found = find_difference(before, now)) {
    result = *found;
    result.failure.reset();  // what the script expects is that there is no difference
  } else {
    result.before = before.events.front().back().record;
    result.now = now.events.front().back().record;
  }
  result.in_state.emplace(RunDifference::InState{difference.witness, {}});
  return result;
}

/// The first property that a change breaks.
void StateTuner::find_broken(const CompiledCatalog& changed, RunDifference& difference,
                             std::optional<Budget::End>& end) const {
  const Answers answers = find_answers(changed, file_, options_);
  end = answers.end;
  for (std::size_t place = 0; place < results_.size(); ++place) {
    if (results_[place] != Verdict::Result::proved) continue;
    if (answers.results[place] != Verdict::Result::violated) continue;
    difference.in_state->broken_property = place;
    return;
  }
}

void StateTuner::find_end(std::size_t number, bool upwards, StateTolerance& found) const {
  const TunableNumber& changed = numbers_[number];
  const std::vector<GroupId> groups = groups_of(changed);
  Millionths& end = upwards ? found.tolerance.values.high : found.tolerance.values.low;
  std::optional<RunDifference>& beyond = upwards ? found.tolerance.above : found.tolerance.below;
  Catalog catalog = catalog_;
  CompiledCatalog compiled = compiled_;
  StateSurvey further;
  const StateSurvey* known = &present_;
  Millionths value = changed.value;
  while (true) {
    // Requests of equal priority that minimum performances tie together are explored in each order;
    // the first minimum may tie more of them.
    const bool is_first_minimum =
        upwards && value == 0 && changed.kind == TunableNumber::Kind::minimum_performance;
    end = is_first_minimum
              ? 0
              : last_unchanged(catalog, changed, value, compiled, known->decisions, upwards);
    if (end == (upwards ? one_million : 0)) return;
    value = upwards ? end + 1 : end - 1;
    set_number(catalog, changed, value);
    compiled = compile(catalog);
    const CatalogComparison comparison = compare(compiled, groups);
    if (const EventDifference* const first = comparison.first_difference()) {
      beyond = describe(*first, compiled);
      return find_broken(compiled, *beyond, found.end);
    }
    further = survey(compiled, groups, options_);
    found.end = comparison.end ? comparison.end : further.end;
    if (found.end) return;
    known = &further;
  }
}

}  // namespace cbc
