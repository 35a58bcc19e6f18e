#include "tune/engine/recording.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace cbc {
namespace {

class Recorder final : public RunListener {
 public:
  explicit Recorder(Recording& recording) : recording_(recording) {}

  [[nodiscard]] std::vector<SolvedProblem> take_decisions() { return decisions_.take(); }
  void begin_mission() {
    recording_.events.emplace_back();
    behaviors_.assign(recording_.catalog.tasks.size(), none);
    line_ = 0;
  }
  void on_search(const Problem& problem, const Assignment* solution) override {
    decisions_.add(problem, solution);
  }
  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override {
    if (step != nullptr) line_ = step->range.begin.line;
    RecordedEvent& event = recording_.events.back().emplace_back(RecordedEvent{record, line_, {}});
    event.record.search = nullptr;
    if (record.search == nullptr) return;
    const GroupId group = record.search->group;
    const auto& first_tasks = recording_.catalog.group_tasks;
    for (TaskId task = first_tasks[group]; task < first_tasks[group + 1]; ++task) {
      const BehaviorId now = state.behavior(task);
      if (now != behaviors_[task]) event.moves.push_back({task, behaviors_[task], now});
      behaviors_[task] = now;
    }
  }
  void on_success(const Success& /*success*/) override { ++recording_.passed; }
  void on_failure(const Failure& failure) override {
    recording_.failures.push_back({recording_.events.size() - 1, {failure.range, failure.message}});
  }

 private:
  Recording& recording_;
  SolvedProblems decisions_;
  std::vector<BehaviorId> behaviors_;  ///< by task, after the last event
  std::uint32_t line_ = 0;
};

bool is_same(const RecordedEvent& a, const RecordedEvent& b) {
  const auto what = [](const EventRecord& of) {
    return std::tie(of.time, of.origin, of.verb, of.task, of.behavior, of.cause, of.priority,
                    of.outcome, of.changes, of.tasks_of_changes);
  };
  return what(a.record) == what(b.record) && a.moves == b.moves;
}

}  // namespace

Recording record(CompiledCatalog catalog, const Missions& missions, Until until) {
  Recording recording;
  recording.catalog = std::move(catalog);
  Recorder recorder(recording);
  for (const Script* const mission : missions) {
    recorder.begin_mission();
    CoordinatorOptions options = options_of(*mission);
    options.max_clock_events = most_clock_events;
    Runner runner(recording.catalog, options, recorder);
    runner.begin(mission->situation);
    const auto is_over = [&] { return until == Until::failure && !recording.failures.empty(); };
    bool goes_on = true;
    for (const Step& step : mission->steps) {
      goes_on = runner.take(step);
      if (!goes_on || is_over()) break;
    }
    if (goes_on && !is_over()) goes_on = runner.settle();
    recording.status = runner.result().status;
    recording.internal_error = runner.result().internal_error;
    if (!goes_on || is_over()) break;
  }
  recording.decisions = recorder.take_decisions();
  return recording;
}

std::optional<RunDifference> find_difference(const Recording& before, const Recording& now) {
  std::optional<RunDifference> difference;
  for (std::size_t mission = 0; mission < now.events.size() && !difference; ++mission) {
    const std::vector<RecordedEvent>& old_events = before.events[mission];
    const std::vector<RecordedEvent>& new_events = now.events[mission];
    const auto [old_event, new_event] = std::mismatch(
        old_events.begin(), old_events.end(), new_events.begin(), new_events.end(), is_same);
    const RecordedEvent* const old_one = old_event == old_events.end() ? nullptr : &*old_event;
    const RecordedEvent* const new_one = new_event == new_events.end() ? nullptr : &*new_event;
    const RecordedEvent* const first = new_one != nullptr ? new_one : old_one;
    if (first == nullptr) continue;
    difference.emplace();
    difference->mission = mission;
    difference->line = first->line;
    difference->event = first->record.index;
    std::map<TaskId, ValueChange> moves;
    if (old_one != nullptr) {
      difference->before = old_one->record;
      for (const ValueChange& move : old_one->moves)
        moves[move.task] = {move.task, move.now, move.before};
    }
    if (new_one != nullptr) {
      difference->now = new_one->record;
      for (const ValueChange& move : new_one->moves) {
        moves.try_emplace(move.task, move).first->second.now = move.now;
      }
    }
    for (const auto& [task, move] : moves) {
      if (move.before != move.now) difference->moves.push_back(move);
    }
  }
  if (!difference) return difference;
  std::set<std::pair<std::size_t, Range>> known;
  for (const auto& [mission, expectation] : before.failures)
    known.emplace(mission, expectation.range);
  const auto is_new = [&](const Recording::Failure& failure) {
    return !known.contains({failure.mission, failure.expectation.range});
  };
  const auto failure = std::find_if(now.failures.begin(), now.failures.end(), is_new);
  if (failure != now.failures.end()) difference->failure = *failure;
  return difference;
}

std::vector<std::uint32_t> differing_lines(const Recording& before, const Recording& now,
                                           std::size_t mission) {
  using Events = std::vector<const RecordedEvent*>;
  std::map<std::uint32_t, std::pair<Events, Events>> by_line;
  for (const RecordedEvent& event : before.events[mission])
    by_line[event.line].first.push_back(&event);
  for (const RecordedEvent& event : now.events[mission])
    by_line[event.line].second.push_back(&event);
  std::vector<std::uint32_t> lines;
  for (const auto& [line, events] : by_line) {
    const auto same = [](const RecordedEvent* a, const RecordedEvent* b) {
      return is_same(*a, *b);
    };
    if (!std::equal(events.first.begin(), events.first.end(), events.second.begin(),
                    events.second.end(), same)) {
      lines.push_back(line);
    }
  }
  return lines;
}

}  // namespace cbc
