#include "cbc/live_coordinator.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cbc/event.h"
#include "cbc/loaded_catalog.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/compiled/compiled_file.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/record.h"

namespace cbc {

struct LoadedCatalog::Content {
  CompiledCatalog catalog;
};

namespace {

std::string_view name_at(const Texts& names, std::uint32_t index) {
  return index < names.size() ? names[index] : std::string_view();
}

}  // namespace

CatalogLoading LoadedCatalog::load(const std::string& path) {
  CompiledFileResult result = load_compiled(path);
  if (!result.file) return {std::nullopt, std::move(result.error)};
  Content content{std::move(result.file->catalog)};
  return {LoadedCatalog(std::make_shared<const Content>(std::move(content))), {}};
}

LoadedCatalog::LoadedCatalog(std::shared_ptr<const Content> content)
    : content_(std::move(content)) {}

std::size_t LoadedCatalog::task_count() const { return content_->catalog.task_names.size(); }

std::size_t LoadedCatalog::behavior_count() const {
  return content_->catalog.behavior_names.size();
}

std::string_view LoadedCatalog::task_name(std::uint32_t index) const {
  return name_at(content_->catalog.task_names, index);
}

std::string_view LoadedCatalog::behavior_name(std::uint32_t index) const {
  return name_at(content_->catalog.behavior_names, index);
}

std::optional<std::uint32_t> LoadedCatalog::find_task(std::string_view name) const {
  return content_->catalog.find_task(name);
}

std::optional<std::uint32_t> LoadedCatalog::find_behavior(std::string_view name) const {
  return content_->catalog.find_behavior(name);
}

std::size_t LoadedCatalog::variable_count() const { return content_->catalog.variables.size(); }

std::size_t LoadedCatalog::value_count(std::uint32_t variable) const {
  const auto variables = content_->catalog.variables;
  return variable < variables.size() ? variables[variable].value_count : 0;
}

std::string_view LoadedCatalog::variable_name(std::uint32_t variable) const {
  return variable < variable_count() ? content_->catalog.name_of_variable(variable)
                                     : std::string_view();
}

std::string_view LoadedCatalog::value_name(VariableValue value) const {
  return value.value < value_count(value.variable) ? content_->catalog.name_of_value(value)
                                                   : std::string_view();
}

std::optional<std::uint32_t> LoadedCatalog::find_variable(std::string_view name) const {
  return content_->catalog.find_variable(name);
}

std::optional<std::uint32_t> LoadedCatalog::find_value(std::uint32_t variable,
                                                       std::string_view name) const {
  if (variable >= variable_count()) return std::nullopt;
  return content_->catalog.find_value(variable, name);
}

namespace {

LiveStatus check_behavior(const CompiledCatalog& catalog, std::uint32_t behavior) {
  return behavior < catalog.behaviors.size() ? LiveStatus::ok : LiveStatus::unknown_behavior;
}

LiveStatus check_parameters(const Event& event) {
  const bool is_missing =
      event.parameters && event.parameters->data() == nullptr && !event.parameters->empty();
  return is_missing ? LiveStatus::invalid_parameters : LiveStatus::ok;
}

template <typename T>
bool has_entries(std::span<const T> entries) {
  return entries.data() != nullptr || entries.empty();
}

LiveStatus check_situation(const CompiledCatalog& catalog, const Event& event) {
  if (!has_entries(event.situation) || !has_entries(event.variables)) {
    return LiveStatus::invalid_situation;
  }
  for (const Availability& entry : event.situation) {
    const LiveStatus status = check_behavior(catalog, entry.behavior);
    if (status != LiveStatus::ok) return status;
  }
  for (const VariableValue& value : event.variables) {
    if (value.variable >= catalog.variables.size()) return LiveStatus::unknown_variable;
    if (value.value >= catalog.variables[value.variable].value_count) {
      return LiveStatus::unknown_value;
    }
  }
  return LiveStatus::ok;
}

LiveStatus check_subject(const CompiledCatalog& catalog, const Event& event) {
  const LiveStatus of_task =
      event.subject < catalog.tasks.size() ? LiveStatus::ok : LiveStatus::unknown_task;
  switch (form_of(event.verb).subject) {
    case VerbForm::SubjectKind::task:
      return of_task;
    case VerbForm::SubjectKind::behavior:
      if (event.verb == Verb::finish && event.is_by_task) return of_task;
      return check_behavior(catalog, event.subject);
    case VerbForm::SubjectKind::situation:
      return check_situation(catalog, event);
    case VerbForm::SubjectKind::nothing:
      break;
  }
  return LiveStatus::ok;
}

/// The first error of an event with arbitrary content, or ok. Looks only at what its verb uses.
LiveStatus check_event(const CompiledCatalog& catalog, const Event& event) {
  if (event.verb > Verb::wait) return LiveStatus::invalid_verb;
  const VerbForm& form = form_of(event.verb);
  const LiveStatus status = check_subject(catalog, event);
  if (status != LiveStatus::ok) return status;
  if (form.has_priority && event.priority && *event.priority < form.lowest_priority) {
    return LiveStatus::invalid_priority;
  }
  if (event.verb == Verb::start &&
      catalog.rules_of(catalog.task_ids[event.subject]).requestable == 0) {
    return LiveStatus::not_requestable;
  }
  if (form.has_parameters) return check_parameters(event);
  if (form.has_cause && event.cause > FinishCause::interrupted) return LiveStatus::invalid_cause;
  return LiveStatus::ok;
}

/// Places spans of known sizes one after the other in an array.
template <typename T>
class ConsecutiveSpans {
 public:
  explicit ConsecutiveSpans(const std::vector<T>& items) : next_(items.data()) {}

  void set(std::span<const T>& span) {
    span = {next_, span.size()};
    next_ += span.size();
  }

 private:
  const T* next_;
};

/// Keeps the events of one call as the public interface reports them.
class HandledEvents final : public EventListener {
 public:
  explicit HandledEvents(const CompiledCatalog& catalog) : catalog_(catalog) {}

  void clear();
  void on_event(const EventRecord& record) override;

  /// Valid until the next event.
  [[nodiscard]] std::span<const HandledEvent> events();

 private:
  void add_change(const EventRecord& record, const Change& change);
  [[nodiscard]] std::uint32_t subject_of(const EventRecord& record) const;

  const CompiledCatalog& catalog_;
  // The arrays move when they grow, so only the sizes of spans are right until events() sets them.
  std::vector<HandledEvent> events_;
  std::vector<BehaviorChange> changes_;  ///< of all events, one after the other
  std::vector<TaskStop> stopped_tasks_;
  std::vector<std::uint32_t> tasks_;  ///< of all changes
};

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
  if (record.search != nullptr) event.is_proven = is_proven(record.search->result.status);
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
  if (record.behavior != none) return catalog_.behaviors[record.behavior].catalog_index;
  if (record.verb == Verb::finish || record.verb == Verb::reconsider) return no_subject;
  return record.task != none ? catalog_.tasks[record.task].catalog_index : 0;
}

std::span<const HandledEvent> HandledEvents::events() {
  ConsecutiveSpans changes(changes_);
  ConsecutiveSpans stopped_tasks(stopped_tasks_);
  ConsecutiveSpans tasks(tasks_);
  for (HandledEvent& event : events_) {
    changes.set(event.changes);
    stopped_tasks.set(event.stopped_tasks);
  }
  for (BehaviorChange& change : changes_) tasks.set(change.tasks);
  return events_;
}

CoordinatorOptions to_internal(const LiveOptions& options) {
  CoordinatorOptions internal;
  internal.reactive_delay = std::clamp<Microseconds>(options.reactive_delay, 1, longest_time);
  internal.search.max_nodes = options.max_nodes;
  internal.search.time_limit =
      std::chrono::microseconds(std::clamp<Microseconds>(options.time_limit, 0, longest_time));
  internal.max_clock_events = LiveCoordinator::most_events;
  return internal;
}

}  // namespace

std::string_view name_of(LiveStatus status) {
  static constexpr std::array<std::string_view, 14> names{"ok",
                                                          "invalid_time",
                                                          "invalid_verb",
                                                          "invalid_cause",
                                                          "invalid_priority",
                                                          "invalid_parameters",
                                                          "invalid_situation",
                                                          "unknown_task",
                                                          "unknown_behavior",
                                                          "unknown_variable",
                                                          "unknown_value",
                                                          "not_requestable",
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
    // If too many events follow, the event itself is done, and the others stay due.
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
      case Coordinator::Status::stopped:  // nothing asks for it
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

std::optional<std::uint32_t> LiveCoordinator::value_of(std::uint32_t variable) const {
  const std::vector<std::uint32_t>& values = impl_->coordinator().state().variables();
  if (variable >= values.size()) return std::nullopt;
  return values[variable];
}

std::string_view LiveCoordinator::internal_error() const {
  return impl_->coordinator().internal_error();
}

}  // namespace cbc
