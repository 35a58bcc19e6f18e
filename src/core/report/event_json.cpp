#include "core/report/event_json.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/compile/compile.h"
#include "core/report/answer_bound.h"
#include "core/report/event_words.h"
#include "core/report/explanation_words.h"
#include "core/report/layout.h"
#include "core/report/reason_words.h"
#include "core/report/search_stats.h"
#include "core/report/suitability.h"
#include "core/script/event_lines.h"
#include "core/support/json.h"
#include "runtime/compiled/compiled_file.h"

namespace cbc {
void write_reason(JsonWriter& json, const CompiledCatalog& catalog, const EventRecord& record,
                  const Reason& reason) {
  json.open('{');
  json.write("kind", name_of(reason.kind));
  if (reason.behavior != none) {
    json.write("behavior", catalog.name_of_behavior(reason.behavior));
  }
  if (reason.other_task != none) {
    json.write_list("tasks", std::array{reason.task, reason.other_task},
                    [&](TaskId task) { json.write(catalog.name_of_task(task)); });
  } else if (reason.task != none) {
    json.write("task", catalog.name_of_task(reason.task));
  }
  if (reason.kind == Reason::Kind::priority || reason.kind == Reason::Kind::is_protected) {
    json.write("priority", reason.priority);
  }
  if (reason.line != 0) json.write("line", reason.line);
  if (!reason.best.empty()) {
    json.write_list("best", reason.best, [&](ValueId id) {
      const Value& value = catalog.values.items[id];
      json.write_object({{"task", catalog.name_of_task(catalog.task_of(id))},
                         {"behavior", catalog.name_of_behavior(value.behavior)},
                         {"suitability", in_percent(value.suitability)}});
    });
  }
  json.write("message", describe_reason(catalog, record, reason));
  json.close('}');
}

namespace {

/// A set of reasons, as a member. `tasks`: those in question.
void write_conflict(JsonWriter& json, const CompiledCatalog& catalog, const EventRecord& record,
                    std::span<const Reason> reasons, std::span<const TaskId> tasks) {
  std::vector<TaskId> roots(tasks.begin(), tasks.end());
  if (record.task != none) roots.push_back(record.task);
  json.write_list("conflict", order_reasons(catalog, reasons, roots),
                  [&](const Reason* reason) { write_reason(json, catalog, record, *reason); });
}

std::optional<std::string_view> name_of_value(const CompiledCatalog& catalog, TaskId task,
                                              std::uint32_t value_index) {
  if (value_index == none) return std::nullopt;
  return catalog.name_of_behavior(catalog.values[task][value_index].behavior);
}

void write_objective(JsonWriter& json, const ObjectiveValues& objective, double suitability) {
  json.open("objective", '{');
  json.write("satisfied", objective.satisfied);
  json.write("requests", objective.requests);
  json.write("suitability", suitability);
  json.write("idle", idle_share(objective));
  json.write("changes", objective.changes);
  json.close('}');
}

/// The running tasks of the group, in catalog order, and the objectives.
void write_configuration(JsonWriter& json, const CompiledCatalog& catalog,
                         const EventRecord& record, const Configuration& configuration,
                         const State& state) {
  const std::uint32_t group = record.search->group;
  const TaskId first = catalog.group_tasks[group];
  json.open('{');
  json.open("running", '{');
  for (std::uint32_t task = 0; task < configuration.assignment.size(); ++task) {
    const auto behavior = name_of_value(catalog, first + task, configuration.assignment[task]);
    if (behavior) json.write(catalog.name_of_task(first + task), *behavior);
  }
  json.close('}');
  write_objective(json, configuration.objective,
                  total_suitability(catalog, state, group, configuration.assignment));
  json.close('}');
}

std::string idle_fraction(const ObjectiveValues& objective) {
  return std::to_string(objective.idle_total - objective.idle_running) + "/" +
         std::to_string(objective.idle_total);
}

/// The member "differences": the tasks of the group with another value in the alternative.
void write_differences(JsonWriter& json, const CompiledCatalog& catalog, const EventRecord& record,
                       const WhyNot& why_not) {
  const std::uint32_t group = record.search->group;
  const TaskId first = catalog.group_tasks[group];
  const auto write = [&](std::string_view name, TaskId task, const Assignment& assignment) {
    const std::uint32_t index = assignment[task - first];
    if (index == none) return json.write(name, nullptr);
    const Value& value = catalog.values[task][index];
    json.write_object(name, {{"behavior", catalog.name_of_behavior(value.behavior)},
                             {"suitability", in_percent(value.suitability)}});
  };
  json.open("differences", '[');
  if (why_not.alternative) {
    const Assignment& chosen = record.explanation.chosen.assignment;
    const Assignment& other = why_not.alternative->assignment;
    for (const TaskId task : differing_tasks(catalog, group, chosen, other)) {
      json.open('{');
      json.write("task", catalog.name_of_task(task));
      write("chosen", task, chosen);
      write("alternative", task, other);
      json.close('}');
    }
  }
  json.close(']');
}

void write_loss(JsonWriter& json, const CompiledCatalog& catalog, const EventRecord& record,
                const WhyNot& why_not, const State& state) {
  const std::uint32_t group = record.search->group;
  const Configuration& chosen = record.explanation.chosen;
  const Configuration& other = *why_not.alternative;
  const Difference& difference = why_not.difference;
  const auto write = [&](const auto& ours, const auto& theirs) {
    json.write_members({{"chosen", ours}, {"alternative", theirs}});
  };
  json.open("loses", '{');
  json.write("objective", name_of(difference.criterion));
  switch (difference.criterion) {
    case Criterion::requests:
      write(chosen.objective.satisfied, other.objective.satisfied);
      break;
    case Criterion::request_order:
      write(catalog.name_of_task(difference.task), catalog.name_of_task(difference.other_task));
      break;
    case Criterion::suitability:
      write(exact_suitability(catalog, state, group, chosen.assignment),
            exact_suitability(catalog, state, group, other.assignment));
      break;
    case Criterion::idle:
      write(idle_fraction(chosen.objective), idle_fraction(other.objective));
      break;
    case Criterion::changes:
      write(chosen.objective.changes, other.objective.changes);
      break;
    case Criterion::canonical: {
      const std::uint32_t task = difference.task - catalog.group_tasks[group];
      json.write("task", catalog.name_of_task(difference.task));
      write(name_of_value(catalog, difference.task, chosen.assignment[task]),
            name_of_value(catalog, difference.task, other.assignment[task]));
      break;
    }
  }
  json.close('}');
}

/// The sentences as one text.
std::string message_of(const Sentences& sentences) {
  std::string text = sentences.first;
  for (std::size_t place = 0; place < sentences.more.size(); ++place) {
    text += place == 0 ? " " : "; ";
    text += without_indentation(sentences.more[place]);
  }
  return text;
}

/// What was not chosen, and where it is worse.
void write_why_not(JsonWriter& json, const CompiledCatalog& catalog, const EventRecord& record,
                   const WhyNot& why_not, const State& state) {
  json.write("limit_reached", why_not.is_cut);
  if (why_not.alternative) {
    json.key("alternative");
    write_configuration(json, catalog, record, *why_not.alternative, state);
    write_loss(json, catalog, record, why_not, state);
  } else {
    json.write("alternative", nullptr);
    json.write("loses", nullptr);
  }
  write_differences(json, catalog, record, why_not);
}

void write_why(JsonWriter& json, const CompiledCatalog& catalog, const EventRecord& record,
               const Why& why, const State& state) {
  const WhyNot& why_not = why.why_not;
  json.open('{');
  if (why.behavior != none) {
    json.write("behavior", catalog.name_of_behavior(why.behavior));
    json.write("active", why.is_active);
  } else {
    json.write("task", catalog.name_of_task(why.task));
    json.write("chosen", why.chosen == none ? std::nullopt
                                            : std::optional(catalog.name_of_behavior(why.chosen)));
  }
  if (why.due) json.write_seconds("due", *why.due);
  write_why_not(json, catalog, record, why_not, state);
  write_conflict(json, catalog, record, why_not.conflict, tasks_of(catalog, why));
  json.write("message", message_of(describe_why(catalog, record, why, state)));
  json.close('}');
}

}  // namespace

void write_running(JsonWriter& json, const CompiledCatalog& catalog, const State& state) {
  const std::vector<std::uint32_t> running = state.running();
  json.open("running", '{');
  for (const std::uint32_t index : running) {
    json.write(catalog.task_names[index],
               catalog.name_of_behavior(state.behavior(catalog.task_ids[index])));
  }
  json.close('}');
  json.open("requests", '{');
  for (const std::uint32_t index : running) {
    const TaskId task = catalog.task_ids[index];
    if (!state.has_request(task)) continue;
    json.write(catalog.task_names[index], state.request(task).priority);
  }
  json.close('}');
  json.open("queue", '{');
  for (const auto& [index, time] : queue_of(catalog, state)) {
    if (time) {
      json.write_seconds(catalog.task_names[index], *time);
    } else {
      json.write(catalog.task_names[index], nullptr);
    }
  }
  json.close('}');
}

namespace {

class EventText {
 public:
  EventText(std::string& text, const CompiledCatalog& catalog, const EventRecord& record,
            const State& state)
      : json_(text), catalog_(catalog), record_(record), state_(state) {}

  void write(const Step* step, const EventAdditions& adds) && {
    json_.open('{');
    write_what_happened(step);
    json_.write("outcome", name_of(record_.outcome));
    if (adds.note) {
      const std::string note = describe_note(catalog_, record_, state_);
      if (!note.empty()) json_.write("note", note);
    }
    write_changes();
    write_stopped();
    write_running(json_, catalog_, state_);
    write_objective();
    write_search();
    write_conflict(json_, catalog_, record_, record_.conflict, {});
    if (adds.why) {
      json_.write_list("why", record_.explanation.why,
                       [&](const Why& why) { write_why(json_, catalog_, record_, why, state_); });
    }
    if (adds.alternatives) write_alternatives();
    json_.close('}');
  }

 private:
  void write_alternatives() {
    json_.open("alternatives", '{');
    json_.write("limit_reached", record_.explanation.is_list_cut);
    json_.write_list("configurations", record_.explanation.alternatives,
                     [&](const Configuration& configuration) {
                       write_configuration(json_, catalog_, record_, configuration, state_);
                     });
    json_.close('}');
  }

  void write_what_happened(const Step* step) {
    json_.write("index", record_.index);
    json_.write_seconds("time", record_.time);
    json_.write("origin", name_of(record_.origin));
    json_.write("verb", name_of(record_.verb));
    const VerbForm& form = form_of(record_.verb);
    if (record_.verb == Verb::finish && record_.task != none) {
      json_.write("task", catalog_.name_of_task(record_.task));
      if (record_.behavior == none) json_.write("name", nullptr);
    } else if (record_.task != none) {
      json_.write("name", catalog_.name_of_task(record_.task));
    }
    if (form.has_priority) json_.write("priority", record_.priority);
    if (record_.behavior != none) json_.write("name", catalog_.name_of_behavior(record_.behavior));
    if (form.has_cause) json_.write("cause", name_of(record_.cause));
    if (step == nullptr) return;
    if (step->parameters) {
      json_.write_json("parameters", step->parameters->json);
    }
    if (record_.verb != Verb::situation) return;
    write_situation(json_, catalog_, step->situation);
    if (!catalog_.variables.empty()) {
      write_variables(json_, catalog_, "variables", state_.variables());
    }
  }

  void write_changes() {
    json_.write_list("changes", record_.changes, [&](const Change& change) {
      json_.open('{');
      json_.write("op", change.is_activation ? "activate" : "deactivate");
      json_.write("behavior", catalog_.name_of_behavior(change.behavior));
      json_.write_list("tasks", record_.tasks_of(change),
                       [&](TaskId task) { json_.write(catalog_.name_of_task(task)); });
      json_.write("cause", name_of(change.cause));
      json_.write("priority", change.priority);
      json_.write("success", change.success);
      json_.close('}');
    });
  }

  void write_stopped() {
    json_.write_list("stopped_tasks", record_.stopped_tasks, [&](const StoppedTask& entry) {
      json_.open('{');
      json_.write("task", catalog_.name_of_task(entry.task));
      json_.write("cause", name_of(entry.cause));
      json_.close('}');
    });
  }

  void write_objective() {
    if (!record_.objective) return json_.write("objective", nullptr);
    cbc::write_objective(json_, *record_.objective, total_suitability(catalog_, state_));
  }

  void write_search() {
    if (record_.search == nullptr) return json_.write("search", nullptr);
    const SearchRecord& search = *record_.search;
    json_.open("search", '{');
    json_.write("status", name_of(search.result.status));
    json_.write("group", search.group);
    json_.write("space", search_space(search.domain_sizes));
    json_.write("protection", search.protection);
    json_.write("solutions", search.result.solutions);
    json_.write("nodes", search.result.nodes);
    if (search.result.status == SearchStatus::feasible) {
      const AnswerBound bound = bound_of_answer(catalog_, record_, state_);
      json_.write_object("bound",
                         {{"satisfied", bound.satisfied}, {"suitability", bound.suitability}});
    }
    if (search.elapsed) {
      json_.write("propagations", search.result.propagations);
      json_.write("elapsed_us",
                  to_microseconds(static_cast<std::uint64_t>(search.elapsed->count())));
    }
    json_.close('}');
  }

  JsonWriter json_;
  const CompiledCatalog& catalog_;
  const EventRecord& record_;
  const State& state_;
};

}  // namespace

void append_event(std::string& text, const CompiledCatalog& catalog, const EventRecord& record,
                  const Step* step, const State& state, const EventAdditions& adds) {
  EventText(text, catalog, record, state).write(step, adds);
}

void write_unexpected(JsonWriter& json, const CompiledCatalog& catalog,
                      const UnexpectedTasks& unexpected, const State& state) {
  const WhyUnmet& why_unmet = unexpected.why_unmet;
  json.open('{');
  json.write("event",
             why_unmet.event == nullptr ? std::nullopt : std::optional(why_unmet.event->index));
  json.write_list("tasks", unexpected.tasks,
                  [&](TaskId task) { json.write(catalog.name_of_task(task)); });
  if (why_unmet.kind == WhyUnmet::Kind::due) json.write_seconds("due", why_unmet.due);
  if (why_unmet.kind == WhyUnmet::Kind::decided) {
    write_why_not(json, catalog, *why_unmet.event, why_unmet.why_not, *why_unmet.before);
    write_conflict(json, catalog, *why_unmet.event, why_unmet.why_not.conflict, unexpected.tasks);
  } else {
    json.write_members({{"limit_reached", false}, {"alternative", nullptr}, {"loses", nullptr}});
    json.write_list("differences", std::span<const TaskId>(), [](TaskId) {});
    const bool is_rejected = why_unmet.kind == WhyUnmet::Kind::rejected;
    const EventRecord nothing{};
    const EventRecord& event = is_rejected ? *why_unmet.event : nothing;
    write_conflict(json, catalog, event, event.conflict, {});
  }
  const std::vector<std::string> notes = notes_of(catalog, unexpected, state);
  if (!notes.empty()) json.write_list("notes", notes);
  json.write("message", message_of(describe_unexpected(catalog, unexpected, state)));
  json.close('}');
}

std::string stream_header(const CompiledCatalog& catalog, std::string_view catalog_name,
                          const CoordinatorOptions& options, const Situation& situation,
                          std::span<const std::uint32_t> variables, std::string_view clock) {
  return json_line([&](JsonWriter& json) {
    json.write_members({{"schema", events_schema},
                        {"catalog", catalog_name},
                        {"digest", to_hex(identity_of(catalog))}});
    json.write_seconds("reactive_delay", options.reactive_delay);
    // Logs of older versions, without these members, can be replayed.
    if (!options.timeouts) json.write("timeouts", false);
    if (!clock.empty()) json.write("clock", clock);
    write_situation(json, catalog, situation);
    if (!catalog.variables.empty()) {
      write_variables(json, catalog, "variables", variables);
    }
  });
}

std::string stream_error(std::string_view message, std::uint64_t line) {
  return json_line([&](JsonWriter& json) {
    json.write_members({{"error", message}, {"line", line}});
  });
}

std::string stream_totals(const SearchTotals& totals) {
  return json_line([&](JsonWriter& json) {
    write_totals(json, totals);
    write_process(json, process_usage());
  });
}

void EventStream::on_event(const EventRecord& record, const Step* step, const State& state) {
  line_.clear();
  append_event(line_, catalog_, record, step, state, adds_);
  line_ += '\n';
  take_line_({line_, record, state});
}

}  // namespace cbc
