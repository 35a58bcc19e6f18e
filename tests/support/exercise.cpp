#include "support/exercise.h"

#include <algorithm>
#include <cstdint>

#include "runtime/coordinator/coordinator.h"

namespace cbc::test {
namespace {

class NoListener final : public EventListener {
 public:
  void on_event(const EventRecord&) override {}
};

}  // namespace

std::optional<std::string> exercise(const CompiledCatalog& catalog, const Snapshot* state) {
  NoListener nobody;
  CoordinatorOptions options;
  options.max_clock_events = 50;
  options.search.max_nodes = 1000;
  if (state != nullptr) {
    options.reactive_delay = state->reactive_delay;
    options.timeouts = state->timeouts;
  }
  Coordinator coordinator(catalog, options, nobody);
  if (state != nullptr) {
    coordinator.resume(*state);
  } else {
    coordinator.begin({});
  }
  std::optional<std::string> refusal;
  const auto step = [&](Verb verb, std::uint32_t subject, std::int32_t priority) {
    Event event;
    event.verb = verb;
    event.subject = subject;
    event.cause = FinishCause::wrong_progress;
    if (verb == Verb::start) event.priority = priority;
    const Microseconds next = std::min(coordinator.now(), longest_time - second) + second;
    Coordinator::Status status = coordinator.advance_to(std::max(next, coordinator.now()));
    if (status == Coordinator::Status::ok) status = coordinator.handle(event);
    if (status == Coordinator::Status::refused_answer) refusal = coordinator.internal_error();
    return status == Coordinator::Status::ok;
  };
  for (std::uint32_t task = 0; task < catalog.tasks.size(); ++task) {
    if (!step(Verb::start, task, static_cast<std::int32_t>(1 + task % 3))) return refusal;
  }
  for (std::uint32_t behavior = 0; behavior < catalog.behaviors.size(); ++behavior) {
    if (!step(Verb::finish, behavior, 0)) return refusal;
  }
  return refusal;
}

}  // namespace cbc::test
