#include "script/runner.h"

#include <optional>

#include "script/expectation.h"

namespace cbc {
namespace {

class Runner final : public EventListener {
 public:
  Runner(const CompiledCatalog& catalog, const Script& script, const CoordinatorOptions& options,
         RunListener& listener)
      : catalog_(catalog),
        script_(script),
        listener_(listener),
        coordinator_(catalog, options, *this) {}

  RunResult run() {
    result_.status = take_all();
    result_.internal_error = coordinator_.internal_error();
    listener_.on_end(coordinator_.state());
    return std::move(result_);
  }

  void on_event(const EventRecord& record) override {
    index_ = record.index;
    const bool is_scripted = record.origin == Origin::script;
    if (is_scripted &&
        (record.verb == Verb::start || record.verb == Verb::stop || record.verb == Verb::finish)) {
      outcome_ = record.outcome;
    }
    listener_.on_event(record, is_scripted ? step_ : nullptr, coordinator_.state());
  }

 private:
  [[nodiscard]] Coordinator::Status take_all() {
    coordinator_.begin(script_.situation);
    for (const Step& step : script_.steps) {
      if (const auto status = take(step); status != Coordinator::Status::ok) return status;
    }
    return coordinator_.settle();
  }

  [[nodiscard]] Coordinator::Status take(const Step& step) {
    if (step.time) {
      if (const auto status = coordinator_.advance_to(*step.time);
          status != Coordinator::Status::ok) {
        return status;
      }
    }
    if (step.expect) {
      check(step);
      return Coordinator::Status::ok;
    }
    step_ = &step;
    return coordinator_.handle(event_of(step));
  }

  void check(const Step& step) {
    std::string mismatch = find_mismatch(*step.expect, catalog_, coordinator_.state(), outcome_);
    if (mismatch.empty()) {
      ++result_.passed;
    } else {
      ++result_.failed;
      listener_.on_failure({index_, step.range, std::move(mismatch)});
    }
  }

  const CompiledCatalog& catalog_;
  const Script& script_;
  RunListener& listener_;
  Coordinator coordinator_;
  RunResult result_;
  const Step* step_ = nullptr;
  std::uint64_t index_ = 0;
  std::optional<Outcome> outcome_;
};

}  // namespace

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
  return Runner(catalog, script, of_script, listener).run();
}

}  // namespace cbc
