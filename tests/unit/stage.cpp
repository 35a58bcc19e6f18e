#include "unit/stage.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "unit/compiled_fixture.h"

namespace cbc::test {
namespace {

Microseconds microseconds(double seconds) { return std::llround(seconds * second); }

std::string seconds_text(Microseconds time) {
  std::string text = std::to_string(time / second);
  if (time % second == 0) return text;
  const std::string fraction = std::to_string(second + time % second);
  text += "." + fraction.substr(1, fraction.find_last_not_of('0'));
  return text;
}

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

std::string Stage::start(std::string_view task, std::optional<std::int32_t> priority,
                         std::optional<std::string_view> parameters) {
  Event event;
  event.verb = Verb::start;
  event.subject = task_index(task);
  event.priority = priority;
  event.parameters = parameters;
  return handle(event);
}

std::string Stage::stop(std::string_view task, std::optional<std::int32_t> priority) {
  Event event;
  event.verb = Verb::stop;
  event.subject = task_index(task);
  event.priority = priority;
  return handle(event);
}

std::string Stage::finish(std::string_view behavior, FinishCause cause) {
  Event event;
  event.verb = Verb::finish;
  event.subject = behavior_index(behavior);
  event.cause = cause;
  return handle(event);
}

std::string Stage::finish_task(std::string_view task, FinishCause cause) {
  Event event;
  event.verb = Verb::finish;
  event.subject = task_index(task);
  event.is_by_task = true;
  event.cause = cause;
  return handle(event);
}

std::string Stage::set(const Situation& situation) { return set_variables({}, situation); }

std::string Stage::set_variables(
    const std::vector<std::pair<std::string_view, std::string_view>>& variables,
    const Situation& situation) {
  const std::vector<Availability> entries = availabilities_of(situation);
  std::vector<VariableValue> values;
  for (const auto& [name, value] : variables) {
    const std::uint32_t variable = catalog_.find_variable(name).value();
    values.push_back({variable, catalog_.find_value(variable, value).value()});
  }
  Event event;
  event.verb = Verb::situation;
  event.situation = entries;
  event.variables = values;
  return handle(event);
}

std::string Stage::waiting() const {
  std::string text;
  for (const TaskId task : catalog_.task_ids) {
    if (state().is_waiting(task)) append(text, std::string(catalog_.name_of_task(task)), " ");
  }
  return text;
}

std::string Stage::fault(std::string_view behavior) {
  Event event;
  event.verb = Verb::fault;
  event.subject = behavior_index(behavior);
  return handle(event);
}

std::string Stage::repair(std::string_view behavior) {
  Event event;
  event.verb = Verb::repair;
  event.subject = behavior_index(behavior);
  return handle(event);
}

std::string Stage::wait() { return handle({}); }

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
  for (std::string* text : {&outcomes_, &events_, &changes_, &stopped_, &searches_, &objectives_}) {
    text->clear();
  }
}

void Stage::on_event(const EventRecord& record) {
  const bool is_first = outcomes_.empty();
  append(outcomes_, std::string(name_of(record.outcome)), "; ");

  std::string text = record.time > 0 ? seconds_text(record.time) + " " : "";
  if (record.origin != Origin::script) text += std::string(name_of(record.origin)) + " ";
  text += name_of(record.verb);
  if (record.task != none && record.verb == Verb::finish) {
    text += " task " + std::string(catalog_.name_of_task(record.task));
  } else if (record.task != none) {
    text += " " + std::string(catalog_.name_of_task(record.task)) + " " +
            std::to_string(record.priority);
  }
  if (record.behavior != none)
    text += " " + std::string(catalog_.name_of_behavior(record.behavior));
  if (record.verb == Verb::finish) text += " " + std::string(name_of(record.cause));
  if (!record.conflict.empty() && record.conflict.front().kind == Reason::Kind::priority) {
    text += " conflict " + std::string(catalog_.name_of_task(record.conflict.front().task)) + " " +
            std::to_string(record.conflict.front().priority);
  }
  append(events_, text + " " + std::string(name_of(record.outcome)), "; ");

  std::string changes;
  for (const Change& change : record.changes) append(changes, show(record, change), ", ");
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
  std::string objective = "none";
  if (record.objective) {
    objective = std::to_string(record.objective->satisfied) + "/" +
                std::to_string(record.objective->requests) + " idle " +
                std::to_string(record.objective->idle_running) + "/" +
                std::to_string(record.objective->idle_total) + " changes " +
                std::to_string(record.objective->changes);
  }
  append(objectives_, objective, "; ");
}

std::string Stage::show(const EventRecord& record, const Change& change) const {
  std::string text =
      (change.is_activation ? "+" : "-") + std::string(catalog_.name_of_behavior(change.behavior));
  const std::span<const TaskId> tasks = record.tasks_of(change);
  if (tasks.size() != 1 || catalog_.performs[change.behavior].size() != 1) {
    text += "(";
    for (const TaskId task : tasks) {
      text += (text.back() == '(' ? "" : ",") + std::string(catalog_.name_of_task(task));
    }
    text += ")";
  }
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

std::string Stage::requests() const {
  std::string text;
  std::uint32_t count = 0;
  for (std::uint32_t index = 0; index < catalog_.task_names.size(); ++index) {
    const TaskId task = catalog_.task_ids[index];
    if (!state().has_request(task)) continue;
    ++count;
    append(text,
           std::string(catalog_.task_names[index]) + ":" +
               std::to_string(state().request(task).priority),
           " ");
  }
  if (count != state().request_count()) text += " and another count";
  return text;
}

std::string Stage::show(const Timers& timers) const {
  std::vector<std::pair<std::uint32_t, Microseconds>> entries;
  for (const auto& [due, index] : timers.entries()) entries.emplace_back(index, due);
  std::sort(entries.begin(), entries.end());
  std::string text;
  for (const auto& [index, due] : entries) {
    append(text, std::string(catalog_.task_names[index]) + "@" + seconds_text(due), " ");
  }
  return text;
}

std::string Stage::queue() const { return show(state().queue()); }

std::string Stage::timeouts() const { return show(state().timeouts()); }

std::string Stage::active() const {
  std::string text;
  for (std::uint32_t index = 0; index < catalog_.behavior_names.size(); ++index) {
    if (state().is_active(catalog_.behavior_ids[index])) {
      append(text, std::string(catalog_.behavior_names[index]), " ");
    }
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
