// Random catalogs and scripts: the goals of a catalog, and those that a script meets, must be those
// that follow from their definition (docs/coverage.md) and from the events of the oracle, which
// answers each event once more without each of the constraints. CBC_SEED and CBC_PROPERTY_CASES are
// as in property_test.cpp.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "core/script/reader.h"
#include "core/script/runner.h"
#include "core/yaml/document.h"
#include "coverage/engine/goal_monitor.h"
#include "coverage/engine/goals.h"
#include "demand.h"
#include "generator.h"
#include "oracle.h"
#include "random.h"
#include "random_cases.h"
#include "yaml_text.h"

namespace cbc::oracle::coverage_property_test {
namespace {

constexpr std::uint64_t default_cases = 150;

using Keys = std::set<std::string>;

/// The goals of a catalog by what they are about, in words, and the constraints that they leave
/// out.
class PlainGoals {
 public:
  explicit PlainGoals(const CatalogFacts& facts) : facts_(facts), catalog_(facts.catalog) {
    add_tasks();
    add_behaviors();
    add_pairs();
    add_situation();
    add_priorities();
  }

  [[nodiscard]] const Keys& all() const { return all_; }
  [[nodiscard]] const std::vector<CatalogFacts>& variants() const { return variants_; }
  /// By variant.
  [[nodiscard]] const std::vector<std::string>& decided() const { return decided_; }

  [[nodiscard]] std::string of_task(const char* kind, std::size_t task) const {
    return std::string(kind) + " task " + catalog_.tasks[task].name;
  }
  [[nodiscard]] std::string of_behavior(const char* kind, std::size_t behavior) const {
    return std::string(kind) + " behavior " + catalog_.behaviors[behavior].name;
  }
  [[nodiscard]] std::string of_value(std::size_t variable, std::size_t value) const {
    const Variable& declared = catalog_.variables[variable];
    return "variable_value " + declared.name + " " +
           (declared.is_boolean() ? (value == 0 ? "true" : "false") : declared.values[value]);
  }
  [[nodiscard]] std::string of_requirement(const char* kind, std::size_t behavior,
                                           std::size_t task) const {
    return of_behavior(kind, behavior) + " task " + catalog_.tasks[task].name;
  }

 private:
  CatalogFacts& add_variant(std::string key) {
    all_.insert(key);
    decided_.push_back(std::move(key));
    return variants_.emplace_back(facts_);
  }

  void add_tasks() {
    for (std::size_t task = 0; task < catalog_.tasks.size(); ++task) {
      const Task& described = catalog_.tasks[task];
      all_.insert(of_task("task_ran", task));
      if (described.minimum > 0) {
        add_variant(of_task("minimum_decided", task)).catalog.tasks[task].minimum = 0;
      }
      const auto& behaviors = facts_.behaviors_of[task];
      const bool uses_timeout = std::any_of(behaviors.begin(), behaviors.end(), [&](auto behavior) {
        return !catalog_.behaviors[behavior].timeout;
      });
      if (!described.keep_running && described.timeout && uses_timeout) {
        all_.insert(of_task("timeout_fired", task));
      }
      if (!described.reactive_start) continue;
      for (const char* const kind :
           {"reactive_started", "reactive_gave_way", "reactive_returned"}) {
        all_.insert(of_task(kind, task));
      }
    }
  }

  void add_behaviors() {
    for (std::size_t behavior = 0; behavior < catalog_.behaviors.size(); ++behavior) {
      const Behavior& described = catalog_.behaviors[behavior];
      all_.insert(of_behavior("behavior_active", behavior));
      all_.insert(of_behavior("behavior_failed", behavior));
      bool achieves = false;
      bool has_other = false;
      for (const Performance& performance : described.performs) {
        achieves = achieves || !catalog_.tasks[performance.task].keep_running;
        has_other = has_other || facts_.behaviors_of[performance.task].size() > 1;
      }
      if (achieves) all_.insert(of_behavior("behavior_succeeded", behavior));
      if (has_other) all_.insert(of_behavior("behavior_replaced", behavior));
      if (achieves && described.timeout) all_.insert(of_behavior("timeout_fired", behavior));
      add_requirements(behavior);
    }
  }

  void add_requirements(std::size_t behavior) {
    std::map<std::size_t, Millionths> minimums;
    for (const Requirement& requirement : catalog_.behaviors[behavior].requirements) {
      Millionths& minimum = minimums[requirement.task];
      minimum = std::max(minimum, requirement.minimum);
    }
    for (const auto& [task, minimum] : minimums) {
      all_.insert(of_requirement("requirement_used", behavior, task));
      auto& without = add_variant(of_requirement("requirement_decided", behavior, task))
                          .catalog.behaviors[behavior]
                          .requirements;
      std::erase_if(without,
                    [&, required = task](const auto& one) { return one.task == required; });
      if (minimum == 0) continue;
      auto& weaker = add_variant(of_requirement("minimum_decided", behavior, task))
                         .catalog.behaviors[behavior]
                         .requirements;
      for (Requirement& requirement : weaker) {
        if (requirement.task == task) requirement.minimum = 0;
      }
    }
  }

  void add_pairs() {
    for (std::size_t a = 0; a < catalog_.tasks.size(); ++a) {
      for (const std::size_t b : facts_.excludes[a]) {
        if (b <= a) continue;
        CatalogFacts& without =
            add_variant(of_task("exclusion_decided", a) + " task " + catalog_.tasks[b].name);
        without.excludes[a].erase(b);
        without.excludes[b].erase(a);
      }
    }
  }

  void add_situation() {
    for (std::size_t variable = 0; variable < catalog_.variables.size(); ++variable) {
      for (std::size_t value = 0; value < catalog_.variables[variable].value_count(); ++value) {
        all_.insert(of_value(variable, value));
      }
    }
    for (std::size_t behavior = 0; behavior < catalog_.behaviors.size(); ++behavior) {
      for (const Condition& condition : catalog_.behaviors[behavior].situation) {
        const std::set<std::size_t> values(condition.values.begin(), condition.values.end());
        if (values.size() == catalog_.variables[condition.variable].value_count()) continue;
        all_.insert(of_behavior("behavior_began_to_fit", behavior));
        all_.insert(of_behavior("behavior_ceased_to_fit", behavior));
      }
    }
  }

  /// All that a task may need, itself included.
  [[nodiscard]] std::set<std::size_t> needs(std::size_t task) const {
    std::set<std::size_t> all{task};
    for (const std::size_t behavior : facts_.behaviors_of[task]) {
      for (const Requirement& requirement : catalog_.behaviors[behavior].requirements) {
        all.merge(needs(requirement.task));
      }
    }
    return all;
  }

  [[nodiscard]] bool may_conflict(std::size_t a, std::size_t b) const {
    for (const std::size_t one : needs(a)) {
      for (const std::size_t other : needs(b)) {
        if (one != other && facts_.excludes[one].contains(other)) return true;
      }
    }
    return false;
  }

  void add_priorities() {
    for (std::size_t task = 0; task < catalog_.tasks.size(); ++task) {
      if (!catalog_.tasks[task].start_on_request) continue;
      for (std::size_t other = 0; other < catalog_.tasks.size(); ++other) {
        const Task& described = catalog_.tasks[other];
        if (other == task || !may_conflict(task, other)) continue;
        if (described.start_on_request || described.reactive_start) {
          all_.insert(of_task("higher_displaced", task));
        }
        if (!described.start_on_request) continue;
        all_.insert(of_task("lower_rejected", task));
        all_.insert(of_task("equal_displaced", task));
      }
    }
  }

  const CatalogFacts& facts_;
  const Catalog& catalog_;
  Keys all_;
  std::vector<CatalogFacts> variants_;
  std::vector<std::string> decided_;
};

/// Runs a script on the oracle, and finds the goals that its events meet.
class PlainWatch {
 public:
  PlainWatch(std::shared_ptr<const CatalogFacts> facts, const PlainGoals& goals,
             const Script& script)
      : facts_(std::move(facts)), goals_(goals), oracle_(facts_, script, nullptr) {
    oracle_.keep_answers();
    oracle_.compare_with(goals.variants());
    values_ = oracle_.state().values;
    taken_.resize(values_.size(), 0);
    activated_.resize(facts_->catalog.behaviors.size(), 0);
    note_variables();
    for (std::size_t behavior = 0; behavior < activated_.size(); ++behavior) {
      fits_.push_back(oracle_.fits(behavior));
    }
  }

  Keys run(const Script& script) {
    for (const Event& event : script.events) {
      oracle_.handle(event);
      note_new_events();
    }
    oracle_.finish();
    note_new_events();
    for (const auto& [event, places] : oracle_.differing()) {
      for (const std::size_t place : places) {
        if (place != none) met_.insert(goals_.decided().at(place));
      }
    }
    Keys met;
    std::set_intersection(met_.begin(), met_.end(), goals_.all().begin(), goals_.all().end(),
                          std::inserter(met, met.end()));
    return met;
  }

 private:
  void meet(const std::string& key) { met_.insert(key); }

  void note_new_events() {
    for (; seen_ < oracle_.events().size(); ++seen_) note(oracle_.events()[seen_]);
  }

  void note(const nlohmann::ordered_json& event) {
    const auto index = event["index"].get<std::int64_t>();
    const auto time = std::llround(event["time"].get<double>() * 1e6);
    if (event["verb"] == "situation") note_situation();
    const auto answer = oracle_.answers().find(index);
    if (answer != oracle_.answers().end()) {
      note_answer(answer->second, event["origin"] == "timeout", time);
    }
    for (const auto& change : event["changes"]) {
      if (change["op"] != "activate") continue;
      const std::size_t behavior = find_behavior(change["behavior"]);
      if (change["success"]) {
        activated_[behavior] = time;
      } else {
        meet(goals_.of_behavior("behavior_failed", behavior));
      }
    }
    if (event["outcome"] == "rejected" && event["verb"] == "start" && event["origin"] == "script" &&
        is_protection_alone(index)) {
      meet("lower_rejected task " + event["name"].get<std::string>());
    }
  }

  [[nodiscard]] bool is_protection_alone(std::int64_t index) const {
    const auto found = oracle_.differing().find(index);
    return found != oracle_.differing().end() && found->second.contains(none);
  }

  [[nodiscard]] std::size_t find_behavior(const std::string& name) const {
    std::size_t behavior = 0;
    while (facts_->catalog.behaviors.at(behavior).name != name) ++behavior;
    return behavior;
  }

  /// At most one event of a script is handled at a time, so these are the values after it.
  void note_variables() {
    for (std::size_t variable = 0; variable < oracle_.variables().size(); ++variable) {
      meet(goals_.of_value(variable, oracle_.variables()[variable]));
    }
  }

  void note_situation() {
    note_variables();
    const std::set<std::size_t> active = active_behaviors(values_);
    for (std::size_t behavior = 0; behavior < fits_.size(); ++behavior) {
      const bool fits = oracle_.fits(behavior);
      if (fits && !fits_[behavior]) meet(goals_.of_behavior("behavior_began_to_fit", behavior));
      if (!fits && fits_[behavior] && active.contains(behavior)) {
        meet(goals_.of_behavior("behavior_ceased_to_fit", behavior));
      }
      fits_[behavior] = fits;
    }
  }

  void note_answer(const Answer& answer, bool is_timeout, Microseconds time) {
    const Trigger& trigger = answer.trigger;
    const Assignment& before = answer.before.values;
    const Assignment& after = answer.after.values;
    const std::set<std::size_t> was_active = active_behaviors(before);
    for (const std::size_t behavior : active_behaviors(after)) {
      if (!was_active.contains(behavior)) meet(goals_.of_behavior("behavior_active", behavior));
      if (facts_->group_of_behavior(behavior) != answer.problem.group) continue;
      for (const Requirement& requirement : facts_->catalog.behaviors[behavior].requirements) {
        meet(goals_.of_requirement("requirement_used", behavior, requirement.task));
      }
    }
    if (trigger.verb == Verb::finish) note_finish(trigger, before, is_timeout, time);
    for (std::size_t task = 0; task < before.size(); ++task) {
      if (before[task] == after[task]) continue;
      if (before[task] == none) meet(goals_.of_task("task_ran", task));
      if (before[task] != none && after[task] != none) {
        meet(goals_.of_behavior("behavior_replaced", before[task]));
      }
      if (after[task] == none) note_stop(answer, task);
      taken_[task] = time;
    }
    if (trigger.verb == Verb::start && trigger.reactive) {
      meet(goals_.of_task("reactive_started", trigger.subject));
      if (gave_way_.contains(trigger.subject)) {
        meet(goals_.of_task("reactive_returned", trigger.subject));
      }
    }
    values_ = after;
  }

  void note_finish(const Trigger& trigger, const Assignment& before, bool is_timeout,
                   Microseconds time) {
    if (trigger.cause == Cause::goal_achieved) {
      meet(goals_.of_behavior("behavior_succeeded", trigger.subject));
    } else if (trigger.cause != Cause::situation_change) {
      meet(goals_.of_behavior("behavior_failed", trigger.subject));
    }
    if (!is_timeout) return;
    const std::optional<Microseconds> own = facts_->catalog.behaviors[trigger.subject].timeout;
    for (std::size_t task = 0; task < before.size(); ++task) {
      const Task& described = facts_->catalog.tasks[task];
      if (before[task] != trigger.subject || described.keep_running) continue;
      const std::optional<Microseconds> timeout = own ? own : described.timeout;
      if (!timeout || std::max(taken_[task], activated_[trigger.subject]) + *timeout != time) {
        continue;
      }
      meet(own ? goals_.of_behavior("timeout_fired", trigger.subject)
               : goals_.of_task("timeout_fired", task));
    }
  }

  void note_stop(const Answer& answer, std::size_t task) {
    const Trigger& trigger = answer.trigger;
    const std::optional<Request>& request = answer.before.requests[task];
    if (trigger.verb == Verb::start && !trigger.reactive && request) {
      meet(goals_.of_task(
          request->priority < trigger.priority ? "higher_displaced" : "equal_displaced",
          trigger.subject));
    }
    const bool has_finished =
        std::count(answer.finished_tasks.begin(), answer.finished_tasks.end(), task) > 0;
    const bool is_own = has_finished ? trigger.cause != Cause::situation_change
                                     : trigger.verb == Verb::stop && trigger.subject == task;
    if (!facts_->catalog.tasks[task].reactive_start || is_own) return;
    meet(goals_.of_task("reactive_gave_way", task));
    gave_way_.insert(task);
  }

  std::shared_ptr<const CatalogFacts> facts_;
  const PlainGoals& goals_;
  Oracle oracle_;
  std::size_t seen_ = 0;
  Keys met_;
  Assignment values_;
  std::vector<Microseconds> taken_;      // by task
  std::vector<Microseconds> activated_;  // by behavior
  std::vector<bool> fits_;
  std::set<std::size_t> gave_way_;
};

std::string key_of(const CompiledCatalog& catalog, const Goal& goal) {
  std::string key(name_of(goal.kind));
  const auto add = [&](std::string_view name) { key += " " + std::string(name); };
  const auto add_task = [&](TaskId task) {
    if (task == cbc::none) return;
    add("task");
    add(catalog.name_of_task(task));
  };
  if (goal.behavior != cbc::none) {
    add("behavior");
    add(catalog.name_of_behavior(goal.behavior));
  }
  add_task(goal.task);
  add_task(goal.other_task);
  if (goal.variable != cbc::none) {
    add(catalog.name_of_variable(goal.variable));
    add(catalog.name_of_value({goal.variable, goal.value}));
  }
  return key;
}

std::string differences(const Keys& a, const Keys& b) {
  std::string text;
  for (const std::string& key : a) {
    if (!b.contains(key)) text += "\n  " + key;
  }
  return text;
}

void demand_same(const Keys& found, const Keys& expected, const char* what) {
  demand(found == expected, std::string(what) + "; too many:" + differences(found, expected) +
                                "\ntoo few:" + differences(expected, found));
}

void compare(const Case& inputs, std::uint64_t seed, Statistics& statistics) {
  Random forms(~seed);
  Diagnostics diagnostics;
  const auto read = read_catalog(catalog_yaml(inputs.catalog, forms), "catalog.yaml", diagnostics);
  demand(read.has_value(), "the catalog is refused");
  const CompiledCatalog catalog = cbc::compile(*read);
  const auto document =
      yaml::parse(script_yaml(inputs.catalog, inputs.script, forms), "script.yaml", diagnostics);
  const auto script = read_script(*document, catalog, Severity::warning, diagnostics);
  demand(script.has_value(), "the script is refused");

  std::vector<Goal> goals = find_goals(catalog);
  add_lines(*read, catalog, goals);
  const auto facts = std::make_shared<const CatalogFacts>(inputs.catalog);
  const PlainGoals plain(*facts);
  Keys all;
  for (const Goal& goal : goals) {
    demand(all.insert(key_of(catalog, goal)).second, "twice: " + key_of(catalog, goal));
    demand(!goal.lines.empty() && goal.lines.front() > 0, "no line: " + key_of(catalog, goal));
  }
  demand_same(all, plain.all(), "other goals");

  GoalMonitor watch(catalog, goals, {});
  cbc::State first(catalog);
  first.change_situation(script->situation.availability, script->situation.variables);
  watch.begin(first);
  demand(run_script(catalog, *script, {}, watch).status == Coordinator::Status::ok, "it ends");
  Keys met;
  for (std::size_t goal = 0; goal < goals.size(); ++goal) {
    if (watch.met()[goal] == 0) continue;
    met.insert(key_of(catalog, goals[goal]));
    statistics.count(std::string(name_of(goals[goal].kind)));
  }
  demand_same(met, PlainWatch(facts, plain, inputs.script).run(inputs.script), "other goals met");
}

void run_case(std::uint64_t seed, Results& results) {
  try {
    compare(generate_case(seed), seed, results.statistics);
  } catch (const std::exception& fault) {
    results.faults.push_back({seed, fault.what()});
  }
}

constexpr LowerBound lower_bounds[] = {
    {"task_ran", 1000},
    {"behavior_active", 1000},
    {"behavior_succeeded", 100},
    {"behavior_failed", 500},
    {"behavior_replaced", 200},
    {"requirement_used", 500},
    {"requirement_decided", 200},
    {"minimum_decided", 50},
    {"exclusion_decided", 200},
    {"timeout_fired", 100},
    {"reactive_started", 100},
    {"reactive_gave_way", 50},
    {"reactive_returned", 20},
    {"variable_value", 500},
    {"behavior_began_to_fit", 50},
    {"behavior_ceased_to_fit", 20},
    {"higher_displaced", 20},
    {"lower_rejected", 20},
    {"equal_displaced", 10},
};

TEST(CoverageOfMissions, IsWhatFollowsFromItsDefinition) {
  run_random_cases(default_cases, run_case, lower_bounds);
}

}  // namespace
}  // namespace cbc::oracle::coverage_property_test
