#include "golden/json_relations.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

namespace cbc::golden {
namespace {

using Json = nlohmann::json;

class Relations {
 public:
  void check(const Json& report) {
    const std::string schema = report.value("schema", "");
    if (schema == "cbc.lint/1") {
      check_lint(report);
    } else if (schema == "cbc.solve/1") {
      for (const Json& run : report.at("runs")) check_run(run);
    } else if (schema == "cbc.sweep/1") {
      check_sweep(report);
    } else if (schema == "cbc.graph/1") {
      check_graph(report);
    } else if (schema == "cbc.diff/1") {
      check_diff(report);
    } else if (schema == "cbc.together/1") {
      check_together(report);
    } else if (schema == "cbc.situation/1") {
      check_situation(report);
    } else if (schema == "cbc.verify/1") {
      check_verify(report);
    } else if (schema == "cbc.coverage/1") {
      check_coverage(report);
    } else if (schema == "cbc.mutants/1") {
      check_mutants(report);
    } else if (schema == "cbc.tune/1") {
      check_tune(report);
    } else if (schema == "cbc.what-if/1") {
      check_what_if(report);
    } else {
      faults_.push_back("the schema is '" + schema + "'");
    }
  }

  [[nodiscard]] std::vector<std::string> take() { return std::move(faults_); }

 private:
  void expect(bool holds, const std::string& otherwise) {
    if (!holds) faults_.push_back(otherwise);
  }

  /// What a move changes can be changed in the state.
  void check_what_if(const Json& report) {
    const Json& running = report.at("running");
    std::uint64_t clock = report.at("event");
    for (const Json& move : report.at("moves")) {
      const bool is_of_clock = move.at("origin") != "script";
      std::uint64_t index = is_of_clock ? clock : report.at("event").get<std::uint64_t>();
      expect(move.at("index") == ++index, "a move is not the next event");
      for (const Json& event : move.at("follows")) {
        expect(event.at("index") == ++index, "an event does not follow");
      }
      if (is_of_clock) {
        clock = index;
        continue;
      }
      for (const auto& [task, behavior] : move.at("started").items()) {
        expect(!running.contains(task), "what runs starts: " + task);
      }
      for (const auto& [task, behavior] : move.at("changed").items()) {
        expect(running.value(task, behavior) != behavior, "no change of " + task);
      }
      for (const auto& [task, priority] : move.at("requested").items()) {
        expect(report.at("requests").value(task, 0) != priority, "no other request: " + task);
      }
      for (const Json& task : move.at("stopped")) {
        expect(running.contains(task), "what does not run stops: " + task.dump());
      }
      for (const auto& [task, due] : move.at("queued").items()) {
        expect(report.at("queue").value(task, Json()).is_null(), "it is in the queue: " + task);
      }
    }
  }

  void check_together(const Json& report) {
    std::map<std::string, std::size_t> counts;
    std::size_t place = 0;
    const Json& tasks = report.at("tasks");
    const Json& pairs = report.at("pairs");
    for (std::size_t a = 0; a < tasks.size(); ++a) {
      for (std::size_t b = a + 1; b < tasks.size() && place < pairs.size(); ++b, ++place) {
        const Json& pair = pairs[place];
        expect(pair.at("tasks") == Json::array({tasks[a], tasks[b]}), "the pairs are in order");
        const bool is_excluded = pair.at("together").get<std::string>().starts_with("excluded");
        expect(is_excluded != pair.at("reasons").empty(), "only excluded pairs have reasons");
        ++counts[pair.at("together")];
        if (!pair.at("forbidden").get<bool>()) continue;
        const bool is_possible = pair.at("together") == "possible";
        expect(is_possible, "only what is possible is forbidden");
        counts["forbidden"] += is_possible ? 1 : 0;
      }
    }
    expect(place == pairs.size() && place == tasks.size() * (tasks.size() - 1) / 2,
           "there are all pairs");
    for (const char* together :
         {"possible", "excluded", "excluded_indirectly", "excluded_in_each_situation",
          "excluded_by_situation", "undecided", "forbidden"}) {
      expect(report.at(together) == counts[together],
             std::string(together) + " is not their number");
    }
  }

  /// The table by values and the conditions of the behaviors say the same.
  void check_situation(const Json& report) {
    for (const Json& variable : report.at("variables")) {
      const auto& name = variable.at("variable").get_ref<const std::string&>();
      for (const Json& value : variable.at("values")) {
        Json fit = Json::array();
        Json do_not_fit = Json::array();
        for (const Json& behavior : report.at("behaviors")) {
          const Json& situation = behavior.at("situation");
          if (!situation.contains(name)) continue;
          const Json& values = situation.at(name);
          const bool fits =
              std::find(values.begin(), values.end(), value.at("value")) != values.end();
          (fits ? fit : do_not_fit).push_back(behavior.at("behavior"));
        }
        expect(value.at("fit") == fit && value.at("do_not_fit") == do_not_fit,
               "other behaviors fit in a value of " + name);
      }
    }
  }

  void check_graph(const Json& report) {
    const bool is_state = report.contains("state");
    if (is_state) {
      const Json& state = report.at("state");
      const bool is_beginning = state.at("index") == 0;
      expect(state.at("time").is_null() == is_beginning, "only the beginning has no time");
      expect(state.at("event").is_null() == is_beginning, "only the beginning has no event");
    }
    std::set<std::string> ids;
    for (const Json& node : report.at("nodes")) {
      const auto& id = node.at("id").get_ref<const std::string&>();
      expect(ids.insert(id).second, "two nodes have the id " + id);
      expect(node.contains("priority") == (is_state && node.at("kind") == "task"),
             "only tasks of a state have a priority, unlike " + id);
      check_mark(node, is_state);
    }
    for (const Json& edge : report.at("edges")) {
      for (const char* end : {"from", "to"}) {
        expect(ids.contains(edge.at(end)), "no node has the id " + edge.at(end).dump());
      }
      check_mark(edge, is_state);
    }
  }

  void check_mark(const Json& object, bool is_state) {
    const Json& mark = object.at("mark");
    if (!mark.is_null()) expect((mark != "faulty") == is_state, "the mark " + mark.dump());
  }

  void check_diff(const Json& report) {
    std::set<Json> subjects;
    for (Json change : report.at("changes")) {
      for (const Json& attribute : change.at("attributes")) {
        const bool was_set = !attribute.at("before").is_null();
        const bool is_set = !attribute.at("after").is_null();
        expect(attribute.at("before") != attribute.at("after"), "an attribute has not changed");
        expect(change.at("kind") != "added" || !was_set, "what is added was set before");
        expect(change.at("kind") != "removed" || !is_set, "what is removed is still set");
      }
      change.erase("attributes");
      change.erase("kind");
      expect(subjects.insert(change).second, "two changes of one thing: " + change.dump());
    }
  }

  void check_lint(const Json& report) {
    std::map<std::string, std::uint64_t> found;
    for (const Json& file : report.at("files")) {
      const auto& where = file.at("file").get_ref<const std::string&>();
      check_places(file.at("diagnostics"), where);
      for (const Json& finding : file.at("diagnostics")) ++found[finding.at("severity")];
      if (!file.at("summary").is_null()) check_summary(file.at("summary"), where);
    }
    for (const std::string severity : {"error", "warning", "note"}) {
      expect(report.at(severity + "s") == found[severity],
             "the number of " + severity + "s is not that of the diagnostics");
    }
  }

  void check_places(const Json& findings, const std::string& where) {
    using Place = std::pair<std::uint64_t, std::uint64_t>;
    Place last;
    for (const Json& finding : findings) {
      const Place begin(finding.at("line"), finding.at("column"));
      const Place end(finding.at("end_line"), finding.at("end_column"));
      expect(begin >= last,
             "the diagnostics of " + where + " are not in the order of their places");
      expect(end >= begin, "a diagnostic of " + where + " ends before it begins");
      last = begin;
    }
  }

  void check_verify(const Json& report) {
    for (const Json& exploration : report.at("groups")) check_exploration(exploration);
    if (!report.at("same_as").is_null()) check_comparison(report.at("same_as"));
    if (report.contains("effects")) check_effects(report.at("effects"));
    if (report.contains("overrides")) check_overrides(report.at("overrides"));
  }

  /// What is lost has no behaviors, what is not changed those of before.
  void check_effects(const Json& effects) {
    for (const Json& of_task : effects.at("tasks")) {
      for (const Json& effect : of_task.at("effects")) {
        expect(effect.at("faults").size() <= effects.at("order"), "more faults than the order");
        if (!effect.contains("behaviors")) continue;  // a cut set
        const Json& behaviors = effect.at("behaviors");
        expect((effect.at("effect") == "lost") == behaviors.is_null(), "lost, but with behaviors");
        expect(behaviors.is_null() == effect.at("suitability").is_null(), "half a best answer");
        expect(effect.at("effect") != "none" || behaviors == of_task.at("behaviors"),
               "other behaviors without an effect");
        expect(effect.at("situation").size() <= 1, "more than a single change");
      }
    }
  }

  /// Only of two tasks that run, something changes.
  void check_overrides(const Json& overrides) {
    for (const Json& pair : overrides.at("pairs")) {
      expect(pair.at("first") != pair.at("second"), "a pair of one task");
      for (const char* const priority : {"same", "higher", "lower"}) {
        const Json& one = pair.at(priority);
        const bool has_changes = one.at("result") == "worse" || one.at("result") == "other";
        expect(has_changes == !one.at("changes").empty(), "changes, or none, without reason");
      }
    }
  }

  void check_comparison(const Json& comparison) {
    bool differs = !comparison.at("direct").empty();
    bool is_compared = false;
    std::uint64_t states = 0;
    std::set<std::string> tasks;
    Json shortest;
    for (const Json& groups : comparison.at("groups")) {
      const Json& differences = groups.at("differences");
      expect(differences.empty() == (groups.at("result") != "violated"),
             "groups are decided differently, or not");
      states += groups.at("states").get<std::uint64_t>();
      is_compared = is_compared || groups.at("compared").get<bool>();
      std::uint64_t length = 0;
      for (const Json& difference : differences) {
        differs = true;
        expect(difference.at("length") >= length, "a shorter difference comes later");
        length = difference.at("length");
        if (shortest.is_null() || length < shortest) shortest = length;
        for (const Json& task : difference.at("tasks")) {
          expect(tasks.insert(task.at("task")).second, "a task differs twice");
        }
      }
    }
    expect(differs == (comparison.at("result") == "violated"), "the catalogs differ, or not");
    expect(comparison.at("length") == shortest, "the shortest difference is another one");
    expect(comparison.at("states") == states, "the states are not those of the groups");
    expect(comparison.at("compared") == is_compared, "something was compared, or not");
    expect(is_compared || comparison.at("result") != "proved", "proved without an event");
  }

  /// Each set of tasks and behaviors once, none before its tasks and behaviors are known.
  void check_outcomes(const Json& exploration) {
    std::uint64_t length = 0;
    std::set<Json> known;
    for (const Json& outcome : exploration.at("outcomes")) {
      expect(outcome.at("length") >= length, "a shorter outcome comes later");
      length = outcome.at("length");
      expect(length <= exploration.at("depth"), "an outcome is deeper than all states");
      expect(known.insert(outcome.at("running")).second, "an outcome comes twice");
      for (const auto& [task, behavior] : outcome.at("running").items()) {
        expect(exploration.at("runs").at(task) <= length, "a task runs before it runs: " + task);
        expect(exploration.at("active").at(behavior.get<std::string>()) <= length,
               "a behavior is active before it is active");
      }
    }
  }

  void check_exploration(const Json& exploration) {
    const Json& tasks = exploration.at("tasks");
    const Json& runs = exploration.at("runs");
    const bool is_complete = exploration.at("complete");
    const std::uint64_t depth = exploration.at("depth");
    const auto check_depths = [&](const Json& depths, const std::string& what) {
      for (const auto& [name, moves] : depths.items()) {
        expect(!is_complete || moves <= depth, what + " is deeper than all states: " + name);
      }
    };
    check_depths(runs, "a run");
    check_depths(exploration.at("active"), "an active behavior");
    check_depths(exploration.at("start_refused"), "a refused start");
    for (const auto& [name, moves] : runs.items()) {
      expect(std::find(tasks.begin(), tasks.end(), name) != tasks.end(),
             "a task runs that is none of the group: " + name);
    }
    if (exploration.contains("outcomes")) check_outcomes(exploration);
    for (const Json& pair : exploration.at("together")) {
      const std::uint64_t moves = pair.at(2);
      for (const std::size_t place : {std::size_t{0}, std::size_t{1}}) {
        expect(runs.at(pair.at(place).get<std::string>()) <= moves,
               "a task runs together before it runs");
      }
    }
  }

  /// Each task is in one group, each constraint within one.
  void check_summary(const Json& summary, const std::string& where) {
    const Json& constraints = summary.at("constraints");
    const std::uint64_t total = constraints.at("total");
    std::uint64_t sum = 0;
    for (const char* const kind : {"exclusive_pairs", "requirements", "task_minimums"}) {
      sum += constraints.at(kind).get<std::uint64_t>();
    }
    expect(sum == total, "the constraints of " + where + " do not add up");

    std::uint64_t tasks = 0;
    std::uint64_t of_groups = 0;
    std::set<std::string> names;
    for (const Json& group : summary.at("groups")) {
      tasks += group.at("tasks").size();
      of_groups += group.at("constraints").get<std::uint64_t>();
      names.insert(group.at("tasks").begin(), group.at("tasks").end());
    }
    expect(summary.at("tasks") == tasks && names.size() == tasks,
           "the tasks of " + where + " are not those of its groups");
    expect(of_groups == total, "the constraints of " + where + " are not those of its groups");
  }

  void check_run(const Json& run) {
    std::size_t index = 0;
    for (const Json& event : run.at("events")) {
      ++index;
      expect(event.at("index") == index, "event " + std::to_string(index) + " has another index");
    }
    const Json& expectations = run.at("expectations");
    expect(expectations.at("failed") == expectations.at("failures").size(),
           "the number of failures is not that of failed expectations");
  }

  void check_mutants(const Json& report) {
    const std::set<std::string> missions(report.at("missions").begin(),
                                         report.at("missions").end());
    std::map<std::string, std::size_t> counts;
    std::size_t line = 0;
    for (const Json& mutant : report.at("mutants")) {
      ++counts[mutant.at("result").get<std::string>()];
      const auto first = mutant.at("lines").at(0).get<std::size_t>();
      expect(first >= line, "mutants are in order of lines");
      line = first;
      if (!mutant.contains("noticed_by")) continue;
      expect(missions.contains(mutant.at("noticed_by").at("mission").get<std::string>()),
             "a mutant is noticed by one of the missions");
    }
    for (const char* const result :
         {"noticed", "survived", "equivalent", "undecided", "unjudged"}) {
      expect(report.at(result) == counts[result], std::string("the number of ") + result);
    }
  }

  void check_tune(const Json& report) {
    const auto number_in = [](const Json& object, const char* name) {
      return std::stod(object.at(name).get<std::string>());
    };
    const bool fails = report.at("expectations").at("failed") > 0;
    for (const Json& number : report.at("numbers")) {
      const double value = number_in(number, "value");
      const double low = number_in(number, "low");
      const double high = number_in(number, "high");
      expect(low <= value && value <= high, "a value is not in its tolerance");
      expect(number.at("below").is_null() == (low == 0), "what is below a tolerance");
      expect(number.at("above").is_null() == (high == 100), "what is above a tolerance");
      expect(fails || number.at("repairs").empty(), "a repair where nothing fails");
      double end = -1;
      for (const Json& repair : number.at("repairs")) {
        const double nearest = number_in(repair, "nearest");
        expect(end < number_in(repair, "low"), "repairs are not in order");
        end = number_in(repair, "high");
        expect(number_in(repair, "low") <= nearest && nearest <= end, "the nearest repair");
        expect(value < number_in(repair, "low") || end < value, "a repair changes nothing");
      }
    }
  }

  void check_coverage(const Json& report) {
    Counts all;
    for (const Json& catalog : report.at("catalogs")) {
      const std::set<std::string> missions(catalog.at("missions").begin(),
                                           catalog.at("missions").end());
      Counts of_catalog;
      for (const Json& goal : catalog.at("goals")) {
        const Json& met_by = goal.at("met_by");
        const bool is_unreachable = goal.contains("unreachable");
        expect(met_by.empty() || !is_unreachable, "what is unreachable is not met");
        for (const Json& mission : met_by) {
          expect(missions.contains(mission), "a goal is met by one of the missions");
        }
        ++of_catalog[is_unreachable ? "unreachable" : "goals"];
        if (!met_by.empty()) ++of_catalog["met"];
      }
      check_counts(catalog.at("total"), of_catalog);
      Counts of_sections;
      for (const Json& section : catalog.at("sections")) {
        for (const char* const name : {"goals", "met", "unreachable"}) {
          of_sections[name] += section.at(name).get<std::size_t>();
        }
      }
      check_counts(catalog.at("total"), of_sections);
      for (const auto& [name, count] : of_catalog) all[name] += count;
    }
    check_counts(report, all);
  }

  using Counts = std::map<std::string, std::size_t>;

  void check_counts(const Json& report, Counts& counts) {
    for (const char* const name : {"goals", "met", "unreachable"}) {
      expect(report.at(name) == counts[name], std::string("the sum of ") + name);
    }
    const double tenths = report.at("percent").get<double>() * 10;
    const std::size_t goals = counts["goals"];
    const std::size_t expected = goals == 0 ? 1000 : counts["met"] * 1000 / goals;
    expect(static_cast<std::size_t>(std::lround(tenths)) == expected, "the percentage");
  }

  void check_sweep(const Json& sweep) {
    check_unused(sweep.at("tasks"), "task", "runs", sweep.at("never_ran"));
    check_unused(sweep.at("behaviors"), "behavior", "activations", sweep.at("never_active"));
    check_costs(sweep.at("nodes"), sweep.at("slowest"), "nodes");
    if (!sweep.contains("stats")) return;
    const Json& stats = sweep.at("stats");
    check_costs(stats.at("event_ns"), stats.at("slowest"), "ns");
  }

  /// Named are the items that were counted 0 times.
  void check_unused(const Json& items, const char* name, const char* count, const Json& named) {
    Json unused = Json::array();
    for (const Json& item : items) {
      if (item.at(count) == 0) unused.push_back(item.at(name));
    }
    expect(named == unused, std::string("not every ") + name + " without " + count + " is named");
  }

  void check_costs(const Json& costs, const Json& slowest, const char* unit) {
    if (slowest.is_null()) return expect(costs.at("histogram").empty(), "slowest is null");
    expect(slowest.at(unit) == costs.at("max"), "slowest is not the maximum");
    expect(costs.at("p50") <= costs.at("p99") && costs.at("p99") <= costs.at("max"),
           "the percentiles are out of order");
  }

  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> find_contradictions(const std::string& text) {
  const Json report = Json::parse(text, nullptr, false);
  if (!report.is_object()) return {"this is no JSON object"};
  Relations relations;
  relations.check(report);
  return relations.take();
}

}  // namespace cbc::golden
