#include "python/module/session.h"

#include <chrono>
#include <utility>

#include "python/module/explanations.h"
#include "runtime/base/text.h"

namespace cbc::python {

CoordinatorOptions to_internal(const SessionOptions& options, const IsStopped& is_stopped) {
  CoordinatorOptions internal;
  internal.reactive_delay = options.reactive_delay;
  internal.timeouts = options.timeouts;
  internal.search.max_nodes = options.max_nodes;
  internal.search.time_limit = std::chrono::microseconds(options.time_limit);
  internal.is_stopped = is_stopped;
  internal.search.is_stopped = is_stopped;
  return internal;
}

Session::Session(std::shared_ptr<const Catalog> catalog, const SessionOptions& options)
    : catalog_(std::move(catalog)),
      options_(options),
      decisions_(catalog_->compiled->group_count()),
      rejections_(catalog_->compiled->group_count()) {
  make_runner();
}

std::unique_ptr<Session> Session::clone() const {
  auto other = std::make_unique<Session>(catalog_, options_);
  other->resume(snapshot());
  other->decisions_ = decisions_;
  other->rejections_ = rejections_;
  return other;
}

void Session::make_runner() {
  RunListener& listener = *this;  // nobody else may know that it is one
  runner_.emplace(*catalog_->compiled,
                  to_internal(options_,
                              [this] {
                                was_stopped_ =
                                    was_stopped_ || (is_stopped_ != nullptr && (*is_stopped_)());
                                return was_stopped_;
                              }),
                  listener);
}

void Session::begin(const Situation& situation) { runner_->begin(situation); }

void Session::resume(const Snapshot& snapshot) {
  options_.reactive_delay = snapshot.reactive_delay;
  options_.timeouts = snapshot.timeouts;
  make_runner();
  runner_->resume(snapshot);
  decisions_.assign(decisions_.size(), {});
  rejections_.assign(rejections_.size(), std::nullopt);
}

std::optional<std::vector<HandledEvent>> Session::run(Call call, const IsStopped& is_stopped) {
  using Status = Coordinator::Status;
  past_ =
      std::make_shared<const PastCall>(PastCall{catalog_, options_, snapshot(), std::move(call)});
  events_.clear();
  replaced_.clear();
  is_repeatable_ = true;
  is_stopped_ = &is_stopped;
  was_stopped_ = false;
  try {
    (void)make_call(*runner_, past_->call);
  } catch (...) {
    go_back(past_->before);
    throw;
  }
  is_stopped_ = nullptr;
  if (was_stopped_) {
    go_back(past_->before);
    return std::nullopt;
  }
  const Status status = runner_->result().status;
  if (status == Status::ok) return std::move(events_);
  const std::string fault =
      status == Status::too_many_clock_events
          ? concat("the clock made more than ", to_internal(options_).max_clock_events,
                   " events in one call; advance in smaller steps")
          : concat(
                "the checker rejects an answer of the solver, which is a bug in cbc; please "
                "report it: ",
                runner_->result().internal_error);
  go_back(past_->before);
  throw CallFault(fault);
}

void Session::go_back(const Snapshot& before) {
  is_stopped_ = nullptr;
  events_.clear();
  make_runner();
  runner_->resume(before);
  for (; !replaced_.empty(); replaced_.pop_back()) {
    Replaced& replaced = replaced_.back();
    decisions_[replaced.group] = std::move(replaced.decision);
    rejections_[replaced.group] = std::move(replaced.rejection);
  }
}

void Session::on_event(const ExplainedRecord& record, const Step* /*step*/, const State& state) {
  HandledEvent& event = events_.emplace_back();
  event.past = past_;
  event.record = record;
  event.record.search = nullptr;
  if (record.search != nullptr) event.is_proven = is_proven(record.search->result.status);
  is_repeatable_ = is_repeatable_ && (event.is_proven || options_.time_limit == 0);
  if (!is_repeatable_) {
    event.told = std::make_shared<const Told>(tell(*past_, record, state));
  }
  if (record.search != nullptr) {
    const GroupId group = record.search->group;
    replaced_.push_back({group, decisions_[group], std::exchange(rejections_[group], {})});
    if (record.outcome == Outcome::accepted) {
      decisions_[group] = {past_, record.index, record.time, event.told};
    } else {
      rejections_[group] = event;
    }
  }
}

}  // namespace cbc::python
