#include "report/event_json.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "compile/numbers.h"
#include "compiled/compiled_file.h"
#include "report/sentences.h"
#include "report/solve_report.h"
#include "support/json.h"

namespace cbc {
namespace {

void write_reason(JsonWriter& json, const CompiledCatalog& catalog, const EventRecord& record,
                  const Reason& reason) {
  json.open('{');
  json.write_text("kind", name_of(reason.kind));
  if (reason.behavior != none) {
    json.write_text("behavior", catalog.name_of_behavior(reason.behavior));
  }
  if (reason.other_task != none) {
    json.open("tasks", '[');
    json.write_text(catalog.name_of_task(reason.task));
    json.write_text(catalog.name_of_task(reason.other_task));
    json.close(']');
  } else if (reason.task != none) {
    json.write_text("task", catalog.name_of_task(reason.task));
  }
  if (reason.kind == Reason::Kind::priority || reason.kind == Reason::Kind::is_protected) {
    json.write_integer("priority", reason.priority);
  }
  if (reason.line != 0) json.write_integer("line", reason.line);
  json.write_text("message", describe_reason(catalog, record, reason));
  json.close('}');
}

}  // namespace

std::string reasons_to_json(const CompiledCatalog& catalog, const EventRecord& record,
                            std::span<const Reason> reasons) {
  std::string text;
  JsonWriter json(text);
  json.open('[');
  for (const Reason& reason : reasons) write_reason(json, catalog, record, reason);
  json.close(']');
  return text;
}

namespace {

using Json = nlohmann::ordered_json;

Json behavior_to_json(const CompiledCatalog& catalog, BehaviorId behavior) {
  return behavior == none ? Json(nullptr) : Json(catalog.name_of_behavior(behavior));
}

Json value_to_json(const CompiledCatalog& catalog, TaskId task, std::uint32_t place) {
  return behavior_to_json(catalog, place == none ? none : catalog.values[task][place].behavior);
}

/// The running tasks of the group, in catalog order, and the objectives.
Json configuration_to_json(const CompiledCatalog& catalog, const EventRecord& record,
                           const Configuration& configuration, const State& state) {
  const std::uint32_t group = record.search->group;
  const TaskId first = catalog.group_tasks[group];
  Json running = Json::object();
  for (std::uint32_t task = 0; task < configuration.assignment.size(); ++task) {
    const std::uint32_t place = configuration.assignment[task];
    if (place == none) continue;
    running[std::string(catalog.name_of_task(first + task))] =
        value_to_json(catalog, first + task, place);
  }
  const ObjectiveValues& objective = configuration.objective;
  return {{"running", std::move(running)},
          {"objective",
           {{"satisfied", objective.satisfied},
            {"requests", objective.requests},
            {"suitability", total_suitability(catalog, state, group, configuration.assignment)},
            {"idle", idle_share(objective)},
            {"changes", objective.changes}}}};
}

std::string idle_fraction(const ObjectiveValues& objective) {
  return std::to_string(objective.idle_total - objective.idle_running) + "/" +
         std::to_string(objective.idle_total);
}

Json loss_to_json(const CompiledCatalog& catalog, const EventRecord& record, const WhyNot& why_not,
                  const State& state) {
  const std::uint32_t group = record.search->group;
  const Configuration& chosen = record.explanation.chosen;
  const Configuration& other = *why_not.alternative;
  const Difference& difference = why_not.difference;
  Json json = {{"objective", name_of(difference.criterion)}};
  const auto add = [&](const Json& ours, const Json& theirs) {
    json["chosen"] = ours;
    json["alternative"] = theirs;
  };
  switch (difference.criterion) {
    case Criterion::requests:
      add(chosen.objective.satisfied, other.objective.satisfied);
      break;
    case Criterion::request_order:
      add(catalog.name_of_task(difference.task), catalog.name_of_task(difference.other_task));
      break;
    case Criterion::suitability:
      add(exact_suitability(catalog, state, group, chosen.assignment),
          exact_suitability(catalog, state, group, other.assignment));
      break;
    case Criterion::idle:
      add(idle_fraction(chosen.objective), idle_fraction(other.objective));
      break;
    case Criterion::changes:
      add(chosen.objective.changes, other.objective.changes);
      break;
    case Criterion::canonical: {
      const std::uint32_t task = difference.task - catalog.group_tasks[group];
      json["task"] = catalog.name_of_task(difference.task);
      add(value_to_json(catalog, difference.task, chosen.assignment[task]),
          value_to_json(catalog, difference.task, other.assignment[task]));
      break;
    }
  }
  return json;
}

/// In one text.
std::string message_of(const Sentences& sentences) {
  std::string text = sentences.first;
  for (std::size_t place = 0; place < sentences.more.size(); ++place) {
    text += (place == 0 ? " " : "; ") + sentences.more[place];
  }
  return text;
}

}  // namespace

Json why_to_json(const CompiledCatalog& catalog, const EventRecord& record, const State& state) {
  Json list = Json::array();
  for (const Why& why : record.explanation.why) {
    Json& entry = list.emplace_back(Json::object());
    if (why.behavior != none) {
      entry["behavior"] = catalog.name_of_behavior(why.behavior);
      entry["active"] = why.is_active;
    } else {
      entry["task"] = catalog.name_of_task(why.task);
      entry["chosen"] = behavior_to_json(catalog, why.chosen);
    }
    const WhyNot& why_not = why.why_not;
    entry["limit_reached"] = why_not.is_cut;
    entry["alternative"] = why_not.alternative
                               ? configuration_to_json(catalog, record, *why_not.alternative, state)
                               : Json(nullptr);
    entry["loses"] =
        why_not.alternative ? loss_to_json(catalog, record, why_not, state) : Json(nullptr);
    entry["conflict"] = Json::parse(reasons_to_json(catalog, record, why_not.conflict));
    entry["message"] = message_of(describe_why(catalog, record, why, state));
  }
  return list;
}

Json alternatives_to_json(const CompiledCatalog& catalog, const EventRecord& record,
                          const State& state) {
  Json list = Json::array();
  for (const Configuration& configuration : record.explanation.alternatives) {
    list.push_back(configuration_to_json(catalog, record, configuration, state));
  }
  return {{"limit_reached", record.explanation.is_list_cut}, {"configurations", std::move(list)}};
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
    json_.write_text("outcome", name_of(record_.outcome));
    write_changes();
    write_stopped();
    write_state();
    write_objective();
    write_search();
    json_.write_json("conflict", reasons_to_json(catalog_, record_, record_.conflict));
    if (adds.why) json_.write_json("why", to_text(why_to_json(catalog_, record_, state_)));
    if (adds.alternatives) {
      json_.write_json("alternatives", to_text(alternatives_to_json(catalog_, record_, state_)));
    }
    json_.close('}');
  }

 private:
  void write_what_happened(const Step* step) {
    json_.write_integer("index", record_.index);
    json_.write_seconds("time", record_.time);
    json_.write_text("origin", name_of(record_.origin));
    json_.write_text("verb", name_of(record_.verb));
    if (record_.task != none) {
      json_.write_text("name", catalog_.name_of_task(record_.task));
      json_.write_integer("priority", record_.priority);
    }
    if (record_.behavior != none)
      json_.write_text("name", catalog_.name_of_behavior(record_.behavior));
    if (record_.verb == Verb::finish) json_.write_text("cause", name_of(record_.cause));
    if (step == nullptr) return;
    if (step->parameters) {
      json_.write_json("parameters", step->parameters->json);
    }
    if (record_.verb == Verb::situation) write_situation(step->situation);
  }

  void write_situation(const std::vector<Availability>& situation) {
    json_.open("situation", '{');
    for (const Availability& entry : situation) {
      json_.write_truth(catalog_.behavior_names[entry.behavior], entry.available);
    }
    json_.close('}');
  }

  void write_changes() {
    json_.open("changes", '[');
    for (const Change& change : record_.changes) {
      json_.open('{');
      json_.write_text("op", change.is_activation ? "activate" : "deactivate");
      json_.write_text("behavior", catalog_.name_of_behavior(change.behavior));
      write_tasks(record_.tasks_of(change));
      json_.write_text("cause", name_of(change.cause));
      if (change.priority) {
        json_.write_integer("priority", *change.priority);
      } else {
        json_.write_null("priority");
      }
      json_.write_truth("success", change.success);
      json_.close('}');
    }
    json_.close(']');
  }

  void write_tasks(std::span<const TaskId> tasks) {
    json_.open("tasks", '[');
    for (const TaskId task : tasks) {
      json_.write_text(catalog_.name_of_task(task));
    }
    json_.close(']');
  }

  void write_stopped() {
    json_.open("stopped_tasks", '[');
    for (const StoppedTask& entry : record_.stopped_tasks) {
      json_.open('{');
      json_.write_text("task", catalog_.name_of_task(entry.task));
      json_.write_text("cause", name_of(entry.cause));
      json_.close('}');
    }
    json_.close(']');
  }

  void write_state() {
    const std::vector<std::uint32_t> running = state_.running();
    json_.open("running", '{');
    for (const std::uint32_t index : running) {
      json_.write_text(catalog_.task_names[index],
                       catalog_.name_of_behavior(state_.behavior(catalog_.task_ids[index])));
    }
    json_.close('}');
    json_.open("requests", '{');
    for (const std::uint32_t index : running) {
      const TaskId task = catalog_.task_ids[index];
      if (!state_.has_request(task)) continue;
      json_.write_integer(catalog_.task_names[index], state_.request(task).priority);
    }
    json_.close('}');
    std::vector<std::pair<std::uint32_t, Microseconds>> due;
    for (const auto& [time, index] : state_.queue().entries()) due.emplace_back(index, time);
    std::sort(due.begin(), due.end());
    json_.open("queue", '{');
    for (const auto& [index, time] : due) {
      json_.write_seconds(catalog_.task_names[index], time);
    }
    json_.close('}');
  }

  void write_objective() {
    if (!record_.objective) return json_.write_null("objective");
    const ObjectiveValues& objective = *record_.objective;
    json_.open("objective", '{');
    json_.write_integer("satisfied", objective.satisfied);
    json_.write_integer("requests", objective.requests);
    json_.write_number("suitability", total_suitability(catalog_, state_));
    json_.write_number("idle", idle_share(objective));
    json_.write_integer("changes", objective.changes);
    json_.close('}');
  }

  void write_search() {
    if (record_.search == nullptr) return json_.write_null("search");
    const SearchRecord& search = *record_.search;
    json_.open("search", '{');
    json_.write_text("status", name_of(search.result.status));
    json_.write_integer("group", search.group);
    json_.write_text("space", search_space(search.domain_sizes));
    json_.write_integer("protection", search.protection);
    json_.write_integer("solutions", search.result.solutions);
    json_.write_integer("nodes", search.result.nodes);
    if (search.elapsed) {
      json_.write_integer("propagations", search.result.propagations);
      json_.write_number("elapsed_us",
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

std::string stream_header(const CompiledCatalog& catalog, std::string_view catalog_name,
                          Microseconds reactive_delay, std::span<const Availability> situation) {
  std::string text = R"({"schema":"cbc.events/1","catalog":)";
  append_text(text, catalog_name);
  text += R"(,"digest":)";
  append_text(text, to_hex(identity_of(catalog)));
  text += R"(,"reactive_delay":)";
  append_seconds(text, reactive_delay);
  text += R"(,"situation":{)";
  for (const Availability& entry : situation) {
    if (text.back() != '{') text += ',';
    append_text(text, catalog.behavior_names[entry.behavior]);
    text += entry.available ? ":true" : ":false";
  }
  return text += "}}\n";
}

std::string stream_error(std::string_view message, std::uint64_t line) {
  std::string text = R"({"error":)";
  append_text(text, message);
  text += R"(,"line":)";
  append_integer(text, line);
  return text += "}\n";
}

std::string stream_totals(const SearchTotals& totals) {
  return R"({"totals":)" + to_text(stats_to_json(totals)) + R"(,"process":)" +
         to_text(usage_to_json(process_usage())) + "}\n";
}

void EventStream::on_event(const EventRecord& record, const Step* step, const State& state) {
  line_.clear();
  append_event(line_, catalog_, record, step, state, adds_);
  line_ += '\n';
  take_line_(line_);
}

}  // namespace cbc
