#include "cbc/live_coordinator.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "coordinator/coordinator.h"
#include "interface/content.h"
#include "interface/event_checks.h"
#include "interface/handled_events.h"

namespace cbc {
namespace {

CoordinatorOptions to_internal(const LiveOptions& options) {
  CoordinatorOptions internal;
  internal.reactive_delay = std::clamp<Microseconds>(options.reactive_delay, 1, longest_time);
  internal.search.max_nodes = options.max_nodes;
  internal.search.time_limit =
      std::chrono::microseconds(std::clamp<Microseconds>(options.time_limit, 0, longest_time));
  internal.max_clock_events = LiveCoordinator::most_events;
  internal.find_conflicts = false;
  return internal;
}

}  // namespace

std::string_view name_of(LiveStatus status) {
  static constexpr std::array<std::string_view, 11> names{"ok",
                                                          "invalid_time",
                                                          "invalid_verb",
                                                          "invalid_cause",
                                                          "invalid_priority",
                                                          "invalid_parameters",
                                                          "invalid_situation",
                                                          "unknown_task",
                                                          "unknown_behavior",
                                                          "too_many_events",
                                                          "internal_error"};
  return names[static_cast<std::size_t>(status)];
}

class LiveCoordinator::Impl {
 public:
  Impl(CompiledCatalog catalog, const LiveOptions& options)
      : catalog_(std::move(catalog)),
        log_(catalog_),
        coordinator_(catalog_, to_internal(options), log_) {
    coordinator_.begin({});
  }

  LiveStatus handle(Microseconds time, const Event& event) {
    LiveStatus status = begin_call();
    if (status == LiveStatus::ok) status = check_event(catalog_, event);
    if (status == LiveStatus::ok) status = move_clock(time);
    if (status != LiveStatus::ok) return end_call(status);
    const Coordinator::Status done = coordinator_.handle(event);
    // Where what follows the event is too much, the event itself is done, and the rest is due.
    return end_call(done == Coordinator::Status::refused_answer ? LiveStatus::internal_error
                                                                : LiveStatus::ok);
  }

  LiveStatus advance_to(Microseconds time) {
    LiveStatus status = begin_call();
    if (status == LiveStatus::ok) status = move_clock(time);
    if (status == LiveStatus::ok) status = to_public(coordinator_.settle());
    return end_call(status);
  }

  [[nodiscard]] std::span<const HandledEvent> events() const { return events_; }
  [[nodiscard]] const Coordinator& coordinator() const { return coordinator_; }

  [[nodiscard]] std::optional<std::uint32_t> behavior_of(std::uint32_t task) const {
    if (task >= catalog_.task_ids.size()) return std::nullopt;
    const BehaviorId behavior = coordinator_.state().behavior(catalog_.task_ids[task]);
    if (behavior == none) return std::nullopt;
    return catalog_.behaviors[behavior].catalog_index;
  }

 private:
  LiveStatus begin_call() {
    log_.clear();
    coordinator_.restart_count();
    const bool has_failed = !coordinator_.internal_error().empty();
    return has_failed ? LiveStatus::internal_error : LiveStatus::ok;
  }

  LiveStatus end_call(LiveStatus status) {
    events_ = log_.events();
    return status;
  }

  LiveStatus move_clock(Microseconds time) {
    if (time < coordinator_.now() || time > longest_time) return LiveStatus::invalid_time;
    return to_public(coordinator_.advance_to(time));
  }

  static LiveStatus to_public(Coordinator::Status status) {
    switch (status) {
      case Coordinator::Status::ok:
        return LiveStatus::ok;
      case Coordinator::Status::too_many_clock_events:
        return LiveStatus::too_many_events;
      case Coordinator::Status::refused_answer:
        break;
    }
    return LiveStatus::internal_error;
  }

  const CompiledCatalog catalog_;
  HandledEvents log_;
  Coordinator coordinator_;
  std::span<const HandledEvent> events_;
};

LiveCoordinator::LiveCoordinator(const LoadedCatalog& catalog, const LiveOptions& options)
    : impl_(std::make_unique<Impl>(catalog.content_->catalog, options)) {}

LiveCoordinator::~LiveCoordinator() = default;

LiveStatus LiveCoordinator::handle(Microseconds time, const Event& event) {
  return impl_->handle(time, event);
}

LiveStatus LiveCoordinator::advance_to(Microseconds time) { return impl_->advance_to(time); }

std::span<const HandledEvent> LiveCoordinator::events() const { return impl_->events(); }

Microseconds LiveCoordinator::now() const { return impl_->coordinator().now(); }

std::optional<Microseconds> LiveCoordinator::next_due() const {
  return impl_->coordinator().next_due();
}

std::optional<std::uint32_t> LiveCoordinator::behavior_of(std::uint32_t task) const {
  return impl_->behavior_of(task);
}

std::string_view LiveCoordinator::internal_error() const {
  return impl_->coordinator().internal_error();
}

}  // namespace cbc
