// Random catalogs: their mutants must be those of a plain enumeration; a mission must notice one
// exactly if it fails on its text; and one is equivalent exactly if a plain search finds no
// difference. CBC_SEED and CBC_PROPERTY_CASES are as in property_test.cpp.
#include <algorithm>
#include <array>
#include <cstddef>
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

#include "compiled_text.h"
#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "core/script/reader.h"
#include "core/script/runner.h"
#include "core/yaml/document.h"
#include "coverage/engine/goal_proof.h"
#include "coverage/engine/mutants/mutants.h"
#include "demand.h"
#include "model.h"
#include "plain_comparison.h"
#include "plain_exploration.h"
#include "random.h"
#include "random_cases.h"
#include "verify_case.h"
#include "yaml_text.h"

namespace cbc::plain::mutants_property_test {
namespace {

using oracle::demand;
using oracle::Random;

constexpr std::uint64_t default_cases = 120;
constexpr std::uint64_t most_states = 400;
constexpr std::size_t judged_per_case = 8;

/// Mutants of the model, by what they are about, in words.
class PlainMutants {
 public:
  explicit PlainMutants(const oracle::Catalog& catalog) : catalog_(catalog) {
    // Without a behavior that names it a task could vanish, or take another place.
    for (oracle::Task& task : catalog_.tasks) task.listed = true;
    catalog_.defaults = {};
    for (std::size_t place = 0; place < catalog.behaviors.size(); ++place) add_behavior(place);
    for (std::size_t place = 0; place < catalog.tasks.size(); ++place) add_task(place);
    add_exclusions();
  }

  [[nodiscard]] const std::map<std::string, oracle::Catalog>& all() const { return all_; }

 private:
  oracle::Catalog& add(const std::string& key) {
    const auto [place, is_new] = all_.emplace(key, catalog_);
    demand(is_new, "twice: " + key);
    return place->second;
  }
  [[nodiscard]] const std::string& task_name(std::size_t task) const {
    return catalog_.tasks[task].name;
  }

  void add_behavior(std::size_t place) {
    const oracle::Behavior& behavior = catalog_.behaviors[place];
    never_fit(add("behavior_removed " + behavior.name), place);
    std::map<std::size_t, oracle::Millionths> required;
    for (const oracle::Requirement& one : behavior.requirements) {
      required[one.task] = std::max(required[one.task], one.minimum);
    }
    for (const auto& [task, minimum] : required) {
      const std::string about = " " + behavior.name + " " + task_name(task);
      auto& fewer = add("requirement_removed" + about).behaviors[place].requirements;
      std::erase_if(fewer, [wanted = task](const auto& one) { return one.task == wanted; });
      if (minimum == 0) continue;
      for (auto& one : add("minimum_removed" + about).behaviors[place].requirements) {
        if (one.task == task) one.minimum = 0;
      }
    }
    for (std::size_t condition = 0; condition < behavior.situation.size(); ++condition) {
      const std::string& variable = catalog_.variables[behavior.situation[condition].variable].name;
      auto& fewer =
          add("condition_removed " + behavior.name + " " + variable).behaviors[place].situation;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(condition));
    }
    const bool may_time_out =
        std::any_of(behavior.performs.begin(), behavior.performs.end(),
                    [&](const auto& one) { return !catalog_.tasks[one.task].keep_running; });
    if (behavior.timeout && may_time_out) {
      add("timeout_removed " + behavior.name).behaviors[place].timeout.reset();
    }
  }

  void add_task(std::size_t place) {
    const oracle::Task& task = catalog_.tasks[place];
    if (task.minimum > 0) add("minimum_removed " + task.name).tasks[place].minimum = 0;
    bool uses_own = false;
    bool uses_others = false;
    // By suitability, the best first, then by place.
    std::map<std::pair<oracle::Millionths, std::size_t>, std::size_t> ranks;
    for (std::size_t behavior = 0; behavior < catalog_.behaviors.size(); ++behavior) {
      for (const oracle::Performance& one : catalog_.behaviors[behavior].performs) {
        if (one.task != place) continue;
        ranks.emplace(std::pair(-one.suitability, behavior), behavior);
        (catalog_.behaviors[behavior].timeout ? uses_others : uses_own) = true;
      }
    }
    for (auto rank = ranks.begin(); rank != ranks.end(); ++rank) {
      const auto next = std::next(rank);
      if (next == ranks.end() || next->first.first == 0) continue;
      const std::size_t behavior = rank->second;
      auto& changed =
          add("suitability_lowered " + catalog_.behaviors[behavior].name + " " + task.name)
              .behaviors[behavior]
              .performs;
      for (oracle::Performance& one : changed) {
        if (one.task == place) one.suitability = -next->first.first - 1;
      }
    }
    if (task.timeout && !task.keep_running && uses_own) {
      add("timeout_removed task " + task.name).tasks[place].timeout.reset();
    }
    if (task.keep_running && ((task.timeout && uses_own) || uses_others)) {
      add("execution_goal_turned " + task.name).tasks[place].keep_running = false;
    }
    for (const bool on_request : {true, false}) {
      oracle::Task turned = task;
      (on_request ? turned.start_on_request : turned.reactive_start) ^= true;
      if (turned.start_on_request && turned.reactive_start) continue;
      add((on_request ? "start_on_request_turned " : "reactive_start_turned ") + task.name)
          .tasks[place] = turned;
    }
  }

  void add_exclusions() {
    std::set<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t list = 0; list < catalog_.exclusivity.size(); ++list) {
      const std::set<std::size_t> tasks(catalog_.exclusivity[list].begin(),
                                        catalog_.exclusivity[list].end());
      for (const std::size_t a : tasks) {
        for (const std::size_t b : tasks) {
          if (a < b) pairs.emplace(a, b);
        }
        if (tasks.size() < 3) continue;
        std::erase(add("exclusion_narrowed " + task_name(a) + " " + std::to_string(list))
                       .exclusivity[list],
                   a);
      }
    }
    for (const auto& pair : pairs) {
      auto& lists = add("exclusion_removed " + task_name(pair.first) + " " + task_name(pair.second))
                        .exclusivity;
      lists.clear();
      for (const auto& other : pairs) {
        if (other != pair) lists.push_back({other.first, other.second});
      }
    }
  }

  /// Scripts still name the behavior, but it needs a value that no event gives.
  static void never_fit(oracle::Catalog& catalog, std::size_t behavior) {
    catalog.behaviors[behavior].situation.push_back({catalog.variables.size(), {1}});
    catalog.variables.push_back({"IT IS THERE", {"no", "yes"}});
  }

  oracle::Catalog catalog_;
  std::map<std::string, oracle::Catalog> all_;
};

/// The catalog of the key "behavior_removed NAME", in which the name is gone.
oracle::Catalog without_name(oracle::Catalog catalog, const std::string& key) {
  const std::string name = key.substr(key.find(' ') + 1);
  catalog.variables.pop_back();
  std::erase_if(catalog.behaviors, [&](const auto& behavior) { return behavior.name == name; });
  return catalog;
}

std::string key_of(const cbc::Catalog& catalog, const Mutant& mutant) {
  std::string key(name_of(mutant.kind));
  // A task may have the name of a behavior.
  const bool is_of_task = mutant.behavior == Mutant::none;
  if (mutant.kind == Mutant::Kind::timeout_removed && is_of_task) key += " task";
  if (mutant.behavior != Mutant::none) key += " " + catalog.behaviors[mutant.behavior].name;
  if (mutant.task != Mutant::none) key += " " + catalog.tasks[mutant.task].name;
  if (mutant.kind == Mutant::Kind::exclusion_removed) {
    key += " " + catalog.tasks[mutant.other].name;
  }
  if (mutant.variable != Mutant::none) key += " " + catalog.variables[mutant.variable].name;
  if (mutant.list != Mutant::none) key += " " + std::to_string(mutant.list);
  return key;
}

cbc::Catalog understand(const std::string& yaml) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(yaml, "catalog.yaml", diagnostics);
  return understand_catalog(*document, diagnostics).catalog;
}

std::shared_ptr<const yaml::Document> parse(const std::string& script) {
  Diagnostics diagnostics;
  return yaml::parse(script, "script.yaml", diagnostics);
}

/// What is active after each step.
class Recorder final : public RunListener {
 public:
  explicit Recorder(const CompiledCatalog& catalog) : catalog_(catalog) {}
  void on_event(const ExplainedRecord& /*record*/, const cbc::Step* /*step*/,
                const State& /*state*/) override {}
  void on_end(const State& state) override {
    for (const BehaviorId behavior : catalog_.behavior_ids) {
      if (!state.is_active(behavior)) continue;
      active += (active.empty() ? "" : ", ") + std::string(catalog_.name_of_behavior(behavior));
    }
  }

  std::string active;

 private:
  const CompiledCatalog& catalog_;
};

/// Whether a script can be read, runs to its end, and all its expectations hold.
bool passes(const CompiledCatalog& catalog, const std::string& text,
            std::string* active = nullptr) {
  Diagnostics diagnostics;
  const auto script = read_script(*parse(text), catalog, Severity::note, diagnostics);
  if (!script) return false;
  Recorder recorder(catalog);
  const RunResult result = run_script(catalog, *script, {}, recorder);
  if (active != nullptr) *active = recorder.active;
  return result.status == Coordinator::Status::ok && result.failed == 0;
}

bool can_be_read(const CompiledCatalog& catalog, const std::string& text) {
  Diagnostics diagnostics;
  return read_script(*parse(text), catalog, Severity::note, diagnostics).has_value();
}

/// Some events, after some of which it is expected what the catalog does.
std::string make_mission(const CompiledCatalog& catalog, Random& random) {
  std::string text;
  const std::size_t events = 2 + random.below(8);
  for (std::size_t event = 0; event < events; ++event) {
    const bool has_behavior = catalog.behavior_names.size() > 0 && random.percent(35);
    if (has_behavior) {
      const std::string behavior(
          catalog.behavior_names[random.below(catalog.behavior_names.size())]);
      text += "- {finish: " + behavior +
              ", cause: " + (random.percent(50) ? "goal_achieved" : "process_failure") + "}\n";
    } else if (!catalog.variables.empty() && random.percent(15)) {
      const auto variable = static_cast<std::uint32_t>(random.below(catalog.variables.size()));
      const auto value =
          static_cast<std::uint32_t>(random.below(catalog.variables[variable].value_count));
      text += "- {situation: {" + std::string(catalog.name_of_variable(variable)) + ": " +
              std::string(catalog.name_of_value({variable, value})) + "}}\n";
    } else if (random.percent(15)) {
      text += "- {wait: " + std::to_string(1 + random.below(40)) + "}\n";
    } else {
      text += "- {start: " + std::string(catalog.task_names[random.below(catalog.tasks.size())]) +
              ", priority: " + std::to_string(1 + random.below(2)) + "}\n";
    }
    if (random.percent(60)) continue;
    // At an instant at which nothing is due: an expectation comes before that, the end after it.
    text += "- {wait: 0.0137}\n";
    std::string active;
    demand(passes(catalog, "events:\n" + text, &active), "a mission without a meaning");
    text += "- expect: {active: [" + active + "]}\n";
  }
  return "events:\n" + text;
}

/// The time after which a behavior times out with a task; nothing: never.
std::optional<oracle::Microseconds> timeout_of(const oracle::Catalog& catalog, std::size_t behavior,
                                               std::size_t task) {
  if (catalog.tasks[task].keep_running) return std::nullopt;
  const auto& own = catalog.behaviors[behavior].timeout;
  return own ? own : catalog.tasks[task].timeout;
}

struct Case {
  VerifyCase sample;
  std::vector<std::string> missions;
  Assumptions assumptions;
};

/// Events that the assumptions allow, with times, after each of which it is expected what the
/// catalog does.
std::string make_timed_mission(const Case& one, Random& random) {
  const CompiledCatalog& catalog = one.sample.catalog;
  std::string text;
  const std::size_t events = 2 + random.below(6);
  for (std::size_t event = 0; event < events; ++event) {
    if (!one.assumptions.start.empty() && random.percent(60)) {
      const auto& start = one.assumptions.start[random.below(one.assumptions.start.size())];
      const std::int32_t priority = start.priorities[random.below(start.priorities.size())];
      text += "- {start: " + std::string(catalog.name_of_task(start.task)) +
              ", priority: " + std::to_string(priority) + "}\n";
    } else if (random.percent(50)) {
      const auto& names = catalog.behavior_names;
      text += "- {finish: " + std::string(names[random.below(names.size())]) +
              ", cause: process_failure}\n";
    }
    static constexpr std::array<const char*, 4> waits = {"0.0137", "0.5137", "5.0137", "60.0137"};
    text += "- {wait: " + std::string(waits[random.below(waits.size())]) + "}\n";
    std::string active;
    if (!passes(catalog, "events:\n" + text, &active)) return {};
    text += "- expect: {active: [" + active + "]}\n";
  }
  return "events:\n" + text;
}

/// Whether a state of the group of the behavior has the property; nothing if there are too many.
std::optional<bool> is_reachable(const Case& one, const Property& property, BehaviorId behavior) {
  const CompiledCatalog& catalog = one.sample.catalog;
  const Exploration found = explore_plainly(catalog, {catalog.group_of(behavior)}, one.assumptions,
                                            {&property}, most_states);
  if (found.verdicts.front().has_script) return true;
  return found.complete ? std::optional(false) : std::nullopt;
}

/// Whether a mission could notice the mutant; nothing if there are too many states. Of timeouts:
/// whether one could if no other timeout came first.
std::optional<bool> can_be_noticed(const Case& one, const std::string& key,
                                   const oracle::Catalog& changed,
                                   const CompiledCatalog& compiled) {
  const CompiledCatalog& catalog = one.sample.catalog;
  if (key.starts_with("behavior_removed")) {
    const auto behavior = catalog.find_behavior(key.substr(key.find(' ') + 1));
    Property property;
    property.kind = Property::Kind::reachable;
    const BehaviorId id = catalog.behavior_ids[behavior.value()];
    property.condition = StateCondition::of_behavior(StateCondition::Kind::active, id);
    // The other way around it may show, too: if it is active in the middle of a move.
    if (is_reachable(one, property, id).value_or(false)) return true;
  }
  if (!key.starts_with("timeout") && !key.starts_with("execution_goal")) {
    const PlainComparison found = compare_plainly(compiled, catalog, one.assumptions, most_states,
                                                  {PlainDifferences::expectable});
    return found.is_complete ? std::optional(found.differs) : std::nullopt;
  }
  if (!one.assumptions.failures) return false;
  const oracle::Catalog& source = one.sample.source;
  for (std::size_t behavior = 0; behavior < source.behaviors.size(); ++behavior) {
    for (const oracle::Performance& performance : source.behaviors[behavior].performs) {
      if (timeout_of(source, behavior, performance.task) ==
          timeout_of(changed, behavior, performance.task)) {
        continue;
      }
      Property property;
      property.kind = Property::Kind::reachable;
      property.condition =
          StateCondition::of_task(StateCondition::Kind::running, catalog.task_ids[performance.task],
                                  {catalog.behavior_ids[behavior]});
      const auto found = is_reachable(one, property, catalog.behavior_ids[behavior]);
      if (!found || *found) return found;
    }
  }
  return false;
}

void check_verdict(const Case& one, const std::string& key, const oracle::Catalog& changed,
                   const MutantVerdict& verdict, Random& random, oracle::Statistics& statistics) {
  const std::optional<CompiledCatalog> compiled =
      oracle::compile_yaml(oracle::catalog_yaml(changed, random));
  demand(compiled.has_value(), "an invalid catalog");
  // Whether its name is there must make no difference, but to scripts that name it.
  std::optional<CompiledCatalog> nameless;
  if (key.starts_with("behavior_removed")) {
    nameless = oracle::compile_yaml(oracle::catalog_yaml(without_name(changed, key), random));
    demand(nameless.has_value(), "an invalid catalog without the name");
    for (const std::string& mission : one.missions) {
      if (!can_be_read(*nameless, mission)) {
        statistics.count("it is named");
        if (passes(*compiled, mission)) statistics.count("named, but not noticed");
        continue;
      }
      demand(passes(*nameless, mission) == passes(*compiled, mission), "the name matters");
    }
  }
  const auto noticing =
      std::find_if(one.missions.begin(), one.missions.end(),
                   [&](const std::string& mission) { return !passes(*compiled, mission); });
  const bool is_noticed = verdict.result == MutantVerdict::Result::noticed;
  demand(is_noticed == (noticing != one.missions.end()),
         is_noticed ? "it is not noticed" : "it is");
  if (is_noticed) {
    demand(verdict.notice->mission == static_cast<std::size_t>(noticing - one.missions.begin()),
           "another mission notices it first");
    statistics.count("noticed " + key.substr(0, key.find(' ')));
    return;
  }
  const std::optional<bool> can = can_be_noticed(one, key, changed, *compiled);
  if (!can) return statistics.count("too many states");
  const bool has_survived = verdict.result == MutantVerdict::Result::survived;
  const bool is_equivalent = verdict.result == MutantVerdict::Result::equivalent;
  const bool is_about_times = key.starts_with("timeout") || key.starts_with("execution_goal");
  if (*can && verdict.result == MutantVerdict::Result::undecided) {
    demand(verdict.doubt == MutantVerdict::Doubt::no_script, "a limit came first");
    return statistics.count(is_about_times ? "no time for a timeout" : "no script");
  }
  if (is_about_times && *can && is_equivalent) {
    for (int mission = 0; mission < 10; ++mission) {
      const std::string text = make_timed_mission(one, random);
      demand(text.empty() || passes(*compiled, text), "noticed by:\n" + text);
    }
    return statistics.count("forestalled timeout");
  }
  demand(has_survived || is_equivalent, "undecided");
  demand(has_survived == *can, *can ? "a mission could notice it" : "no mission could");
  statistics.count(has_survived ? "survived" : "equivalent");
  if (!has_survived) return;
  demand(verdict.script.has_value(), "it survived without a script");
  demand(passes(one.sample.catalog, *verdict.script), "not on the original:\n" + *verdict.script);
  demand(!passes(*compiled, *verdict.script), "not noticed by:\n" + *verdict.script);
  statistics.count("script of " + key.substr(0, key.find(' ')));
}

void judge_some(const Case& one, Random& random, oracle::Statistics& statistics) {
  const cbc::Catalog source = understand(one.sample.yaml);
  std::map<std::string, Mutant> found;
  for (const Mutant& mutant : find_mutants(source)) {
    demand(found.emplace(key_of(source, mutant), mutant).second, "a mutant twice");
  }
  const PlainMutants expected(one.sample.source);
  std::vector<std::string> keys;
  for (const auto& [key, mutant] : found) {
    demand(expected.all().contains(key), "no such mutant: " + key);
    keys.push_back(key);
  }
  for (const auto& [key, changed] : expected.all()) demand(found.contains(key), "no " + key);

  const CompiledCatalog& catalog = one.sample.catalog;
  if (compare_plainly(catalog, catalog, one.assumptions, 1).has_error) {
    return statistics.count("excluded first state");
  }
  std::vector<Script> scripts;
  for (const std::string& mission : one.missions) {
    Diagnostics diagnostics;
    scripts.push_back(
        read_script(*parse(mission), one.sample.catalog, Severity::note, diagnostics).value());
    demand(!find_notice(one.sample.catalog, scripts.back()), "a mission fails at once");
  }
  const MutantJudge judge(source, one.sample.catalog, scripts, one.assumptions);
  random.shuffle(keys);
  keys.resize(std::min(keys.size(), judged_per_case));
  for (const std::string& key : keys) {
    try {
      const std::vector<MutantVerdict> verdicts = judge_all(judge, {&found.at(key), 1}, {});
      check_verdict(one, key, expected.all().at(key), verdicts.front(), random, statistics);
    } catch (const std::exception& error) {
      throw std::runtime_error(key + ": " + error.what());
    }
  }
}

void run_case(std::uint64_t seed, oracle::Results& results) {
  Case one;
  try {
    one.sample = generate_verify_case(seed);
    Random random(~seed);
    one.assumptions = random.percent(50) ? assumptions_of_goals(one.sample.catalog)
                                         : one.sample.question.assumptions;
    for (int mission = 0; mission < 2; ++mission) {
      one.missions.push_back(make_mission(one.sample.catalog, random));
    }
    judge_some(one, random, results.statistics);
  } catch (const std::exception& error) {
    std::string report = "seed " + std::to_string(seed) + "\n" + text_of(one.sample);
    for (const std::string& mission : one.missions) report += "--- mission\n" + mission;
    results.faults.push_back({seed, report + "--- fault\n" + error.what() + "\n"});
  }
}

const oracle::LowerBound lower_bounds[] = {
    {"survived", 500},
    {"equivalent", 500},
    {"it is named", 100},
    {"named, but not noticed", 20},
    {"noticed behavior_removed", 100},
    {"noticed suitability_lowered", 20},
    {"noticed requirement_removed", 20},
    {"noticed exclusion_removed", 5},
    {"noticed start_on_request_turned", 20},
    {"noticed reactive_start_turned", 20},
    {"script of behavior_removed", 50},
    {"script of suitability_lowered", 20},
    {"script of requirement_removed", 20},
    {"script of minimum_removed", 5},
    {"script of condition_removed", 5},
    {"script of exclusion_removed", 5},
    {"script of timeout_removed", 5},
    {"script of start_on_request_turned", 20},
    {"script of reactive_start_turned", 20},
    {"script of execution_goal_turned", 5},
};

TEST(Mutants, AreThoseOfAPlainEnumerationAndNoticedByWhatFails) {
  oracle::run_random_cases(default_cases, run_case, lower_bounds);
}

}  // namespace
}  // namespace cbc::plain::mutants_property_test
