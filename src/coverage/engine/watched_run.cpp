#include "coverage/engine/watched_run.h"

#include "coverage/engine/goal_watch.h"

namespace cbc {
namespace {

/// Forwards everything, and watches.
class WatchedRun final : public RunListener {
 public:
  WatchedRun(RunListener& listener, GoalWatch& watch) : listener_(listener), watch_(watch) {}

  void on_decision(const EventRecord& record, const Circumstances& circumstances,
                   const Assignment* solution) override {
    watch_.on_decision(record, circumstances, solution);
  }
  void on_event(const EventRecord& record, const Step* step, const State& state) override {
    watch_.on_event(record, state);
    listener_.on_event(record, step, state);
  }
  void on_failure(const Failure& failure) override { listener_.on_failure(failure); }
  void on_end(const State& state) override { listener_.on_end(state); }

 private:
  RunListener& listener_;
  GoalWatch& watch_;
};

}  // namespace

WatchedResult run_watched(const CompiledCatalog& catalog, std::span<const Goal> goals,
                          const Script& script, const CoordinatorOptions& options,
                          RunListener& listener) {
  GoalWatch watch(catalog, goals, options);
  State first(catalog);
  first.change_situation(script.situation.availability, script.situation.variables);
  watch.begin(first);
  WatchedRun watched(listener, watch);
  RunResult result = run_script(catalog, script, options, watched);
  return {std::move(result), watch.met()};
}

}  // namespace cbc
