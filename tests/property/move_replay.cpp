#include "move_replay.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "demand.h"
#include "runtime/coordinator/coordinator.h"

namespace cbc::plain {

using oracle::contains;
using oracle::demand;

namespace {

/// By move, counted from 1: the one by which the first set of the queue before it joined; 0 is the
/// start of the script, nothing an empty queue.
using Joins = std::vector<std::optional<std::size_t>>;

Joins joins_of_first_sets(const PlainModel& model, const std::vector<Move>& script) {
  Joins joins(1);
  Snapshot state = model.first_state();
  std::vector<std::size_t> queue(PlainModel::sets_of_queue(state).size(), 0);
  for (const Move& move : script) {
    joins.push_back(queue.empty() ? std::nullopt : std::optional(queue.front()));
    Step step = model.step(state, move);
    std::vector<std::size_t> next;
    for (const auto& old_place : step.old_place) {
      next.push_back(old_place ? queue[*old_place] : joins.size() - 1);
    }
    queue = std::move(next);
    state = std::move(step.next);
  }
  return joins;
}

class LastOutcome final : public EventListener {
 public:
  void on_event(const EventRecord& record) override {
    demand(record.origin != Origin::timeout, "a timeout fired");
    if (record.origin == Origin::script && form_of(record.verb).is_decided) {
      outcome = record.outcome;
    }
  }

  std::optional<Outcome> outcome;
};

}  // namespace

/// The least instants that satisfy all lower bounds, one move after the other, again and again.
std::vector<Microseconds> times_of(const PlainModel& model, const std::vector<Move>& script) {
  const Joins joins = joins_of_first_sets(model, script);
  std::vector<Microseconds> times(joins.size(), 0);
  bool has_changed = true;
  for (std::size_t round = 0; has_changed; ++round) {
    demand(round <= joins.size() + 1, "no times fit the script");
    has_changed = false;
    const auto raise = [&](std::size_t place, Microseconds time) {
      if (times[place] >= time) return;
      times[place] = time;
      has_changed = true;
    };
    for (std::size_t place = 1; place < times.size(); ++place) {
      raise(place, times[place - 1] + 1);
      if (!joins[place]) continue;
      if (script[place - 1].kind == Move::Kind::due) {
        raise(place, times[*joins[place]] + reactive_delay);
        raise(*joins[place], times[place] - reactive_delay);
      } else {
        raise(*joins[place], times[place] - reactive_delay + 1);
      }
    }
  }
  times.erase(times.begin());
  return times;
}

Replay replay(const PlainModel& model, const std::vector<Move>& script) {
  const CompiledCatalog& catalog = model.catalog();
  const std::vector<Microseconds> times = times_of(model, script);
  std::vector<Availability> own;
  for (const SituationPart::Own& entry : model.assumptions().initially.behaviors) {
    own.push_back({catalog.behaviors[entry.behavior].catalog_index, entry.available});
  }
  CoordinatorOptions options;
  options.reactive_delay = reactive_delay;
  LastOutcome listener;
  Coordinator coordinator(catalog, options, listener);
  coordinator.begin(own, model.assumptions().initially.variables);
  for (std::size_t i = 0; i < script.size(); ++i) {
    demand(coordinator.advance_to(times[i]) == Coordinator::Status::ok,
           coordinator.internal_error());
    listener.outcome.reset();
    handle_move(catalog, script[i], coordinator);
  }
  return {model.as_state(coordinator.snapshot()), listener.outcome};
}

}  // namespace cbc::plain
