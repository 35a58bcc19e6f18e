#include "report/sweep_json.h"

#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "text/json_text.h"

namespace cbc {
namespace {

using Json = nlohmann::ordered_json;

double to_share(Millionths share) { return share / double{one_million}; }

Json options_to_json(const SweepSettings& settings) {
  const SweepSearch& search = settings.search;
  return {{"events", settings.shape.events},
          {"priorities", settings.shape.priorities},
          {"failures", to_share(settings.shape.failures)},
          {"faults", to_share(settings.shape.faults)},
          {"max_solutions", search.max_solutions},
          {"max_nodes", search.max_nodes},
          {"tie_seed", search.tie_seed ? Json(*search.tie_seed) : Json(nullptr)},
          {"max_clock_events", search.max_clock_events}};
}

std::vector<Json> events_to_json(const SweepCounts& counts) {
  std::vector<Json> items;
  for (std::size_t kind = 0; kind < sweep_kinds; ++kind) {
    const OutcomeCounts& of_kind = counts.events[kind];
    items.push_back({{"kind", name_of(static_cast<SweepKind>(kind))},
                     {"accepted", of_kind.accepted},
                     {"escalated", of_kind.escalated},
                     {"rejected", of_kind.rejected},
                     {"unchanged", of_kind.unchanged}});
  }
  return items;
}

std::vector<Json> tasks_to_json(const SweepResult& result) {
  std::vector<Json> items;
  for (std::size_t task = 0; task < result.task_names.size(); ++task) {
    const TaskCounts& counts = result.counts.tasks[task];
    items.push_back({{"task", result.task_names[task]},
                     {"started", counts.starts},
                     {"rejected", counts.rejected},
                     {"runs", counts.runs}});
  }
  return items;
}

std::vector<Json> behaviors_to_json(const SweepResult& result) {
  std::vector<Json> items;
  for (std::size_t behavior = 0; behavior < result.behavior_names.size(); ++behavior) {
    const BehaviorCounts& counts = result.counts.behaviors[behavior];
    items.push_back({{"behavior", result.behavior_names[behavior]},
                     {"activations", counts.activations},
                     {"failures", counts.failures}});
  }
  return items;
}

std::vector<Json> reasons_to_json(const SweepResult& result) {
  std::vector<Json> items;
  for (const auto& [reason, count] : result.counts.reasons) {
    Json& item = items.emplace_back(Json::object());
    item["kind"] = name_of(reason.kind);
    if (reason.behavior != none) item["behavior"] = result.behavior_names[reason.behavior];
    if (reason.other_task != none) {
      item["tasks"] = {result.task_names[reason.task], result.task_names[reason.other_task]};
    } else if (reason.task != none) {
      item["task"] = result.task_names[reason.task];
    }
    item["count"] = count;
  }
  return items;
}

Json slowest_to_json(const std::optional<SlowestEvent>& slowest, const char* unit) {
  if (!slowest) return nullptr;
  return {{"sequence", slowest->sequence},
          {"event", slowest->event},
          {"what", slowest->what},
          {unit, slowest->cost},
          {"script", slowest->script}};
}

Json histogram_to_json(const Histogram& histogram, const std::optional<SlowestEvent>& slowest) {
  Json counts = Json::array();
  for (const auto& [number, count] : histogram.counts()) counts.push_back({number, count});
  return {{"p50", histogram.median()},
          {"p99", histogram.percentile_99()},
          {"max", slowest ? slowest->cost : 0},
          {"histogram", std::move(counts)}};
}

/// Writes an object with one member on a line.
class Members {
 public:
  void add(const char* name, const Json& value) { add_text(name, to_text(value)); }
  /// An array with one item on a line.
  void add(const char* name, const std::vector<Json>& items) {
    std::string array = "[";
    for (const Json& item : items) append_item(array, to_text(item));
    add_text(name, array + "]");
  }
  [[nodiscard]] std::string take() { return std::move(text_) + "}\n"; }

 private:
  void add_text(const char* name, const std::string& value) {
    text_ += text_.empty() ? "{" : ",\n";
    text_ += to_text(name) + ":" + value;
  }

  std::string text_;
};

}  // namespace

std::string sweep_to_json(const SweepResult& result) {
  Json never_active = Json::array();
  for (std::size_t place = 0; place < result.behavior_names.size(); ++place) {
    if (result.counts.behaviors[place].activations == 0) {
      never_active.push_back(result.behavior_names[place]);
    }
  }
  Json never_ran = Json::array();
  for (std::size_t place = 0; place < result.task_names.size(); ++place) {
    if (result.counts.tasks[place].runs == 0) never_ran.push_back(result.task_names[place]);
  }
  const SweepShard& shard = result.settings.shard;
  Members members;
  members.add("schema", "cbc.sweep/1");
  members.add("catalog", result.catalog);
  members.add("digest", result.digest);
  members.add("version", result.version);
  members.add("sequences", result.settings.sequences);
  members.add("seed", result.settings.seed);
  members.add("options", options_to_json(result.settings));
  members.add("shard", Json{{"index", shard.index}, {"count", shard.count}});
  members.add("events", events_to_json(result.counts));
  members.add("tasks", tasks_to_json(result));
  members.add("behaviors", behaviors_to_json(result));
  members.add("never_ran", never_ran);
  members.add("never_active", never_active);
  members.add("reasons", reasons_to_json(result));
  members.add("nodes", histogram_to_json(result.nodes, result.slowest));
  members.add("slowest", slowest_to_json(result.slowest, "nodes"));
  if (result.times) {
    const SweepTimes& times = *result.times;
    members.add("stats", Json{{"elapsed_us", times.elapsed},
                              {"event_ns", histogram_to_json(times.events, times.slowest)},
                              {"slowest", slowest_to_json(times.slowest, "ns")}});
  }
  return members.take();
}

}  // namespace cbc
