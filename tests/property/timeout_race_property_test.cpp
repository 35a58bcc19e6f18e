// Random catalogs full of timeouts: one before which another is proven to come always must not fire
// in any of many random missions. CBC_SEED and CBC_PROPERTY_CASES are as in property_test.cpp.
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "compiled_text.h"
#include "core/diagnostic/diagnostic.h"
#include "core/script/reader.h"
#include "core/yaml/document.h"
#include "coverage/engine/goal_monitor.h"
#include "coverage/engine/goal_proof.h"
#include "coverage/engine/goals.h"
#include "demand.h"
#include "random.h"
#include "random_cases.h"

namespace cbc::plain::timeout_race_property_test {
namespace {

using oracle::demand;
using oracle::Random;

constexpr std::uint64_t default_cases = 150;
constexpr int missions_per_case = 40;
constexpr std::size_t task_count = 4;

std::string name_of_task(std::size_t task) { return "T" + std::to_string(task); }

/// Each task may be required by those before it; the last two start in no other way.
std::string make_catalog(Random& random) {
  std::string behaviors = "behaviors:\n";
  std::string tasks = "tasks:\n";
  for (std::size_t task = 0; task < task_count; ++task) {
    const std::size_t count = random.percent(30) ? 2 : 1;
    for (std::size_t behavior = 0; behavior < count; ++behavior) {
      behaviors += "- {behavior: " + name_of_task(task) + "_BY_" + std::to_string(behavior) +
                   ", task: " + name_of_task(task) +
                   ", suitability: " + std::to_string(90 - 10 * behavior);
      if (random.percent(20)) {
        behaviors +=
            std::string(", situation: {LIGHT: ") + (random.percent(50) ? "true" : "false") + "}";
      }
      std::string required;
      for (std::size_t other = task + 1; other < task_count; ++other) {
        if (!random.percent(45)) continue;
        required += (required.empty() ? "{task: " : ", {task: ") + name_of_task(other) + "}";
      }
      behaviors += (required.empty() ? "" : ", requires: [" + required + "]") + "}\n";
    }
    tasks += "- {task: " + name_of_task(task);
    if (task >= 2) tasks += ", start_on_request: false";
    if (random.percent(80)) tasks += ", timeout: " + std::to_string(1 + random.below(4));
    tasks += "}\n";
  }
  const std::string pairs =
      random.percent(40) ? "exclusivity_constraints: [{mutually_exclusive: [T0, T1]}]\n" : "";
  return behaviors + tasks + pairs + "situation: [{variable: LIGHT}]\n";
}

std::string make_mission(const CompiledCatalog& catalog, const Assumptions& assumptions,
                         Random& random) {
  std::string text = "events:\n";
  for (std::size_t event = 0; event < 12; ++event) {
    const std::uint64_t kind = random.below(10);
    const auto& start = assumptions.start[random.below(assumptions.start.size())];
    const std::string task(catalog.name_of_task(start.task));
    const std::string behavior(catalog.behavior_names[random.below(catalog.behavior_names.size())]);
    if (kind < 5) {
      text += "- {start: " + task + ", priority: " + std::to_string(1 + random.below(2)) + "}\n";
    } else if (kind < 6) {
      text += "- {stop: " + task + "}\n";
    } else if (kind < 7) {
      text += "- {finish: " + behavior + ", cause: process_failure}\n";
    } else if (kind < 8) {
      text +=
          std::string("- {situation: {LIGHT: ") + (random.percent(50) ? "true" : "false") + "}}\n";
    }
    static constexpr std::array<const char*, 5> waits = {"0.3", "0.7", "1", "2.5", "4.1"};
    text += "- {wait: " + std::string(waits[random.below(waits.size())]) + "}\n";
  }
  return text;
}

void check(Random& random, std::string& shown, oracle::Statistics& statistics) {
  shown = make_catalog(random);
  const CompiledCatalog catalog = oracle::compile_yaml(shown).value();
  const std::vector<Goal> goals = find_goals(catalog);
  const Assumptions assumptions = assumptions_of_goals(catalog);
  const GoalProof proof = prove_unreachable(catalog, goals, assumptions, {});
  std::vector<std::uint8_t> met(goals.size(), 0);
  for (int mission = 0; mission < missions_per_case; ++mission) {
    const std::string text = make_mission(catalog, assumptions, random);
    Diagnostics diagnostics;
    const auto document = yaml::parse(text, "script.yaml", diagnostics);
    const auto script = read_script(*document, catalog, Severity::note, diagnostics);
    demand(script.has_value(), "the script is refused");
    const MonitoredResult watched = run_monitored(catalog, goals, *script, {});
    for (std::size_t goal = 0; goal < goals.size(); ++goal) {
      if (watched.met[goal] == 0) continue;
      met[goal] = 1;
      if (proof.unreachable[goal].empty()) continue;
      throw std::runtime_error(describe(catalog, goals[goal]) + ", although " +
                               proof.unreachable[goal] + "\n" + text);
    }
  }
  for (std::size_t goal = 0; goal < goals.size(); ++goal) {
    if (goals[goal].kind != Goal::Kind::timeout_fired) continue;
    statistics.count(met[goal] != 0                                      ? "fires"
                     : is_forestalled(catalog, goals[goal], proof.facts) ? "forestalled"
                     : proof.unreachable[goal].empty()                   ? "not seen"
                                                                         : "unreachable");
  }
}

void run_case(std::uint64_t seed, oracle::Results& results) {
  Random random(seed);
  std::string shown;
  try {
    check(random, shown, results.statistics);
  } catch (const std::exception& fault) {
    results.faults.push_back({seed, shown + fault.what()});
  }
}

constexpr oracle::LowerBound lower_bounds[] = {
    {"fires", 1000}, {"forestalled", 300}, {"unreachable", 10}};

TEST(TimeoutRace, IsLostInAllMissions) {
  oracle::run_random_cases(default_cases, run_case, lower_bounds);
}

}  // namespace
}  // namespace cbc::plain::timeout_race_property_test
