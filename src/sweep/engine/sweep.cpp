// Monte Carlo simulation: what happens how often is estimated by random event sequences, each on a
// coordinator of its own. Sequence n draws from random stream n (SplitMix64: G. L. Steele, D. Lea
// and C. H. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014), whoever runs it,
// and everything that is kept is a sum or an earliest maximum. So threads and machines may share
// the sequences in any way, and the result, apart from times, is the same. Of the slowest event
// only its number is kept: its sequence is drawn again in the end, and becomes a script.
//
// One stream for all sequences would be simpler, but then their events would depend on who comes
// first. And events are drawn to suit the state: of others, most would be rejected or change
// nothing. What a sweep has not seen may still be possible: that is for `cbc verify`.

#include "sweep/engine/sweep.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cbc/version.h"
#include "core/script/script.h"
#include "core/support/system.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_file.h"
#include "sweep/engine/sequence.h"

namespace cbc {
namespace {

/// Whether an event is slower than another one. Among equal costs the earliest event wins, so that
/// the result does not depend on the order of threads.
bool is_slower(const auto& one, const auto& other) {
  return one.cost != other.cost
             ? one.cost > other.cost
             : std::tie(one.sequence, one.event) < std::tie(other.sequence, other.event);
}

void keep_slower(auto& slowest, auto other) {
  if (other && (!slowest || is_slower(*other, *slowest))) slowest = std::move(other);
}

using Clock = std::chrono::steady_clock;

/// A candidate for the slowest event.
struct Candidate {
  std::uint64_t cost = 0;
  std::uint64_t sequence = 0;  ///< from 0
  std::uint64_t event = 0;
  Verb verb = Verb::wait;
  std::uint32_t subject = 0;  ///< place in the catalog; none of reconsider
};

/// Sums, which do not depend on the order of the parts.
struct Totals {
  SweepCounts counts;
  Histogram nodes;
  Histogram times;  ///< nanoseconds
  std::optional<Candidate> most_nodes;
  std::optional<Candidate> most_time;

  void add(const Totals& other) {
    counts.add(other.counts);
    nodes.add(other.nodes);
    times.add(other.times);
    keep_slower(most_nodes, other.most_nodes);
    keep_slower(most_time, other.most_time);
  }
};

/// Counts the events of one thread.
class Tally final : public SequenceListener {
 public:
  Tally(const CompiledCatalog& catalog, const ComparedVersions* compared,
        const SweepSettings& settings)
      : catalog_(catalog), was_running_(catalog.tasks.size()) {
    if (compared != nullptr) {
      comparison_ =
          std::make_unique<SequenceComparison>(*compared, coordinator_options(settings.search));
    }
    totals_.counts = SweepCounts(catalog.tasks.size(), catalog.behaviors.size());
  }

  [[nodiscard]] const Totals& totals() const { return totals_; }
  /// Null if there is none.
  [[nodiscard]] const SequenceComparison* comparison() const { return comparison_.get(); }

  void begin(std::uint64_t sequence) {
    sequence_ = sequence;
    if (comparison_ != nullptr) comparison_->begin(sequence);
    std::fill(was_running_.begin(), was_running_.end(), std::uint8_t{0});
    event_began_ = Clock::now();
  }

  void on_time(Microseconds time, const State& state) override {
    if (comparison_ == nullptr) return;
    comparison_->on_time(time, state);
    event_began_ = Clock::now();
  }
  void on_step(const Step& step, const State& state) override {
    if (comparison_ == nullptr) return;
    comparison_->on_step(step, state);
    event_began_ = Clock::now();
  }
  void on_event(const ExplainedRecord& record, const State& state) override {
    if (comparison_ != nullptr) comparison_->on_new_event(record);
    if (record.search != nullptr) add_costs(record, Clock::now() - event_began_);
    totals_.counts.add(catalog_, record);
    if (record.outcome == Outcome::accepted && record.search != nullptr) {
      count_runs(record.search->group, state);
    }
    event_began_ = Clock::now();
  }

 private:
  void add_costs(const EventRecord& record, std::chrono::nanoseconds time) {
    Candidate candidate;
    candidate.sequence = sequence_;
    candidate.event = record.index;
    candidate.verb = record.verb;
    candidate.subject = record.task != none ? catalog_.tasks[record.task].catalog_index
                        : record.behavior != none
                            ? catalog_.behaviors[record.behavior].catalog_index
                            : none;
    candidate.cost = record.search->result.nodes;
    totals_.nodes.add(candidate.cost);
    keep_slower(totals_.most_nodes, std::optional(candidate));
    candidate.cost = static_cast<std::uint64_t>(time.count());
    totals_.times.add(candidate.cost);
    keep_slower(totals_.most_time, std::optional(candidate));
  }

  void count_runs(GroupId group, const State& state) {
    for (TaskId task = catalog_.group_tasks[group]; task < catalog_.group_tasks[group + 1];
         ++task) {
      const bool is_running = state.is_running(task);
      if (is_running && was_running_[task] == 0) {
        ++totals_.counts.tasks[catalog_.tasks[task].catalog_index].runs;
      }
      was_running_[task] = is_running ? 1 : 0;
    }
  }

  const CompiledCatalog& catalog_;
  std::unique_ptr<SequenceComparison> comparison_;
  Totals totals_;
  std::vector<std::uint8_t> was_running_;  ///< by task
  std::uint64_t sequence_ = 0;
  Clock::time_point event_began_;
};

/// What is swept.
struct Swept {
  const CompiledCatalog& catalog;
  const DrawnNames& names;
  const SweepSettings& settings;

  [[nodiscard]] std::vector<Step> steps_of(std::uint64_t sequence, std::uint64_t index) const {
    return steps_of_sequence(catalog, names, settings, sequence, index);
  }
  [[nodiscard]] std::string script_of(std::vector<Step> steps, const std::string& comment) const {
    Script script;
    script.steps = std::move(steps);
    return write_script(catalog, script,
                        fmt::format("{}Run it with: cbc solve CATALOG FILE{}\n", comment,
                                    options_for_script(settings.search)));
  }
};

/// Runs a sequence, on both catalogs if there are two.
SequenceEnd run(const Swept& swept, std::uint64_t sequence, Tally& tally) {
  tally.begin(sequence);
  SequenceEnd end = run_sequence(swept.catalog, swept.names, swept.settings, sequence, tally);
  const SequenceComparison* const comparison = tally.comparison();
  if (comparison != nullptr && end.status == Coordinator::Status::ok) {
    end = {comparison->status(), comparison->internal_error()};
  }
  return end;
}

/// What the threads share.
class Work {
 public:
  explicit Work(const Swept& swept)
      : swept_(swept),
        first_(swept.settings.first),
        end_(first_ + swept.settings.sequences),
        next_(first_),
        failed_(end_) {}

  /// Runs sequences until there are no more.
  void do_share(Tally& tally, const std::function<void(std::uint64_t)>& progress) {
    for (;;) {
      const std::uint64_t sequence = next_.fetch_add(1);
      // Sequences before the first failure still run, so that it is the first one with any number
      // of threads.
      if (sequence >= failed_.load()) return;
      if (run(swept_, sequence, tally).status != Coordinator::Status::ok) note_failure(sequence);
      if (progress) progress(std::min(next_.load(), end_) - first_);
    }
  }

  [[nodiscard]] std::optional<std::uint64_t> failed() const {
    return failed_.load() < end_ ? std::optional(failed_.load()) : std::nullopt;
  }

 private:
  void note_failure(std::uint64_t sequence) {
    std::uint64_t first = failed_.load();
    while (sequence < first && !failed_.compare_exchange_weak(first, sequence)) {
    }
  }

  const Swept swept_;
  const std::uint64_t first_;
  const std::uint64_t end_;
  std::atomic<std::uint64_t> next_;
  std::atomic<std::uint64_t> failed_;  ///< the first sequence that failed, or the end
};

std::string describe(const CompiledCatalog& catalog, const Candidate& candidate) {
  if (candidate.subject == none) return std::string(name_of(candidate.verb));
  const bool is_task = form_of(candidate.verb).subject == VerbForm::SubjectKind::task;
  const Texts& names = is_task ? catalog.task_names : catalog.behavior_names;
  return fmt::format("{} {}", name_of(candidate.verb), printable(names[candidate.subject]));
}

std::optional<SlowestEvent> to_slowest(const Swept& swept,
                                       const std::optional<Candidate>& candidate,
                                       std::string_view measure) {
  if (!candidate) return std::nullopt;
  SlowestEvent slowest;
  slowest.sequence = candidate->sequence + 1;
  slowest.event = candidate->event;
  slowest.cost = candidate->cost;
  slowest.what = describe(swept.catalog, *candidate);
  const std::string comment = fmt::format(
      "Sequence {} of a sweep with seed {}, up to its slowest event by {}:\n"
      "event {}, {}.\n",
      slowest.sequence, swept.settings.seed, measure, slowest.event, slowest.what);
  slowest.script = swept.script_of(swept.steps_of(candidate->sequence, candidate->event), comment);
  return slowest;
}

SweptComparison to_comparison(const Swept& swept, const ComparedVersions& compared,
                              const SequenceComparison::Totals& totals) {
  SweptComparison result;
  result.old_catalog = compared.old_catalog.file;
  result.names = compared.names;
  result.events = totals.events;
  result.sequences = totals.sequences;
  for (const auto& [line, found] : totals.found) {
    std::vector<Step> steps = swept.steps_of(found.sequence, 0);
    steps.resize(static_cast<std::size_t>(found.steps));
    if (found.is_by_clock) {
      Step wait;
      wait.time = steps.back().time;
      steps.back() = wait;
    }
    Step end;
    end.time = steps.back().time;
    end.expect = found.expectation;
    steps.push_back(std::move(end));
    const std::string comment = fmt::format(
        "Sequence {} of a sweep with seed {}, up to where {} and {} differ:\n"
        "{}\n"
        "What is expected at the end is the answer of the former.\n",
        found.sequence + 1, swept.settings.seed, printable(swept.catalog.file),
        printable(compared.old_catalog.file), line);
    result.differences.push_back({line, found.sequences, found.sequence + 1, found.steps,
                                  swept.script_of(std::move(steps), comment)});
  }
  std::sort(result.differences.begin(), result.differences.end(),
            [](const SweptDifference& a, const SweptDifference& b) {
              return a.sequences != b.sequences ? a.sequences > b.sequences : a.line < b.line;
            });
  return result;
}

SweepFailure to_failure(const Swept& swept, std::uint64_t sequence, Tally& tally) {
  const SequenceEnd end = run(swept, sequence, tally);
  const std::string comment =
      fmt::format("Sequence {} of a sweep with seed {}.\n", sequence + 1, swept.settings.seed);
  return {sequence + 1, end.status, end.internal_error,
          swept.script_of(swept.steps_of(sequence, 0), comment)};
}

std::vector<std::string> to_strings(const Texts& names) {
  std::vector<std::string> texts;
  for (const std::string_view name : names) texts.emplace_back(name);
  return texts;
}

}  // namespace

SweepOutcome sweep(const CompiledCatalog& catalog, const SweepSettings& settings, std::size_t jobs,
                   const std::function<void(std::uint64_t)>& progress,
                   const std::optional<OldVersion>& old_version) {
  const Clock::time_point begin = Clock::now();
  const auto threads = std::clamp<std::uint64_t>(settings.sequences, 1, jobs);
  std::optional<ComparedVersions> compared;
  if (old_version) compared.emplace(old_version->catalog, catalog, old_version->renames);
  const DrawnNames all_names(catalog);
  const Swept swept{compared ? compared->new_catalog : catalog,
                    compared ? compared->drawn : all_names, settings};
  std::vector<Tally> tallies;
  for (std::size_t place = 0; place < threads; ++place) {
    tallies.emplace_back(swept.catalog, compared ? &*compared : nullptr, settings);
  }
  Work work(swept);
  run_in_threads(tallies.size(), [&](std::size_t place) {
    work.do_share(tallies[place], place == 0 ? progress : nullptr);
  });

  SweepOutcome outcome;
  if (const auto failed = work.failed()) {
    outcome.failure = to_failure(swept, *failed, tallies.front());
    return outcome;
  }
  Totals all = tallies.front().totals();
  for (std::size_t place = 1; place < tallies.size(); ++place) all.add(tallies[place].totals());
  SweepResult& result = outcome.result;
  result.catalog = catalog.file;
  result.digest = to_hex(identity_of(catalog));
  result.version = version;
  result.settings = settings;
  result.task_names = to_strings(catalog.task_names);
  result.behavior_names = to_strings(catalog.behavior_names);
  result.counts = std::move(all.counts);
  result.nodes = std::move(all.nodes);
  result.slowest = to_slowest(swept, all.most_nodes, "nodes");
  if (compared) {
    SequenceComparison::Totals found;
    for (const Tally& tally : tallies) found.add(tally.comparison()->totals());
    result.against = to_comparison(swept, *compared, found);
    result.against->old_digest = to_hex(identity_of(old_version->catalog));
  }
  SweepTimes& times = result.times.emplace();
  times.events = std::move(all.times);
  times.slowest = to_slowest(swept, all.most_time, "time");
  times.elapsed = static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - begin).count());
  return outcome;
}

}  // namespace cbc
