// The scripts that show counterexamples, witnesses and long random paths must be read and run as
// `cbc solve` does, and do move by move what the plain model does. CBC_SEED and CBC_PROPERTY_CASES
// are as in property_test.cpp.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "compiled_text.h"
#include "demand.h"
#include "explore/controls/witness.h"
#include "explore/properties/verification.h"
#include "generator.h"
#include "plain_model.h"
#include "random.h"
#include "random_cases.h"
#include "script_run.h"
#include "verify_case.h"
#include "yaml_text.h"

namespace cbc::plain::witness_property_test {
namespace {

using oracle::demand;
using oracle::Random;

constexpr std::uint64_t default_cases = 500;
constexpr std::uint64_t most_states = 1500;

/// What the moves do, one after the other.
struct PlainRun {
  std::vector<Happening> happenings;
  Snapshot end;
  std::optional<Outcome> outcome;  ///< of the last move
};

PlainRun run_plainly(const PlainModel& model, const std::vector<Move>& moves) {
  PlainRun run;
  run.end = model.first_state();
  for (const Move& move : moves) {
    Step step = model.step(run.end, move, &run.happenings);
    run.end = std::move(step.next);
    run.outcome = step.outcome;
  }
  return run;
}

/// Runs the text of a script; its events and its end must be those of the moves.
PlainRun check_script(const PlainModel& model, const std::vector<Move>& moves,
                      const std::string& text) {
  PlainRun expected = run_plainly(model, moves);
  const ScriptRun run = run_text(model.catalog(), text, model.tasks());
  demand(run.failures.empty(), run.failures.empty() ? "" : run.failures.front());
  const auto text_of_all = [&](const std::vector<Happening>& happenings) {
    std::string lines;
    for (const Happening& one : happenings) lines += text_of(model.catalog(), one);
    return lines;
  };
  demand(run.happenings == expected.happenings, "other events:\n" + text_of_all(run.happenings) +
                                                    "and not\n" + text_of_all(expected.happenings));
  demand(run.end == model.visible(expected.end), "another end");
  return expected;
}

bool ends_as_stated(const PlainModel& model, const Property& property, const PlainRun& run) {
  if (property.settled && !run.end.queue.empty()) return false;
  switch (property.kind) {
    case Property::Kind::can_start:
      return run.outcome == Outcome::rejected;
    case Property::Kind::always:
      return (!property.when || model.holds(*property.when, run.end)) &&
             !model.holds(property.condition, run.end);
    case Property::Kind::never:
    case Property::Kind::reachable:
      return model.holds(property.condition, run.end);
    case Property::Kind::keeps_running:
      return find_running(run.end, property.task) == nullptr;
    case Property::Kind::always_possible:
      return !(property.within == 0U && model.holds(property.condition, run.end));
  }
  return false;
}

bool has_timeout(const CompiledCatalog& catalog) {
  for (const auto& task : catalog.tasks) {
    if (task.timeout > 0) return true;
  }
  return false;
}

bool has_reactive_task_elsewhere(const CompiledCatalog& catalog,
                                 const std::vector<GroupId>& groups) {
  for (const auto& task : catalog.tasks) {
    if (task.reactive_start != 0 && !oracle::contains(groups, task.group)) return true;
  }
  return false;
}

void count_sort_of_script(const CompiledCatalog& catalog, const std::vector<Move>& moves,
                          const std::vector<GroupId>& groups, oracle::Statistics& statistics) {
  const auto count = [&](const char* what, bool happened) {
    if (happened) statistics.count(what);
  };
  const auto dues = std::count(moves.begin(), moves.end(), Move{});
  count("script", true);
  count("more than three moves", moves.size() > 3);
  count("a due", dues > 0);
  count("two dues", dues > 1);
  count("several groups", groups.size() > 1);
  count("timeouts", has_timeout(catalog));
  count("reactive tasks of other groups", has_reactive_task_elsewhere(catalog, groups));
}

/// Checks the scripts of all outcomes of all groups.
void check_outcomes(const VerifyCase& sample, std::string& text, oracle::Statistics& statistics) {
  PropertyFile file;
  file.assumptions = sample.question.assumptions;
  ExplorationOptions options;
  options.budget.max_states = most_states;
  options.outcomes = true;
  for (const Exploration& of_group :
       verify_properties(sample.catalog, file, options).explorations) {
    const PlainModel model(sample.catalog, of_group.groups, file.assumptions);
    for (const ReachableOutcome& outcome : *of_group.outcomes) {
      const Property property = property_of(sample.catalog, of_group.groups.front(), outcome);
      const Witness witness = make_witness(sample.catalog, of_group.groups, file.assumptions,
                                           outcome.script, &property, "An outcome.");
      text = witness.text;
      const PlainRun run = check_script(model, outcome.script, text);
      demand(ends_as_stated(model, property, run), "an outcome that is none");
      statistics.count("outcome");
    }
  }
}

void run_property_case(std::uint64_t seed, oracle::Results& results) {
  VerifyCase sample;
  std::string text;
  try {
    sample = generate_verify_case(seed);
    PropertyFile file;
    file.path = "landing \"x\".yaml";
    file.assumptions = sample.question.assumptions;
    file.properties = sample.question.properties;
    ExplorationOptions options;
    options.budget.max_states = most_states;
    const Verification verification = verify_properties(sample.catalog, file, options);
    for (const PropertyAnswer& answer : verification.answers) {
      demand(answer.witness.has_value() == answer.verdict.has_script, "no script for a verdict");
      if (!answer.witness) continue;
      text = answer.witness->text;
      const auto& groups = verification.explorations.at(answer.exploration.value()).groups;
      const PlainModel model(sample.catalog, groups, file.assumptions,
                             variables_of(*answer.property));
      const PlainRun run = check_script(model, answer.verdict.script, text);
      demand(ends_as_stated(model, *answer.property, run), answer.property->name + ": another end");
      count_sort_of_script(sample.catalog, answer.verdict.script, groups, results.statistics);
      if (answer.property->kind == Property::Kind::keeps_running) {
        demand(oracle::contains(answer.witness->script.steps.back().expect->stopped,
                                sample.catalog.tasks[answer.property->task].catalog_index),
               "the script does not say that the task stopped");
        results.statistics.count("does not keep running");
      }
    }
    check_outcomes(sample, text, results.statistics);
  } catch (const std::exception& error) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n--- catalog\n" +
                                        text_of(sample) + "--- script\n" + text + "--- fault\n" +
                                        error.what() + "\n"});
  }
}

const oracle::LowerBound property_bounds[] = {
    {"script", 1000},  {"more than three moves", 60}, {"a due", 100},
    {"two dues", 5},   {"several groups", 40},        {"reactive tasks of other groups", 40},
    {"timeouts", 100}, {"does not keep running", 20}, {"outcome", 5000},
};

TEST(Witness, OfAPropertyIsAScriptThatSolveRepeats) {
  oracle::run_random_cases(default_cases, run_property_case, property_bounds);
}

// Long paths -------------------------------------------------------------------------------------

/// Reactive tasks that have little to do with one another, so that they join the queue one by one.
oracle::Catalog generate_loners(Random& random) {
  oracle::Catalog catalog;
  const std::size_t count = 4 + random.below(7);
  for (std::size_t i = 0; i < count; ++i) {
    oracle::Task& task = catalog.tasks.emplace_back();
    task.name = "T" + std::to_string(i);
    task.start_on_request = false;
    task.reactive_start = true;
    if (random.percent(20)) task.timeout = 10'000;
    oracle::Behavior& behavior = catalog.behaviors.emplace_back();
    behavior.name = "B" + std::to_string(i);
    behavior.performs.push_back({i, oracle::whole_degree});
    if (i > 0 && random.percent(15)) catalog.exclusivity.push_back({i - 1, i});
  }
  return catalog;
}

/// A catalog whose tasks mostly start by themselves, and assumptions that allow everything.
VerifyCase generate_restless_case(Random& random) {
  VerifyCase sample;
  const bool are_loners = random.percent(50);
  sample.source =
      are_loners ? generate_loners(random) : oracle::generate_catalog(random, 5 + random.below(6));
  for (oracle::Task& task : sample.source.tasks) {
    if (are_loners || !task.listed || random.percent(25)) continue;
    task.start_on_request = false;
    task.reactive_start = true;
  }
  sample.yaml = oracle::catalog_yaml(sample.source, random);
  sample.catalog = oracle::compile_yaml(sample.yaml).value();
  Assumptions& assumptions = sample.question.assumptions;
  assumptions = default_assumptions(sample.catalog);
  assumptions.start.clear();
  assumptions.stop.clear();
  for (const TaskId task : sample.catalog.task_ids) {
    assumptions.start.push_back({task, {1, 2}});
    assumptions.stop.push_back(task);
  }
  assumptions.faults = static_cast<std::uint32_t>(random.below(3));
  for (const BehaviorId behavior : sample.catalog.behavior_ids) {
    if (random.percent(are_loners ? 80 : 30)) assumptions.behaviors.push_back(behavior);
  }
  for (GroupId group(0); group < sample.catalog.group_count(); ++group) {
    if (random.percent(80)) sample.question.groups.push_back(group);
  }
  if (sample.question.groups.empty()) sample.question.groups.emplace_back(0);
  return sample;
}

/// Random moves, most of which change something.
std::vector<Move> walk(Random& random, const PlainModel& model, std::size_t length,
                       std::size_t& longest_queue) {
  static const std::vector<std::size_t> chances_of_due = {2, 6, 15};
  const std::size_t chance_of_due = random.pick(chances_of_due);
  std::vector<Move> path;
  Snapshot state = model.first_state();
  while (path.size() < length) {
    const std::vector<Move> moves = model.moves(state);
    if (moves.empty()) break;
    const bool is_due = !state.queue.empty() && random.percent(chance_of_due);
    const Move move = is_due ? moves.back() : random.pick(moves);
    if (move.kind == Move::Kind::due && !is_due) continue;
    Snapshot next = model.step(state, move).next;
    const bool changes = model.key(next) != model.key(state);
    if (!changes && !random.percent(10)) {
      if (random.percent(1)) break;
      continue;
    }
    path.push_back(move);
    state = std::move(next);
    longest_queue = std::max(longest_queue, PlainModel::sets_of_queue(state).size());
  }
  return path;
}

void run_long_case(std::uint64_t seed, oracle::Results& results) {
  VerifyCase sample;
  std::string text;
  try {
    Random random(seed);
    sample = generate_restless_case(random);
    const PlainModel model(sample.catalog, sample.question.groups, sample.question.assumptions);
    std::size_t longest_queue = 0;
    const std::vector<Move> moves = walk(random, model, 30 + random.below(31), longest_queue);
    const Witness witness = make_witness(sample.catalog, sample.question.groups,
                                         sample.question.assumptions, moves, nullptr, "A path.");
    text = witness.text;
    check_script(model, moves, text);
    const auto dues = std::count(moves.begin(), moves.end(), Move{});
    const auto count = [&](const char* what, bool happened) {
      if (happened) results.statistics.count(what);
    };
    count("30 moves", moves.size() >= 30);
    count("3 dues", dues >= 3);
    count("3 sets in the queue", longest_queue >= 3);
    count("5 sets in the queue", longest_queue >= 5);
    count("finer times",
          std::any_of(witness.script.steps.begin(), witness.script.steps.end(),
                      [](const cbc::Step& step) { return step.time.value_or(0) % 10'000 != 0; }));
  } catch (const std::exception& error) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n--- catalog\n" +
                                        text_of(sample) + "--- script\n" + text + "--- fault\n" +
                                        error.what() + "\n"});
  }
}

const oracle::LowerBound long_bounds[] = {
    {"30 moves", 600},           {"3 dues", 250},     {"3 sets in the queue", 250},
    {"5 sets in the queue", 10}, {"finer times", 20},
};

TEST(Witness, OfALongPathIsAScriptThatSolveRepeats) {
  oracle::run_random_cases(default_cases, run_long_case, long_bounds);
}

}  // namespace
}  // namespace cbc::plain::witness_property_test
