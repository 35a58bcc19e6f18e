#include "interface/handled_events.h"

namespace cbc {
namespace {

/// Lets spans of known sizes follow one another in an array.
template <typename T>
class Places {
 public:
  explicit Places(const std::vector<T>& items) : next_(items.data()) {}

  void set(std::span<const T>& span) {
    span = {next_, span.size()};
    next_ += span.size();
  }

 private:
  const T* next_;
};

}  // namespace

void HandledEvents::clear() {
  events_.clear();
  changes_.clear();
  stopped_tasks_.clear();
  tasks_.clear();
}

void HandledEvents::on_event(const EventRecord& record) {
  for (const Change& change : record.changes) add_change(record, change);
  for (const StoppedTask& task : record.stopped_tasks) {
    stopped_tasks_.push_back({catalog_.tasks[task.task].catalog_index, task.cause});
  }
  HandledEvent& event = events_.emplace_back();
  event.time = record.time;
  event.origin = record.origin;
  event.verb = record.verb;
  event.subject = subject_of(record);
  event.priority = record.priority;
  if (record.verb == Verb::finish) event.cause = record.cause;
  event.outcome = record.outcome;
  if (record.search != nullptr) {
    const SearchStatus status = record.search->result.status;
    event.is_proven = status == SearchStatus::optimal || status == SearchStatus::infeasible;
  }
  event.changes = std::span(changes_).last(record.changes.size());
  event.stopped_tasks = std::span(stopped_tasks_).last(record.stopped_tasks.size());
}

void HandledEvents::add_change(const EventRecord& record, const Change& change) {
  for (const TaskId task : record.tasks_of(change)) {
    tasks_.push_back(catalog_.tasks[task].catalog_index);
  }
  BehaviorChange& entry = changes_.emplace_back();
  entry.is_activation = change.is_activation;
  entry.behavior = catalog_.behaviors[change.behavior].catalog_index;
  entry.tasks = std::span(tasks_).last(change.task_count);
  entry.cause = change.cause;
  entry.priority = change.priority;
  entry.success = change.success;
}

std::uint32_t HandledEvents::subject_of(const EventRecord& record) const {
  if (record.task != none) return catalog_.tasks[record.task].catalog_index;
  if (record.behavior != none) return catalog_.behaviors[record.behavior].catalog_index;
  return 0;
}

std::span<const HandledEvent> HandledEvents::events() {
  Places changes(changes_);
  Places stopped_tasks(stopped_tasks_);
  Places tasks(tasks_);
  for (HandledEvent& event : events_) {
    changes.set(event.changes);
    stopped_tasks.set(event.stopped_tasks);
  }
  for (BehaviorChange& change : changes_) tasks.set(change.tasks);
  return events_;
}

}  // namespace cbc
