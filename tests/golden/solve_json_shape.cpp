#include "golden/solve_json_shape.h"

#include <algorithm>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

namespace cbc::golden {
namespace {

using Json = nlohmann::ordered_json;
using Keys = std::vector<std::string>;

std::string join(const Keys& keys) {
  std::string text;
  for (const std::string& key : keys) text += (text.empty() ? "" : " ") + key;
  return text;
}

/// The keys that a reason of its kind has.
Keys keys_of_reason(const Json& reason) {
  const std::map<std::string, Keys> of_kind = {
      {"protected", {"task", "priority"}},
      {"requires", {"behavior", "task", "line"}},
      {"performance", {"behavior", "task", "line"}},
      {"exclusive", {"tasks", "line"}},
      {"unavailable", {"behavior"}},
      {"faulty", {"behavior"}},
      {"finished", {"behavior"}},
      {"no_behavior", {"task"}},
      {"on_request", {"task"}},
      {"priority", {"task", "priority"}},
  };
  Keys keys{"kind"};
  const auto found = of_kind.find(reason.value("kind", ""));
  if (found != of_kind.end()) {
    // The minimum of a task is no behavior's.
    const bool is_of_task = found->first == "performance" && !reason.contains("behavior");
    keys.insert(keys.end(), found->second.begin() + (is_of_task ? 1 : 0), found->second.end());
  }
  keys.emplace_back("message");
  return keys;
}

class ShapeCheck {
 public:
  void check_report(const Json& report) {
    has_stats_ = report.contains("totals");
    Keys keys{"schema", "runs"};
    if (has_stats_) keys.insert(keys.end(), {"totals", "process"});
    if (!has_keys(report, keys, "the report")) return;
    if (report["schema"] != "cbc.solve/1") add("the schema is " + report["schema"].dump());
    for (const Json& run : report["runs"]) check_run(run);
    if (!has_stats_) return;
    check_totals(report["totals"], "the totals of all runs");
    has_keys(report["process"], {"peak_memory_bytes", "cpu_us"}, "the process");
  }

  [[nodiscard]] std::vector<std::string> take() { return std::move(faults_); }

 private:
  void check_run(const Json& run) {
    Keys keys{"catalog", "script", "events", "expectations"};
    if (has_stats_) keys.emplace_back("totals");
    // Why the run ended early, if it did.
    if (run.contains("error")) keys.emplace_back("error");
    if (!has_keys(run, keys, "a run")) return;
    std::size_t index = 0;
    for (const Json& event : run["events"]) check_event(event, ++index);
    check_expectations(run["expectations"]);
    if (has_stats_) check_totals(run["totals"], "the totals of a run");
  }

  void check_totals(const Json& totals, const std::string& where) {
    const Keys measures{"solutions", "nodes", "propagations", "elapsed_us"};
    Keys keys{"events"};
    keys.insert(keys.end(), measures.begin(), measures.end());
    keys.emplace_back("kinds");
    if (!has_keys(totals, keys, where)) return;
    const auto check_measures = [&](const Json& effort) {
      for (const std::string& measure : measures) {
        has_keys(effort[measure], {"sum", "mean", "min", "max"}, measure + " in " + where);
      }
    };
    check_measures(totals);
    keys.back() = "verb";
    std::rotate(keys.begin(), keys.end() - 1, keys.end());
    keys.insert(keys.begin() + 1, "origin");
    for (const Json& kind : totals["kinds"]) {
      if (has_keys(kind, keys, "a kind in " + where)) check_measures(kind);
    }
  }

  void check_event(const Json& event, std::size_t index) {
    const std::string where = "event " + std::to_string(index);
    Keys keys{"index", "time", "origin", "verb"};
    const std::string verb = event.value("verb", "");
    if (verb == "start" || verb == "stop") {
      keys.insert(keys.end(), {"name", "priority"});
      if (verb == "start" && event.contains("parameters")) keys.emplace_back("parameters");
    } else if (verb == "finish") {
      keys.insert(keys.end(), {"name", "cause"});
    } else if (verb == "fault" || verb == "repair") {
      keys.emplace_back("name");
    } else if (verb == "situation") {
      keys.emplace_back("situation");
    } else if (verb != "wait") {
      add(where + " has the verb '" + verb + "'");
    }
    keys.insert(keys.end(), {"outcome", "changes", "stopped_tasks", "running", "requests", "queue",
                             "objective", "search", "conflict"});
    // Only where the command line asks for them.
    for (const char* const key : {"why", "alternatives"}) {
      if (event.contains(key)) keys.emplace_back(key);
    }
    if (!has_keys(event, keys, where)) return;
    if (event["index"] != index) add(where + " has the index " + event["index"].dump());
    for (const Json& change : event["changes"]) {
      has_keys(change, {"op", "behavior", "tasks", "cause", "priority", "success"},
               "a change of " + where);
    }
    for (const Json& stopped : event["stopped_tasks"]) {
      has_keys(stopped, {"task", "cause"}, "a stopped task of " + where);
    }
    check_answer(event, where);
    check_conflict(event, where);
    if (event.contains("why")) check_why(event["why"], where);
    if (event.contains("alternatives")) check_alternatives(event["alternatives"], where);
  }

  void check_why(const Json& list, const std::string& where) {
    for (const Json& why : list) {
      const bool is_of_task = why.contains("task");
      Keys keys = is_of_task ? Keys{"task", "chosen"} : Keys{"behavior", "active"};
      keys.insert(keys.end(), {"limit_reached", "alternative", "loses", "conflict", "message"});
      if (!has_keys(why, keys, "a reason why of " + where)) continue;
      if (!why["alternative"].is_null()) check_configuration(why["alternative"], where);
      if (!why["loses"].is_null()) check_loss(why["loses"], where);
      for (const Json& reason : why["conflict"]) {
        has_keys(reason, keys_of_reason(reason), "a reason of " + where);
      }
    }
  }

  void check_loss(const Json& loss, const std::string& where) {
    const bool is_canonical = loss.value("objective", "") == "canonical";
    has_keys(loss,
             is_canonical ? Keys{"objective", "task", "chosen", "alternative"}
                          : Keys{"objective", "chosen", "alternative"},
             "where the alternative loses in " + where);
  }

  void check_alternatives(const Json& alternatives, const std::string& where) {
    if (!has_keys(alternatives, {"limit_reached", "configurations"}, "the list of " + where)) {
      return;
    }
    for (const Json& configuration : alternatives["configurations"]) {
      check_configuration(configuration, where);
    }
  }

  void check_configuration(const Json& configuration, const std::string& where) {
    if (!has_keys(configuration, {"running", "objective"}, "a configuration of " + where)) return;
    has_keys(configuration["objective"],
             {"satisfied", "requests", "suitability", "idle", "changes"},
             "the objective of a configuration of " + where);
  }

  void check_answer(const Json& event, const std::string& where) {
    if (!event["objective"].is_null()) {
      has_keys(event["objective"], {"satisfied", "requests", "suitability", "idle", "changes"},
               "the objective of " + where);
    }
    if (!event["search"].is_null()) {
      Keys keys{"status", "group", "space", "protection", "solutions", "nodes"};
      if (has_stats_) keys.insert(keys.end(), {"propagations", "elapsed_us"});
      has_keys(event["search"], keys, "the search of " + where);
    }
    if (event["outcome"] != "accepted" && !event["objective"].is_null()) {
      add(where + " was not accepted and has an objective");
    }
    if (event["outcome"] == "accepted" && event["search"].is_null()) {
      add(where + " was accepted without a search");
    }
  }

  void check_conflict(const Json& event, const std::string& where) {
    if (event["outcome"] != "rejected" && !event["conflict"].empty()) {
      add(where + " was not rejected and has a conflict");
    }
    for (const Json& reason : event["conflict"]) {
      has_keys(reason, keys_of_reason(reason), "a reason of " + where);
    }
  }

  void check_expectations(const Json& expectations) {
    if (!has_keys(expectations, {"passed", "failed", "failures"}, "the expectations")) return;
    if (expectations["failed"] != expectations["failures"].size()) {
      add("the number of failures is not that of failed expectations");
    }
    for (const Json& failure : expectations["failures"]) {
      has_keys(failure, {"index", "line", "message"}, "a failure");
    }
  }

  bool has_keys(const Json& object, const Keys& expected, const std::string& where) {
    Keys found;
    for (const auto& [key, value] : object.items()) found.push_back(key);
    if (object.is_object() && found == expected) return true;
    add(where + " must have the keys [" + join(expected) + "], and has [" + join(found) + "]");
    return false;
  }

  void add(std::string fault) { faults_.push_back(std::move(fault)); }

  std::vector<std::string> faults_;
  bool has_stats_ = false;  ///< of a call with --stats
};

}  // namespace

std::vector<std::string> find_shape_faults(const std::string& text) {
  const Json report = Json::parse(text, nullptr, false);
  if (report.is_discarded()) return {"this is not JSON"};
  ShapeCheck check;
  check.check_report(report);
  return check.take();
}

}  // namespace cbc::golden
