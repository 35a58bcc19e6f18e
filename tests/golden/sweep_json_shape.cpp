#include "golden/sweep_json_shape.h"

#include <cstdint>

#include <nlohmann/json.hpp>

namespace cbc::golden {
namespace {

using Json = nlohmann::ordered_json;
using Keys = std::vector<std::string>;

class SweepShapeCheck {
 public:
  [[nodiscard]] Keys run(const Json& sweep) {
    Keys keys{"schema",       "catalog", "digest", "version", "sequences", "seed",
              "options",      "shard",   "events", "tasks",   "behaviors", "never_ran",
              "never_active", "reasons", "nodes",  "slowest"};
    if (sweep.contains("stats")) keys.emplace_back("stats");
    if (!has_keys(sweep, keys, "the sweep")) return faults_;
    has_keys(sweep["options"],
             {"events", "priorities", "failures", "faults", "max_solutions", "max_nodes",
              "tie_seed", "max_clock_events"},
             "options");
    has_keys(sweep["shard"], {"index", "count"}, "shard");
    for (const Json& item : sweep["events"]) {
      has_keys(item, {"kind", "accepted", "escalated", "rejected", "unchanged"}, "events");
    }
    check_unused(sweep, "tasks", {"task", "started", "rejected", "runs"}, "never_ran");
    check_unused(sweep, "behaviors", {"behavior", "activations", "failures"}, "never_active");
    check_costs(sweep["nodes"], sweep["slowest"], "nodes");
    if (sweep.contains("stats")) {
      has_keys(sweep["stats"], {"elapsed_us", "event_ns", "slowest"}, "stats");
      check_costs(sweep["stats"]["event_ns"], sweep["stats"]["slowest"], "ns");
    }
    return faults_;
  }

 private:
  bool has_keys(const Json& object, const Keys& expected, const std::string& what) {
    Keys found;
    if (object.is_object()) {
      for (const auto& [key, value] : object.items()) found.push_back(key);
    }
    if (found == expected) return true;
    faults_.push_back("the keys of " + what + " are others: " + object.dump());
    return false;
  }

  /// Named are the items whose last or, of behaviors, first number is 0.
  void check_unused(const Json& sweep, const char* items, const Keys& keys, const char* unused) {
    const std::string& count = keys.back() == "runs" ? keys.back() : keys[1];
    Json expected = Json::array();
    for (const Json& item : sweep[items]) {
      if (has_keys(item, keys, items) && item[count] == 0) expected.push_back(item[keys[0]]);
    }
    if (sweep[unused] != expected) faults_.push_back(std::string(unused) + " does not fit");
  }

  void check_costs(const Json& costs, const Json& slowest, const char* unit) {
    if (!has_keys(costs, {"p50", "p99", "max", "histogram"}, unit)) return;
    if (slowest.is_null()) {
      if (!costs["histogram"].empty()) faults_.emplace_back("slowest is null");
      return;
    }
    has_keys(slowest, {"sequence", "event", "what", unit, "script"}, "slowest");
    if (slowest[unit] != costs["max"]) faults_.emplace_back("slowest is not the maximum");
    if (costs["p50"] > costs["p99"] || costs["p99"] > costs["max"]) {
      faults_.emplace_back("the percentiles are out of order");
    }
  }

  Keys faults_;
};

}  // namespace

std::vector<std::string> find_sweep_shape_faults(const std::string& text) {
  const Json sweep = Json::parse(text, nullptr, false);
  if (sweep.is_discarded()) return {"no JSON"};
  return SweepShapeCheck().run(sweep);
}

}  // namespace cbc::golden
