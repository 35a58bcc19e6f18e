// Two versions of a catalog in the same random events.
#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/script/reader.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "support/read_file.h"
#include "sweep/engine/sequence.h"
#include "sweep/engine/sweep.h"
#include "sweep/report/sweep_report.h"
#include "unit/compiled_fixture.h"
#include "unit/findings.h"

namespace cbc::sweep_against_test {
namespace {

std::string quadrotor() { return test::read_file(CBC_SOURCE_DIR "/catalogs/quadrotor.yaml"); }

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

SweepSettings settings_of(std::uint64_t sequences, std::uint64_t seed) {
  SweepSettings settings;
  settings.sequences = sequences;
  settings.seed = seed;
  settings.shape.events = 40;
  settings.shape.faults = 200'000;
  return settings;
}

SweepResult run(const CompiledCatalog& new_catalog, const CompiledCatalog& old_catalog,
                const SweepSettings& settings, std::size_t jobs = 1) {
  SweepOutcome outcome = sweep(new_catalog, settings, jobs, nullptr, OldVersion{old_catalog, {}});
  EXPECT_FALSE(outcome.failure.has_value());
  outcome.result.times.reset();
  return std::move(outcome.result);
}

Script read(const CompiledCatalog& catalog, const std::string& text) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "s.yaml", diagnostics);
  auto script = document != nullptr
                    ? read_script(*document, catalog, Severity::warning, diagnostics)
                    : std::optional<Script>{};
  EXPECT_TRUE(script.has_value()) << show(diagnostics) << text;
  return script.value_or(Script{});
}

/// By step what it decided, and what ran after it, in words.
class Answers final : public RunListener {
 public:
  explicit Answers(const CompiledCatalog& catalog) : catalog_(catalog) {}
  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override {
    if (step != nullptr) answers.emplace_back();
    if (answers.empty()) return;
    if (step != nullptr) answers.back().outcome = name_of(record.outcome);
    answers.back().running.clear();
    for (const std::uint32_t task : state.running()) {
      const BehaviorId behavior = state.behavior(catalog_.task_ids[task]);
      answers.back().running[std::string(catalog_.task_names[task])] =
          catalog_.name_of_behavior(behavior);
    }
  }

  struct Answer {
    std::string outcome;
    std::map<std::string, std::string> running;
    bool operator==(const Answer&) const = default;
  };
  std::vector<Answer> answers;

 private:
  const CompiledCatalog& catalog_;
};

std::vector<Answers::Answer> answers_to(const CompiledCatalog& catalog, const std::string& script) {
  Answers answers(catalog);
  EXPECT_EQ(run_script(catalog, read(catalog, script), {}, answers).status,
            Coordinator::Status::ok);
  return answers.answers;
}

/// Runs each sequence as a script on both catalogs, and counts those with two answers.
std::uint64_t count_different(const CompiledCatalog& new_catalog,
                              const CompiledCatalog& old_catalog, const SweepSettings& settings) {
  std::uint64_t count = 0;
  for (std::uint64_t sequence = 0; sequence < settings.sequences; ++sequence) {
    Script script;
    script.steps = steps_of_sequence(new_catalog, DrawnNames(new_catalog), settings, sequence, 0);
    const std::string text = write_script(new_catalog, script, "");
    if (answers_to(new_catalog, text) != answers_to(old_catalog, text)) ++count;
  }
  return count;
}

TEST(SweepAgainst, CountsTheSequencesThatRunDifferently) {
  const std::string old_text = quadrotor();
  const CompiledCatalog old_catalog = test::compile_text(old_text);
  std::uint64_t found = 0;
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"suitability: 80", "suitability: 30"},
           {"suitability: 90", "suitability: 5"},
           {"minimum_performance: 80", "minimum_performance: 100"}}) {
    if (old_text.find(from) == std::string::npos) continue;
    const CompiledCatalog new_catalog = test::compile_text(replaced(old_text, from, to));
    for (const std::uint64_t seed : {1U, 2U}) {
      const SweepSettings settings = settings_of(30, seed);
      const SweepResult result = run(new_catalog, old_catalog, settings);
      EXPECT_EQ(result.against->sequences, count_different(new_catalog, old_catalog, settings))
          << to;
      found += result.against->sequences;
    }
  }
  EXPECT_GT(found, 0U);
}

TEST(SweepAgainst, ItsScriptsPassOnTheNewCatalogAlone) {
  const CompiledCatalog old_catalog = test::compile_text(quadrotor());
  const CompiledCatalog new_catalog =
      test::compile_text(replaced(quadrotor(), "suitability: 100", "suitability: 20"));
  const SweepResult result = run(new_catalog, old_catalog, settings_of(60, 1));
  ASSERT_FALSE(result.against->differences.empty());
  for (const SweptDifference& difference : result.against->differences) {
    SilentRun silent;
    EXPECT_EQ(run_script(new_catalog, read(new_catalog, difference.script), {}, silent).failed, 0U)
        << difference.script;
    EXPECT_EQ(run_script(old_catalog, read(old_catalog, difference.script), {}, silent).failed, 1U)
        << difference.script;
  }
}

TEST(SweepAgainst, TheSameCatalogIsAlike) {
  const CompiledCatalog catalog = test::compile_text(quadrotor());
  const SweepResult result = run(catalog, catalog, settings_of(50, 4));
  EXPECT_EQ(result.against->sequences, 0U);
  EXPECT_TRUE(result.against->differences.empty());
  EXPECT_GT(result.against->events, 1000U);
}

TEST(SweepAgainst, JobsGiveTheSameResult) {
  const CompiledCatalog old_catalog = test::compile_text(quadrotor());
  const CompiledCatalog new_catalog =
      test::compile_text(replaced(quadrotor(), "suitability: 100", "suitability: 20"));
  const SweepSettings settings = settings_of(23, 9);
  const std::string whole = sweep_to_json(run(new_catalog, old_catalog, settings));
  EXPECT_EQ(sweep_to_json(run(new_catalog, old_catalog, settings, 5)), whole);
}

// Drawn by name ----------------------------------------------------------------------------------

/// The first event of each sequence.
std::vector<std::string> first_events(const CompiledCatalog& catalog) {
  std::vector<std::string> events;
  for (std::uint64_t sequence = 0; sequence < 200; ++sequence) {
    Script script;
    script.steps =
        steps_of_sequence(catalog, DrawnNames(catalog), settings_of(200, 1), sequence, 1);
    script.steps.resize(1);
    events.push_back(write_script(catalog, script, ""));
  }
  return events;
}

TEST(SweepAgainst, ATaskThatIsAddedTakesPartInEventsOfItsOwn) {
  const std::vector<std::string> before = first_events(test::compile_text(quadrotor()));
  const std::vector<std::string> after = first_events(test::compile_text(replaced(
      replaced(quadrotor(), "\nbehaviors:\n", "\nbehaviors:\n- {behavior: WAVE_1, task: WAVE}\n"),
      "\ntasks:\n", "\ntasks:\n- task: WAVE\n")));
  std::size_t others = 0;
  for (std::size_t place = 0; place < before.size(); ++place) {
    if (before[place] == after[place]) continue;
    EXPECT_NE(after[place].find("WAVE"), std::string::npos) << before[place] << after[place];
    ++others;
  }
  EXPECT_GT(others, 0U);
  EXPECT_LT(others, before.size() / 4);
}

}  // namespace
}  // namespace cbc::sweep_against_test
