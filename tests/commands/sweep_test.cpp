#include "sweep/engine/sweep.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/report/event_json.h"
#include "core/script/reader.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "support/read_file.h"
#include "sweep/engine/sequence.h"
#include "sweep/report/sweep_report.h"
#include "unit/compiled_fixture.h"
#include "unit/findings.h"
#include "unit/random_mission.h"

namespace cbc::sweep_test {
namespace {

using Json = nlohmann::ordered_json;

CompiledCatalog quadrotor() {
  return test::compile_text(test::read_file(CBC_SOURCE_DIR "/catalogs/quadrotor.yaml"));
}

CompiledCatalog restless() {
  test::Random random(5);
  return test::restless_catalog(random, 12);
}

SweepSettings settings_of(std::uint64_t sequences, std::uint64_t seed) {
  SweepSettings settings;
  settings.sequences = sequences;
  settings.seed = seed;
  settings.shape.events = 60;
  settings.shape.faults = 200'000;
  return settings;
}

SweepResult run(const CompiledCatalog& catalog, const SweepSettings& settings, unsigned jobs = 1) {
  SweepOutcome outcome = sweep(catalog, settings, jobs, nullptr);
  EXPECT_FALSE(outcome.failure.has_value());
  outcome.result.times.reset();
  return std::move(outcome.result);
}

// The same result, however it is come by -------------------------------------------------------

TEST(Sweep, DoesNotDependOnTheJobs) {
  for (const CompiledCatalog& catalog : {quadrotor(), restless()}) {
    const std::string alone = sweep_to_json(run(catalog, settings_of(40, 3)));
    for (const unsigned jobs : {2U, 3U, 64U}) {
      EXPECT_EQ(sweep_to_json(run(catalog, settings_of(40, 3), jobs)), alone) << jobs;
    }
    EXPECT_NE(sweep_to_json(run(catalog, settings_of(40, 4))), alone);
  }
}

TEST(Sweep, PartsAddUpToTheWhole) {
  for (const CompiledCatalog& catalog : {quadrotor(), restless()}) {
    const SweepResult whole = run(catalog, settings_of(23, 9));
    SweepResult sum = whole;
    sum.counts = SweepCounts(catalog.tasks.size(), catalog.behaviors.size());
    sum.nodes = {};
    SweepSettings settings = settings_of(1, 9);
    for (const std::uint64_t next : {1U, 8U, 9U, 23U}) {
      settings.sequences = next - settings.first;
      const SweepResult part = run(catalog, settings);
      sum.counts.add(part.counts);
      sum.nodes.add(part.nodes);
      settings.first = next;
    }
    EXPECT_EQ(sweep_to_json(sum), sweep_to_json(whole));
  }
}

// Counted again, from the JSON of the sequences run as scripts -----------------------------------

/// Counts as the documentation says, and knows nothing of records.
class Recount final : public RunListener {
 public:
  explicit Recount(const CompiledCatalog& catalog) : catalog_(catalog) {}

  void begin_sequence() {
    running_ = Json::object();
    requests_ = Json::object();
  }
  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override {
    std::string text;
    append_event(text, catalog_, record, step, state, {});
    count(Json::parse(text));
  }
  void on_failure(const Failure& /*failure*/) override { ADD_FAILURE(); }
  void on_end(const State& /*state*/) override {}

  std::map<std::string, std::map<std::string, std::uint64_t>> outcomes;
  std::map<std::string, std::uint64_t> runs, activations, failures, starts, rejected, reasons;
  std::map<std::uint64_t, std::uint64_t> nodes;

 private:
  static std::string kind_of(const Json& event) {
    const std::string origin = event["origin"];
    if (origin == "timeout") return "timeout";
    if (origin == "reactive") return "reactive_start";
    if (origin == "fault") return "finish_lost";
    if (event["verb"] != "finish") return event["verb"];
    if (event["cause"] == "goal_achieved") return "finish_success";
    return event["cause"] == "situation_change" ? "finish_situation_change" : "finish_failure";
  }

  void count(const Json& event) {
    const std::string kind = kind_of(event);
    const std::string outcome = event["outcome"];
    ++outcomes[kind][outcome];
    if (outcome == "accepted" && event["verb"] == "finish") {
      std::int64_t first = 0;
      for (const auto& [task, behavior] : running_.items()) {
        if (behavior == event["name"] && requests_.contains(task)) {
          first = std::max(first, requests_[task].get<std::int64_t>());
        }
      }
      if (event["search"]["protection"].get<std::int64_t>() > first) ++outcomes[kind]["escalated"];
    }
    if (kind == "start") ++(outcome == "accepted" ? starts : rejected)[event["name"]];
    for (const Json& change : event["changes"]) {
      if (change["op"] != "activate" || change["cause"] == "undone") continue;
      ++(change["success"].get<bool>() ? activations : failures)[change["behavior"]];
    }
    for (const auto& [task, behavior] : event["running"].items()) {
      if (!running_.contains(task)) ++runs[task];
    }
    for (const Json& reason : event["conflict"]) {
      Json key = reason;
      for (const char* const member : {"priority", "line", "best", "message"}) key.erase(member);
      ++reasons[key.dump()];
    }
    if (!event["search"].is_null()) ++nodes[event["search"]["nodes"].get<std::uint64_t>()];
    running_ = event["running"];
    requests_ = event["requests"];
  }

  const CompiledCatalog& catalog_;
  Json running_;
  Json requests_;
};

Script read(const CompiledCatalog& catalog, const std::string& text) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "s.yaml", diagnostics);
  auto script = document != nullptr
                    ? read_script(*document, catalog, Severity::warning, diagnostics)
                    : std::optional<Script>{};
  EXPECT_TRUE(script.has_value()) << show(diagnostics) << text;
  return script.value_or(Script{});
}

std::uint64_t at(const std::map<std::string, std::uint64_t>& counts, const std::string& name) {
  const auto found = counts.find(name);
  return found == counts.end() ? 0 : found->second;
}

Script script_of(std::vector<Step> steps) {
  Script script;
  script.steps = std::move(steps);
  return script;
}

void expect_recounted(const CompiledCatalog& catalog, const SweepSettings& settings) {
  Recount recount(catalog);
  for (std::uint64_t sequence = 0; sequence < settings.sequences; ++sequence) {
    recount.begin_sequence();
    const auto steps = steps_of_sequence(catalog, DrawnNames(catalog), settings, sequence, 0);
    EXPECT_EQ(steps.size(), settings.shape.events);
    const Script script = read(catalog, write_script(catalog, script_of(steps), ""));
    EXPECT_EQ(run_script(catalog, script, {}, recount, {.rejections = true}).status,
              Coordinator::Status::ok);
  }
  const Json found = Json::parse(sweep_to_json(run(catalog, settings, 2)));
  for (const Json& item : found["events"]) {
    for (const char* const outcome : {"accepted", "escalated", "rejected", "unchanged"}) {
      EXPECT_EQ(item[outcome], at(recount.outcomes[item["kind"]], outcome)) << item << outcome;
    }
  }
  std::vector<std::string> never_ran;
  for (const Json& item : found["tasks"]) {
    EXPECT_EQ(item["started"], at(recount.starts, item["task"]));
    EXPECT_EQ(item["rejected"], at(recount.rejected, item["task"]));
    EXPECT_EQ(item["runs"], at(recount.runs, item["task"])) << item;
    if (!recount.runs.contains(item["task"])) never_ran.push_back(item["task"]);
  }
  EXPECT_EQ(found["never_ran"], Json(never_ran));
  std::vector<std::string> never_active;
  for (const Json& item : found["behaviors"]) {
    EXPECT_EQ(item["activations"], at(recount.activations, item["behavior"]));
    EXPECT_EQ(item["failures"], at(recount.failures, item["behavior"]));
    if (!recount.activations.contains(item["behavior"])) never_active.push_back(item["behavior"]);
  }
  EXPECT_EQ(found["never_active"], Json(never_active));
  std::map<std::string, std::uint64_t> reasons;
  for (Json item : found["reasons"]) {
    const auto count = item["count"].get<std::uint64_t>();
    item.erase("count");
    reasons[item.dump()] = count;
  }
  EXPECT_EQ(reasons, recount.reasons);
  Json histogram = Json::array();
  for (const auto& [number, count] : recount.nodes) histogram.push_back({number, count});
  EXPECT_EQ(found["nodes"]["histogram"], histogram);
  EXPECT_EQ(found["slowest"]["nodes"], recount.nodes.rbegin()->first);
}

TEST(Sweep, CountsWhatTheScriptsOfItsSequencesDo) {
  expect_recounted(quadrotor(), settings_of(30, 2));
  expect_recounted(restless(), settings_of(30, 2));
}

// What is drawn ----------------------------------------------------------------------------------

TEST(Sweep, MakesEventsOfAllKinds) {
  const SweepResult result = run(restless(), settings_of(200, 1));
  for (std::size_t kind = 0; kind < sweep_kinds; ++kind) {
    const OutcomeCounts& counts = result.counts.events[kind];
    if (static_cast<SweepKind>(kind) == SweepKind::lost) continue;        // takes rare coincidences
    if (static_cast<SweepKind>(kind) == SweepKind::reconsider) continue;  // takes a key
    EXPECT_GT(counts.accepted + counts.rejected + counts.unchanged, 0U)
        << name_of(static_cast<SweepKind>(kind));
  }
}

TEST(Sweep, CountsGroupsThatAreReconsidered) {
  const CompiledCatalog catalog = test::compile_text(
      "situation: [{variable: LIGHT}]\n"
      "tasks: [{task: LOCALIZE, improve: at_once}]\n"
      "behaviors:\n"
      "- {behavior: CAMERA, task: LOCALIZE, situation: {LIGHT: true}}\n"
      "- {behavior: ODOMETRY, task: LOCALIZE, suitability: 50}\n");
  const SweepResult result = run(catalog, settings_of(50, 1));
  const auto kind = static_cast<std::size_t>(SweepKind::reconsider);
  EXPECT_GT(result.counts.events[kind].accepted, 0U);
}

TEST(Sweep, KeepsToItsShape) {
  SweepSettings settings = settings_of(50, 1);
  settings.shape = {17, 1, 0, 0};
  const CompiledCatalog catalog = quadrotor();
  const SweepResult result = run(catalog, settings);
  std::uint64_t scripted = 0;
  for (const SweepKind kind : {SweepKind::start, SweepKind::stop, SweepKind::success}) {
    const OutcomeCounts& counts = result.counts.events[static_cast<std::size_t>(kind)];
    scripted += counts.accepted + counts.rejected + counts.unchanged;
  }
  EXPECT_EQ(scripted, 50U * 17U);  // none is a failure or a fault
  for (std::uint64_t sequence = 0; sequence < 50; ++sequence) {
    for (const Step& step :
         steps_of_sequence(catalog, DrawnNames(catalog), settings, sequence, 0)) {
      EXPECT_EQ(step.priority.value_or(1), 1);
    }
  }
  settings.shape = {17, 9, one_million, one_million};
  const SweepResult broken = run(catalog, settings);
  EXPECT_EQ(broken.counts.events[static_cast<std::size_t>(SweepKind::start)].accepted, 0U);
}

TEST(Sweep, WritesAllowedNumbersInTheirShortestForm) {
  const CompiledCatalog catalog = test::compile_text(R"(
tasks:
- {task: A, parameters: [{parameter: p, allowed_values: [0.50, 1e3]}]}
behaviors:
- {behavior: a, task: A}
)");
  SweepSettings settings;
  settings.shape.events = 400;  // one of 16 starts has parameters
  const std::string script = write_script(
      catalog, script_of(steps_of_sequence(catalog, DrawnNames(catalog), settings, 0, 0)), "");
  EXPECT_NE(script.find("\"p\":0.5}"), std::string::npos) << script;
  EXPECT_NE(script.find("\"p\":1000.0}"), std::string::npos) << script;
  EXPECT_EQ(script.find("0.50"), std::string::npos);
  EXPECT_EQ(script.find("1e3"), std::string::npos);
}

TEST(Sweep, DrawsTheSameNumbersOnEveryMachine) {
  // Worked out apart, by the published algorithm of SplitMix64.
  RandomSource first(1, 0);
  EXPECT_EQ(first.next(), 0x6ec85f1f8547bc0cU);
  EXPECT_EQ(first.next(), 0x6cf63afcc21a470aU);
  EXPECT_EQ(RandomSource(1, 1).next(), 0xbd17853175c4f325U);
  EXPECT_EQ(RandomSource(UINT64_MAX, UINT64_MAX).next(), 0x082ee7e0af5462c6U);
  RandomSource digits(7, 3);
  std::vector<std::uint32_t> drawn;
  drawn.reserve(8);
  for (int count = 0; count < 8; ++count) drawn.push_back(digits.below(10));
  EXPECT_EQ(drawn, (std::vector<std::uint32_t>{0, 9, 8, 8, 2, 4, 7, 7}));
}

// Scripts ----------------------------------------------------------------------------------------

/// The nodes of an event of a run.
class NodesOf final : public RunListener {
 public:
  explicit NodesOf(std::uint64_t index) : index_(index) {}
  void on_event(const ExplainedRecord& record, const Step* /*step*/, const State&) override {
    if (record.index == index_ && record.search != nullptr) nodes = record.search->result.nodes;
  }
  void on_failure(const Failure& /*failure*/) override {}
  void on_end(const State& /*state*/) override {}

  std::uint64_t nodes = UINT64_MAX;

 private:
  const std::uint64_t index_;
};

TEST(Sweep, WritesAScriptThatReproducesTheSlowestEvent) {
  for (const CompiledCatalog& catalog : {quadrotor(), restless()}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const SweepResult result = run(catalog, settings_of(10, seed));
      ASSERT_TRUE(result.slowest.has_value());
      const Script script = read(catalog, result.slowest->script);
      NodesOf nodes(result.slowest->event);
      EXPECT_EQ(run_script(catalog, script, {}, nodes).status, Coordinator::Status::ok);
      EXPECT_EQ(nodes.nodes, result.slowest->cost) << result.slowest->script;
      EXPECT_LE(script.steps.size(), result.slowest->event + 1);  // none but the last comes later
    }
  }
}

TEST(Sweep, EndsAtTheFirstSequenceThatFails) {
  SweepSettings settings = settings_of(60, 1);
  const CompiledCatalog catalog = restless();
  settings.search.max_clock_events = 20;
  const SweepOutcome alone = sweep(catalog, settings, 1, nullptr);
  ASSERT_TRUE(alone.failure.has_value());
  EXPECT_EQ(alone.failure->status, Coordinator::Status::too_many_clock_events);
  const SweepOutcome several = sweep(catalog, settings, 4, nullptr);
  ASSERT_TRUE(several.failure.has_value());
  EXPECT_EQ(several.failure->sequence, alone.failure->sequence);
  EXPECT_EQ(several.failure->script, alone.failure->script);
  CoordinatorOptions options;
  options.max_clock_events = 20;
  NodesOf ignored(0);
  EXPECT_EQ(run_script(catalog, read(catalog, alone.failure->script), options, ignored).status,
            Coordinator::Status::too_many_clock_events);
}

TEST(SweepHistogram, HasThePercentilesOfASortedList) {
  test::Random random(3);
  for (const std::size_t size : {1U, 2U, 3U, 99U, 100U, 101U, 1000U}) {
    Histogram histogram;
    std::vector<std::uint64_t> numbers;
    for (std::size_t count = 0; count < size; ++count) numbers.push_back(random.below(900));
    for (const std::uint64_t number : numbers) histogram.add(number);
    std::sort(numbers.begin(), numbers.end());
    const auto share = [&](std::uint64_t most) {  // of the numbers up to `most`, in percent
      return 100.0 *
             static_cast<double>(std::upper_bound(numbers.begin(), numbers.end(), most) -
                                 numbers.begin()) /
             static_cast<double>(size);
    };
    EXPECT_GE(share(histogram.median()), 50);
    EXPECT_TRUE(histogram.median() == numbers.front() || share(histogram.median() - 1) < 50);
    EXPECT_GE(share(histogram.percentile_99()), 99);
    EXPECT_TRUE(histogram.percentile_99() == numbers.front() ||
                share(histogram.percentile_99() - 1) < 99);
    EXPECT_EQ(histogram.maximum(), numbers.back());
    EXPECT_EQ(histogram.total(), size);
  }
}

TEST(SweepHistogram, RoundsLargeNumbersALittle) {
  EXPECT_EQ(Histogram::round_down(1023), 1023U);
  EXPECT_EQ(Histogram::round_down(1025), 1024U);
  EXPECT_EQ(Histogram::round_down(UINT64_MAX), UINT64_MAX << 54U);
  std::set<std::uint64_t> buckets;
  for (std::uint64_t number = 1; number < 1'000'000; number += 7) {
    const std::uint64_t rounded = Histogram::round_down(number);
    EXPECT_LE(rounded, number);
    EXPECT_LE(number - rounded, number / 512);
    EXPECT_EQ(Histogram::round_down(rounded), rounded);
    buckets.insert(rounded);
  }
  EXPECT_LT(buckets.size(), 7'000U);
}

}  // namespace
}  // namespace cbc::sweep_test
