// Differential testing of two versions (W. M. McKeeman, "Differential testing for software", 1998):
// both get the same events, and each answer of one is the test of the other. The events suit the
// state of the new version. As both are in the same state up to the first difference, they suit the
// old one as well.
//
// To draw the events apart for each version would be simpler. But then two sequences soon have
// nothing in common, and only frequencies could be compared.

#include "sweep/engine/against.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/script/runner.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"
#include "versions/runs/run_comparison.h"

namespace cbc {
namespace {

constexpr std::uint32_t no_part = UINT32_MAX;

/// Whether one was found after fewer events, or earlier.
bool comes_first(const auto& one, std::uint64_t steps, std::uint64_t sequence) {
  return std::tie(steps, sequence) < std::tie(one.steps, one.sequence);
}

}  // namespace

ComparedVersions::ComparedVersions(const CompiledCatalog& old_version,
                                   const CompiledCatalog& new_version, const Renames& renames)
    : old_catalog(old_version),
      new_catalog(new_version),
      translations(old_version, new_version, renames),
      names(names_of(old_version, new_version, translations, renames)),
      drawn(new_version, translations.to_old),
      part_of_new(new_version.group_count(), no_part),
      part_of_old(old_version.group_count(), no_part) {
  old_catalog = without_missing_starts(old_version, translations.to_new);
  new_catalog = without_missing_starts(new_version, translations.to_old);
  for (const GroupPair& pair : join_groups(old_catalog, new_catalog, translations.to_old)) {
    const auto part = static_cast<std::uint32_t>(tasks.size());
    for (const GroupId group : pair.old_groups) part_of_old[group] = part;
    for (const GroupId group : pair.new_groups) part_of_new[group] = part;
    tasks.emplace_back();
  }
  for (const TaskId task : new_catalog.task_ids) {
    const TaskId of_old = translations.to_old.tasks[task];
    if (of_old == none) continue;
    tasks[part_of_new[new_catalog.tasks[task].group]].push_back({task, of_old});
  }
}

SequenceComparison::SequenceComparison(const ComparedVersions& catalogs, CoordinatorOptions options)
    : catalogs_(catalogs), options_(std::move(options)) {}

void SequenceComparison::Found::add(const Found& other) {
  const std::uint64_t sum = sequences + other.sequences;
  if (sequences == 0 || comes_first(*this, other.steps, other.sequence)) *this = other;
  sequences = sum;
}

void SequenceComparison::Totals::add(const Totals& other) {
  events += other.events;
  sequences += other.sequences;
  for (const auto& [line, one] : other.found) found[line].add(one);
}

void SequenceComparison::begin(std::uint64_t sequence) {
  sequence_ = sequence;
  steps_ = 0;
  status_ = Coordinator::Status::ok;
  differs_ = false;
  is_over_.assign(catalogs_.tasks.size(), false);
  touched_.clear();
  run_.emplace(catalogs_.old_catalog, options_, *this);
  run_->begin({});
}

void SequenceComparison::note(const EventRecord& record, bool is_new) {
  if (record.origin == Origin::script && form_of(record.verb).is_decided) {
    (is_new ? new_outcome_ : old_outcome_) = record.outcome;
  }
  if (record.search == nullptr) return;
  const GroupId group = record.search->group;
  touched_.push_back(is_new ? catalogs_.part_of_new[group] : catalogs_.part_of_old[group]);
}

void SequenceComparison::on_time(Microseconds time, const State& new_state) {
  if (status_ != Coordinator::Status::ok) return;
  ++steps_;
  is_by_clock_ = true;
  status_ = run_->advance_to(time);
  compare_running(new_state);
  new_outcome_.reset();
  old_outcome_.reset();
}

void SequenceComparison::on_step(const Step& step, const State& new_state) {
  if (status_ != Coordinator::Status::ok) return;
  is_by_clock_ = false;
  const Step same =
      translate(step, catalogs_.new_catalog, catalogs_.old_catalog, catalogs_.translations.to_old);
  status_ = run_->handle(event_of(same));
  compare_answers(step, new_state);
  compare_running(new_state);
}

void SequenceComparison::compare_answers(const Step& step, const State& new_state) {
  const CompiledCatalog& catalog = catalogs_.new_catalog;
  const VerbForm& form = form_of(step.verb);
  if (!form.is_decided || !new_outcome_ || !old_outcome_) return;
  const bool is_task = form.subject == VerbForm::SubjectKind::task;
  const GroupId group = is_task ? catalog.tasks[catalog.task_ids[step.subject]].group
                                : catalog.group_of(catalog.behavior_ids[step.subject]);
  const std::uint32_t part = catalogs_.part_of_new[group];
  if (is_over_[part]) return;
  ++totals_.events;
  if (*new_outcome_ == *old_outcome_) return;
  const Texts& names = is_task ? catalog.task_names : catalog.behavior_names;
  add(part,
      fmt::format("{} {}: {}", form.name, printable(names[step.subject]),
                  in_place_of(name_of(*new_outcome_), name_of(*old_outcome_))),
      new_state);
  compare_part(part, new_state);
  is_over_[part] = true;
}

void SequenceComparison::compare_running(const State& new_state) {
  std::sort(touched_.begin(), touched_.end());
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  for (const std::uint32_t part : touched_) {
    if (!is_over_[part]) compare_part(part, new_state);
  }
  touched_.clear();
}

void SequenceComparison::compare_part(std::uint32_t part, const State& new_state) {
  const auto& to_new = catalogs_.translations.to_new.behaviors;
  const State& old_state = run_->state();
  bool differs = false;
  for (const ComparedVersions::Task& task : catalogs_.tasks[part]) {
    const BehaviorId ours = new_state.behavior(task.of_new);
    const BehaviorId theirs = old_state.behavior(task.of_old);
    if (theirs == none ? ours == none : to_new[theirs] == ours && ours != none) continue;
    const CompiledCatalog& now = catalogs_.new_catalog;
    const CompiledCatalog& before = catalogs_.old_catalog;
    add(part,
        task_in_place_of(now.name_of_task(task.of_new),
                         ours != none ? now.name_of_behavior(ours) : "",
                         theirs != none ? before.name_of_behavior(theirs) : ""),
        new_state);
    differs = true;
  }
  if (differs) is_over_[part] = true;
}

void SequenceComparison::add(std::uint32_t part, const std::string& line, const State& new_state) {
  if (!std::exchange(differs_, true)) ++totals_.sequences;
  Found& found = totals_.found[line];
  if (found.sequences == 0 || comes_first(found, steps_, sequence_)) {
    found.sequence = sequence_;
    found.steps = steps_;
    found.is_by_clock = is_by_clock_;
    found.expectation = expectation_of(part, new_state);
  }
  ++found.sequences;
}

Expectation SequenceComparison::expectation_of(std::uint32_t part, const State& new_state) const {
  const CompiledCatalog& catalog = catalogs_.new_catalog;
  Expectation expectation;
  if (!is_by_clock_) expectation.outcome = new_outcome_;
  for (const ComparedVersions::Task& task : catalogs_.tasks[part]) {
    const std::uint32_t place = catalog.tasks[task.of_new].catalog_index;
    if (!new_state.is_running(task.of_new)) {
      expectation.stopped.push_back(place);
      continue;
    }
    const BehaviorId behavior = new_state.behavior(task.of_new);
    expectation.running.push_back({place, {catalog.behaviors[behavior].catalog_index}});
  }
  return expectation;
}

}  // namespace cbc
