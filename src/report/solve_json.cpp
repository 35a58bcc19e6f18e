#include "report/solve_json.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "compiled/search_space.h"
#include "report/exact_values.h"
#include "report/explanation_json.h"
#include "report/json_text.h"
#include "report/reasons.h"

namespace cbc {
namespace {

using Json = nlohmann::ordered_json;

Json tasks_to_json(const CompiledCatalog& catalog, std::span<const TaskId> tasks) {
  Json names = Json::array();
  for (const TaskId task : tasks) names.push_back(catalog.name_of_task(task));
  return names;
}

void add_what_happened(Json& json, const CompiledCatalog& catalog, const EventRecord& record,
                       const Step* step) {
  json["index"] = record.index;
  json["time"] = to_seconds(record.time);
  json["origin"] = name_of(record.origin);
  json["verb"] = name_of(record.verb);
  if (record.task != none) {
    json["name"] = catalog.name_of_task(record.task);
    json["priority"] = record.priority;
  }
  if (record.behavior != none) json["name"] = catalog.name_of_behavior(record.behavior);
  if (record.verb == Verb::finish) json["cause"] = name_of(record.cause);
  if (step == nullptr) return;
  if (step->parameters) json["parameters"] = Json::parse(step->parameters->json);
  if (record.verb == Verb::situation) {
    Json& situation = json["situation"] = Json::object();
    for (const Availability& entry : step->situation) {
      situation[catalog.behavior_names[entry.behavior]] = entry.available;
    }
  }
}

Json changes_to_json(const CompiledCatalog& catalog, const EventRecord& record) {
  Json list = Json::array();
  for (const Change& change : record.changes) {
    Json& entry = list.emplace_back(Json::object());
    entry["op"] = change.is_activation ? "activate" : "deactivate";
    entry["behavior"] = catalog.name_of_behavior(change.behavior);
    entry["tasks"] = tasks_to_json(catalog, record.tasks_of(change));
    entry["cause"] = name_of(change.cause);
    entry["priority"] = change.priority ? Json(*change.priority) : Json(nullptr);
    entry["success"] = change.success;
  }
  return list;
}

Json stopped_to_json(const CompiledCatalog& catalog, const std::vector<StoppedTask>& stopped) {
  Json list = Json::array();
  for (const StoppedTask& entry : stopped) {
    list.push_back({{"task", catalog.name_of_task(entry.task)}, {"cause", name_of(entry.cause)}});
  }
  return list;
}

/// Appends a member whose name is known to be new: the look-up of operator[] is linear.
template <typename Value>
void append(Json& object, std::string_view name, const Value& value) {
  object.get_ref<Json::object_t&>().emplace_back(name, value);
}

void add_state(Json& json, const CompiledCatalog& catalog, const State& state) {
  Json running = Json::object();
  Json requests = Json::object();
  for (const std::uint32_t index : state.running()) {
    const TaskId task = catalog.task_ids[index];
    const std::string_view name = catalog.task_names[index];
    append(running, name, catalog.name_of_behavior(state.behavior(task)));
    if (state.has_request(task)) append(requests, name, state.request(task).priority);
  }
  Json queue = Json::object();
  std::vector<std::pair<std::uint32_t, Microseconds>> due;
  for (const auto& [time, index] : state.queue().entries()) due.emplace_back(index, time);
  std::sort(due.begin(), due.end());
  for (const auto& [index, time] : due) append(queue, catalog.task_names[index], to_seconds(time));
  json["running"] = std::move(running);
  json["requests"] = std::move(requests);
  json["queue"] = std::move(queue);
}

Json objective_to_json(const CompiledCatalog& catalog, const ObjectiveValues& objective,
                       const State& state) {
  return {{"satisfied", objective.satisfied},
          {"requests", objective.requests},
          {"suitability", total_suitability(catalog, state)},
          {"idle", idle_share(objective)},
          {"changes", objective.changes}};
}

Json search_to_json(const SearchRecord& search) {
  return {{"status", name_of(search.result.status)},    {"group", search.group},
          {"space", search_space(search.domain_sizes)}, {"protection", search.protection},
          {"solutions", search.result.solutions},       {"nodes", search.result.nodes}};
}

}  // namespace

Json reasons_to_json(const CompiledCatalog& catalog, const EventRecord& record,
                     std::span<const Reason> reasons) {
  Json list = Json::array();
  for (const Reason& reason : reasons) {
    Json& entry = list.emplace_back(Json::object());
    entry["kind"] = name_of(reason.kind);
    if (reason.behavior != none) entry["behavior"] = catalog.name_of_behavior(reason.behavior);
    if (reason.other_task != none) {
      entry["tasks"] = tasks_to_json(catalog, std::array{reason.task, reason.other_task});
    } else if (reason.task != none) {
      entry["task"] = catalog.name_of_task(reason.task);
    }
    if (reason.kind == Reason::Kind::priority || reason.kind == Reason::Kind::is_protected) {
      entry["priority"] = reason.priority;
    }
    if (reason.line != 0) entry["line"] = reason.line;
    entry["message"] = describe_reason(catalog, record, reason);
  }
  return list;
}

Json event_to_json(const CompiledCatalog& catalog, const EventRecord& record, const Step* step,
                   const State& state) {
  Json json;
  add_what_happened(json, catalog, record, step);
  json["outcome"] = name_of(record.outcome);
  json["changes"] = changes_to_json(catalog, record);
  json["stopped_tasks"] = stopped_to_json(catalog, record.stopped_tasks);
  add_state(json, catalog, state);
  json["objective"] =
      record.objective ? objective_to_json(catalog, *record.objective, state) : Json(nullptr);
  json["search"] = record.search ? search_to_json(*record.search) : Json(nullptr);
  json["conflict"] = reasons_to_json(catalog, record, record.conflict);
  return json;
}

JsonReport::JsonReport(std::FILE* out, const JsonAdditions& adds) : out_(out), adds_(adds) {
  write(R"({"schema":"cbc.solve/1","runs":[)");
}

void JsonReport::begin_run(const CompiledCatalog& catalog, const Script& script) {
  catalog_ = &catalog;
  begin_item(is_first_run_, "\n");
  write(R"({"catalog":)" + to_text(catalog.file) + R"(,"script":)" + to_text(script.file) +
        R"(,"events":[)");
  is_first_event_ = true;
  failures_ = Json::array();
}

void JsonReport::on_event(const EventRecord& record, const Step* step, const State& state) {
  begin_item(is_first_event_, "\n ");
  Json event = event_to_json(*catalog_, record, step, state);
  if (adds_.why) event["why"] = why_to_json(*catalog_, record, state);
  if (adds_.alternatives) event["alternatives"] = alternatives_to_json(*catalog_, record, state);
  write(to_text(event));
}

void JsonReport::on_failure(const Failure& failure) {
  failures_.push_back(
      {{"index", failure.index}, {"line", failure.range.begin.line}, {"message", failure.message}});
}

void JsonReport::end_run(const RunResult& result, const std::string& error) {
  const Json expectations = {
      {"passed", result.passed}, {"failed", result.failed}, {"failures", failures_}};
  write(R"(],"expectations":)" + to_text(expectations));
  if (!error.empty()) write(R"(,"error":)" + to_text(error));
  write("}");
}

void JsonReport::end() { write("]}\n"); }

void JsonReport::write(const std::string& text) { std::fwrite(text.data(), 1, text.size(), out_); }

void JsonReport::begin_item(bool& is_first, const char* indent) {
  if (!is_first) write(",");
  is_first = false;
  write(indent);
}

}  // namespace cbc
