#include "unit/stage.h"

#include <cmath>

#include "unit/compiled_fixture.h"

namespace cbc::test {
namespace {

Microseconds microseconds(double seconds) { return std::llround(seconds * second); }

void append(std::string& text, const std::string& item, std::string_view separator) {
  if (!text.empty()) text += separator;
  text += item;
}

}  // namespace

Stage::Stage(std::string_view catalog, const CoordinatorOptions& options,
             const Situation& situation)
    : catalog_(compile_text(catalog)), coordinator_(catalog_, options, *this) {
  coordinator_.begin(availabilities_of(situation));
}

std::string Stage::start(std::string_view task, std::optional<std::int32_t> priority) {
  Event event;
  event.verb = Verb::start;
  event.subject = task_index(task);
  event.priority = priority;
  return handle(event);
}

std::string Stage::stop(std::string_view task) {
  Event event;
  event.verb = Verb::stop;
  event.subject = task_index(task);
  return handle(event);
}

std::string Stage::finish(std::string_view behavior, FinishCause cause) {
  Event event;
  event.verb = Verb::finish;
  event.subject = behavior_index(behavior);
  event.cause = cause;
  return handle(event);
}

std::string Stage::set(const Situation& situation) {
  const std::vector<Availability> entries = availabilities_of(situation);
  Event event;
  event.verb = Verb::situation;
  event.situation = entries;
  return handle(event);
}

std::string Stage::fault(std::string_view behavior) {
  Event event;
  event.verb = Verb::fault;
  event.subject = behavior_index(behavior);
  return handle(event);
}

std::string Stage::advance_to(double seconds) {
  forget();
  return conclude(coordinator_.advance_to(microseconds(seconds)));
}

std::string Stage::settle_at(double seconds) {
  forget();
  Coordinator::Status status = coordinator_.advance_to(microseconds(seconds));
  if (status == Coordinator::Status::ok) status = coordinator_.settle();
  return conclude(status);
}

std::string Stage::handle(Event event) {
  forget();
  return conclude(coordinator_.handle(event));
}

std::string Stage::conclude(Coordinator::Status status) {
  status_ = status;
  if (status == Coordinator::Status::refused_answer) outcomes_ += coordinator_.internal_error();
  return outcomes_;
}

void Stage::forget() {
  for (std::string* text : {&outcomes_, &changes_, &stopped_, &searches_}) {
    text->clear();
  }
}

void Stage::on_event(const EventRecord& record) {
  const bool is_first = outcomes_.empty();
  append(outcomes_, std::string(name_of(record.outcome)), "; ");

  std::string changes;
  for (const Change& change : record.changes) append(changes, show(change), ", ");
  std::string stopped;
  for (const StoppedTask& entry : record.stopped_tasks) {
    append(stopped,
           std::string(catalog_.name_of_task(entry.task)) + " " + std::string(name_of(entry.cause)),
           ", ");
  }
  if (!is_first) {
    changes_ += "; ";
    stopped_ += "; ";
  }
  changes_ += changes;
  stopped_ += stopped;

  std::string search = "none";
  if (record.search) {
    search = std::string(name_of(record.search->result.status)) + " protection " +
             std::to_string(record.search->protection);
    if (record.search->is_escalated) search += " escalated";
    search += " sizes";
    for (const std::uint32_t size : record.search->domain_sizes) {
      search += " " + std::to_string(size);
    }
  }
  append(searches_, search, "; ");
}

std::string Stage::show(const Change& change) const {
  std::string text =
      (change.is_activation ? "+" : "-") + std::string(catalog_.name_of_behavior(change.behavior));
  text += " " + std::string(name_of(change.cause));
  if (change.priority) text += " " + std::to_string(*change.priority);
  return text + (change.success ? "" : " failed");
}

std::string Stage::running() const {
  std::string text;
  for (const std::uint32_t index : state().running()) {
    const BehaviorId behavior = state().behavior(catalog_.task_ids[index]);
    append(text,
           std::string(catalog_.task_names[index]) + "=" +
               std::string(catalog_.name_of_behavior(behavior)),
           " ");
  }
  return text;
}

std::uint32_t Stage::task_index(std::string_view name) const {
  return catalog_.tasks[task_id(catalog_, name)].catalog_index;
}

std::uint32_t Stage::behavior_index(std::string_view name) const {
  return catalog_.behaviors[behavior_id(catalog_, name)].catalog_index;
}

std::vector<Availability> Stage::availabilities_of(const Situation& situation) const {
  std::vector<Availability> entries;
  for (const auto& [name, available] : situation) {
    Availability entry;
    entry.behavior = behavior_index(name);
    entry.available = available;
    entries.push_back(entry);
  }
  return entries;
}

}  // namespace cbc::test
