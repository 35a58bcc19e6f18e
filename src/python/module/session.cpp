#include "python/module/session.h"

#include <chrono>
#include <utility>

#include "core/script/runner.h"
#include "python/module/explanations.h"
#include "runtime/base/text.h"

namespace cbc::python {

CoordinatorOptions to_internal(const SessionOptions& options, const IsStopped& is_stopped) {
  CoordinatorOptions internal;
  internal.reactive_delay = options.reactive_delay;
  internal.timeouts = options.timeouts;
  internal.search.max_nodes = options.max_nodes;
  internal.search.time_limit = std::chrono::microseconds(options.time_limit);
  internal.find_conflicts = false;  // whoever asks why finds them
  internal.is_stopped = is_stopped;
  internal.search.is_stopped = is_stopped;
  return internal;
}

Coordinator::Status make_call(Coordinator& coordinator, const Call& call) {
  using Status = Coordinator::Status;
  coordinator.restart_count();
  if (call.time) {
    if (const Status status = coordinator.advance_to(*call.time); status != Status::ok) {
      return status;
    }
  }
  return call.step ? coordinator.handle(event_of(*call.step)) : coordinator.settle();
}

Session::Session(std::shared_ptr<const Catalog> catalog, const SessionOptions& options)
    : catalog_(std::move(catalog)),
      options_(options),
      decisions_(catalog_->compiled->group_count()),
      rejections_(catalog_->compiled->group_count()) {
  make_coordinator();
}

std::unique_ptr<Session> Session::clone() const {
  auto other = std::make_unique<Session>(catalog_, options_);
  other->resume(snapshot());
  other->decisions_ = decisions_;
  other->rejections_ = rejections_;
  return other;
}

void Session::make_coordinator() {
  EventListener& listener = *this;  // nobody else may know that it is one
  coordinator_.emplace(*catalog_->compiled,
                       to_internal(options_,
                                   [this] {
                                     was_stopped_ = was_stopped_ ||
                                                    (is_stopped_ != nullptr && (*is_stopped_)());
                                     return was_stopped_;
                                   }),
                       listener);
}

void Session::begin(const Situation& situation) {
  coordinator_->begin(situation.availability, situation.variables);
}

void Session::resume(const Snapshot& snapshot) {
  options_.reactive_delay = snapshot.reactive_delay;
  options_.timeouts = snapshot.timeouts;
  make_coordinator();
  coordinator_->resume(snapshot);
  outcome_ = snapshot.outcome;
  decisions_.assign(decisions_.size(), {});
  rejections_.assign(rejections_.size(), std::nullopt);
}

Snapshot Session::snapshot() const {
  Snapshot snapshot = coordinator_->snapshot();
  snapshot.outcome = outcome_;
  return snapshot;
}

std::optional<std::vector<HandledEvent>> Session::run(Call call, const IsStopped& is_stopped) {
  using Status = Coordinator::Status;
  moment_ = std::make_shared<const Moment>(Moment{catalog_, options_, snapshot(), std::move(call)});
  events_.clear();
  replaced_.clear();
  is_repeatable_ = true;
  is_stopped_ = &is_stopped;
  was_stopped_ = false;
  Status status = Status::ok;
  try {
    status = make_call(*coordinator_, moment_->call);
  } catch (...) {
    go_back(*moment_);
    throw;
  }
  is_stopped_ = nullptr;
  if (was_stopped_) {
    go_back(*moment_);
    return std::nullopt;
  }
  if (status == Status::ok) return std::move(events_);
  const std::string fault =
      status == Status::too_many_clock_events
          ? concat("the clock made more than ", to_internal(options_).max_clock_events,
                   " events in one call; advance in smaller steps")
          : concat(
                "the checker rejects an answer of the solver, which is a bug in cbc; please "
                "report it: ",
                coordinator_->internal_error());
  go_back(*moment_);
  throw CallFault(fault);
}

void Session::go_back(const Moment& moment) {
  is_stopped_ = nullptr;
  events_.clear();
  make_coordinator();
  coordinator_->resume(moment.before);
  outcome_ = moment.before.outcome;
  for (; !replaced_.empty(); replaced_.pop_back()) {
    Replaced& replaced = replaced_.back();
    decisions_[replaced.group] = std::move(replaced.decision);
    rejections_[replaced.group] = std::move(replaced.rejection);
  }
}

void Session::on_event(const EventRecord& record) {
  HandledEvent& event = events_.emplace_back();
  event.moment = moment_;
  event.record = record;
  event.record.search = nullptr;
  if (record.search != nullptr) event.is_proven = is_proven(record.search->result.status);
  is_repeatable_ = is_repeatable_ && (event.is_proven || options_.time_limit == 0);
  if (!is_repeatable_) {
    event.told = std::make_shared<const Told>(tell(*moment_, record, coordinator_->state()));
  }
  if (record.search != nullptr) {
    const GroupId group = record.search->group;
    replaced_.push_back({group, decisions_[group], std::exchange(rejections_[group], {})});
    if (record.outcome == Outcome::accepted) {
      decisions_[group] = {moment_, record.index, record.time, event.told};
    } else {
      rejections_[group] = event;
    }
  }
  if (record.origin == Origin::script && form_of(record.verb).is_decided) outcome_ = record.outcome;
}

}  // namespace cbc::python
