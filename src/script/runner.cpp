#include "script/runner.h"

#include <utility>

#include "script/expectation.h"

namespace cbc {

void Runner::resume(const Snapshot& snapshot) {
  coordinator_.resume(snapshot);
  index_ = snapshot.events;
  outcome_ = snapshot.outcome;
}

Snapshot Runner::snapshot() const {
  Snapshot snapshot = coordinator_.snapshot();
  snapshot.outcome = outcome_;
  return snapshot;
}

bool Runner::take(const Step& step) {
  if (step.time && !note(coordinator_.advance_to(*step.time))) return false;
  if (step.expect) {
    check(step);
    return true;
  }
  step_ = &step;
  return note(coordinator_.handle(event_of(step)));
}

void Runner::on_event(const EventRecord& record) {
  index_ = record.index;
  const bool is_scripted = record.origin == Origin::script;
  if (is_scripted &&
      (record.verb == Verb::start || record.verb == Verb::stop || record.verb == Verb::finish)) {
    outcome_ = record.outcome;
  }
  if (result_.totals) result_.totals->add(record);
  listener_.on_event(record, is_scripted ? step_ : nullptr, coordinator_.state());
}

bool Runner::note(Coordinator::Status status) {
  if (status == Coordinator::Status::ok) return true;
  result_.status = status;
  result_.internal_error = coordinator_.internal_error();
  return false;
}

void Runner::check(const Step& step) {
  std::string mismatch = find_mismatch(*step.expect, catalog_, coordinator_.state(), outcome_);
  if (mismatch.empty()) {
    ++result_.passed;
  } else {
    ++result_.failed;
    listener_.on_failure({index_, step.range, std::move(mismatch), &step});
  }
}

Event event_of(const Step& step) {
  Event event;
  event.verb = step.verb;
  event.subject = step.subject;
  event.priority = step.priority;
  if (step.parameters) event.parameters = step.parameters->canonical;
  event.cause = step.cause;
  event.situation = step.situation;
  return event;
}

RunResult run_script(const CompiledCatalog& catalog, const Script& script,
                     const CoordinatorOptions& options, RunListener& listener) {
  CoordinatorOptions of_script = options;
  of_script.reactive_delay = script.reactive_delay;
  Runner runner(catalog, of_script, listener);
  runner.begin(script.situation);
  bool goes_on = true;
  for (const Step& step : script.steps) {
    goes_on = runner.take(step);
    if (!goes_on) break;
  }
  if (goes_on) static_cast<void>(runner.settle());
  listener.on_end(runner.coordinator().state());
  return runner.result();
}

}  // namespace cbc
