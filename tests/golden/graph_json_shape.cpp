#include "golden/graph_json_shape.h"

#include <map>
#include <set>

#include <nlohmann/json.hpp>

namespace cbc::golden {
namespace {

using Json = nlohmann::ordered_json;
using Keys = std::vector<std::string>;

class Checker {
 public:
  std::vector<std::string> run(const Json& report) {
    has_state_ = report.contains("state");
    Keys keys{"schema", "catalog", "view", "nodes", "edges"};
    if (has_state_) keys.insert(keys.begin() + 3, "state");
    expect_keys(report, keys, "the report");
    if (!faults_.empty()) return faults_;
    if (has_state_) check_state(report["state"]);
    const std::set<std::string> views{"full", "tasks", "constraints", "behaviors"};
    expect(report["schema"] == "cbc.graph/1", "schema");
    expect(report["catalog"].is_string(), "catalog");
    expect(views.contains(report["view"].get<std::string>()), "view");
    for (const Json& node : report["nodes"]) check_node(node);
    for (const Json& edge : report["edges"]) check_edge(edge);
    return faults_;
  }

 private:
  void expect(bool is_right, const std::string& what) {
    if (!is_right) faults_.push_back(what);
  }

  void expect_keys(const Json& object, const Keys& expected, const std::string& what) {
    Keys keys;
    for (const auto& [key, value] : object.items()) keys.push_back(key);
    expect(keys == expected, what + " has other keys: " + object.dump());
  }

  void check_state(const Json& state) {
    expect_keys(state, {"script", "index", "time", "event"}, "the state");
    if (!faults_.empty()) return;
    expect(state["script"].is_string(), "script");
    expect(state["index"].is_number_unsigned(), "index");
    const bool is_beginning = state["index"] == 0;
    expect(is_beginning ? state["time"].is_null() : state["time"].is_number(), "time");
    expect(is_beginning ? state["event"].is_null() : state["event"].is_string(), "event");
  }

  Keys keys_of_task() const {
    Keys keys{"id", "kind", "name", "group", "minimum_performance", "defined", "mark", "notes"};
    if (has_state_) keys.insert(keys.begin() + 6, "priority");
    return keys;
  }

  void check_node(const Json& node) {
    const std::map<std::string, Keys> keys = {
        {"task", keys_of_task()},
        {"behavior", {"id", "kind", "name", "group", "package", "mark", "notes"}},
        {"hub", {"id", "kind", "name", "group", "left_out", "mark", "notes"}}};
    const auto found = keys.find(node.value("kind", ""));
    if (found == keys.end()) return faults_.push_back("kind of " + node.dump());
    expect_keys(node, found->second, "a node");
    expect(ids_.insert(node["id"].get<std::string>()).second, "two nodes " + node["id"].dump());
    expect(node["name"].is_null() ? node["kind"] != "task" : node["name"].is_string(), "name");
    expect(node["group"].is_null() || node["group"].is_number_unsigned(), "group");
    check_mark(node);
    if (node.contains("priority")) {
      expect(node["priority"].is_null() || node["priority"].is_number_integer(), "priority");
    }
    expect(node["notes"].is_array(), "notes");
    check_percent(node, "minimum_performance");
  }

  void check_edge(const Json& edge) {
    static const std::map<std::string, Keys> keys = {
        {"performed_by", {"kind", "from", "to", "suitability", "mark"}},
        {"requirement", {"kind", "from", "to", "minimum_performance", "mark"}},
        {"exclusion", {"kind", "from", "to", "mark"}},
        {"same_behavior", {"kind", "from", "to", "mark"}}};
    const auto found = keys.find(edge.value("kind", ""));
    if (found == keys.end()) return faults_.push_back("kind of " + edge.dump());
    expect_keys(edge, found->second, "an edge");
    expect(ids_.contains(edge["from"].get<std::string>()), "no node " + edge["from"].dump());
    expect(ids_.contains(edge["to"].get<std::string>()), "no node " + edge["to"].dump());
    check_mark(edge);
    if (edge["kind"] == "performed_by") expect(edge["suitability"].is_number(), "suitability");
    check_percent(edge, "suitability");
    check_percent(edge, "minimum_performance");
  }

  void check_mark(const Json& object) {
    const std::set<std::string> marks =
        has_state_ ? std::set<std::string>{"active", "started", "stopped", "unavailable"}
                   : std::set<std::string>{"faulty", "added", "removed", "changed"};
    const Json& mark = object["mark"];
    expect(mark.is_null() || marks.contains(mark.get<std::string>()), "mark of " + object.dump());
  }

  void check_percent(const Json& object, const std::string& key) {
    if (!object.contains(key) || object[key].is_null()) return;
    const Json& value = object[key];
    expect(value.is_number() && value >= 0 && value <= 100, key + " of " + object.dump());
  }

  bool has_state_ = false;
  std::set<std::string> ids_;
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> find_graph_shape_faults(const std::string& text) {
  const Json report = Json::parse(text, nullptr, false);
  if (!report.is_object()) return {"no JSON object"};
  return Checker().run(report);
}

}  // namespace cbc::golden
