#include "report/event_json.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "compiled/search_space.h"
#include "report/exact_values.h"
#include "report/explanation_json.h"
#include "report/reasons_json.h"
#include "report/solve_stats.h"
#include "text/json_writer.h"

namespace cbc {
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

}  // namespace cbc
