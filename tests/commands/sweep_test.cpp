#include "sweep/engine/sweep.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <variant>
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

/// Runs the shards, writes and reads them, and merges them in a random order.
std::string merge_shards(const CompiledCatalog& catalog, SweepSettings settings,
                         std::uint64_t count, test::Random& random) {
  std::vector<std::uint64_t> order;
  for (std::uint64_t index = 1; index <= count; ++index) order.push_back(index);
  for (std::size_t left = order.size(); left > 1; --left) {
    std::swap(order[left - 1], order[random.below(left)]);
  }
  SweepMerger merger;
  settings.shard.count = count;
  for (const std::uint64_t index : order) {
    settings.shard.index = index;
    auto read = sweep_from_json(sweep_to_json(run(catalog, settings)));
    if (const auto* const fault = std::get_if<std::string>(&read)) return *fault;
    if (const auto error = merger.add(std::get<SweepResult>(std::move(read)), "f")) return *error;
  }
  if (const auto missing = merger.find_missing()) return *missing;
  return sweep_to_json(merger.take());
}

TEST(Sweep, ShardsMergeToTheBytesOfOneRun) {
  test::Random random(1);
  for (const CompiledCatalog& catalog : {quadrotor(), restless()}) {
    const std::string whole = sweep_to_json(run(catalog, settings_of(23, 9)));
    for (const std::uint64_t count : {1U, 2U, 3U, 7U, 23U, 30U}) {
      EXPECT_EQ(merge_shards(catalog, settings_of(23, 9), count, random), whole) << count;
    }
  }
}

TEST(Sweep, ShardsHaveEverySequenceOnce) {
  for (const std::uint64_t sequences : {1U, 5U, 12U, 1'000'000'007U}) {
    for (const std::uint64_t count : {1U, 2U, 5U, 13U, 1000U}) {
      SweepSettings settings = settings_of(sequences, 1);
      settings.shard.count = count;
      std::uint64_t next = 0;
      for (settings.shard.index = 1; settings.shard.index <= count; ++settings.shard.index) {
        const SequenceRange range = sequences_of(settings);
        EXPECT_EQ(range.first, next);
        EXPECT_LE(range.end - range.first, sequences / count + 1);
        next = range.end;
      }
      EXPECT_EQ(next, sequences);
    }
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
    if (static_cast<SweepKind>(kind) == SweepKind::lost) continue;  // takes rare coincidences
    EXPECT_GT(counts.accepted + counts.rejected + counts.unchanged, 0U)
        << name_of(static_cast<SweepKind>(kind));
  }
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

// Shards that do not fit -------------------------------------------------------------------------

std::string merge_error(const SweepResult& first, const SweepResult& second) {
  SweepMerger merger;
  EXPECT_EQ(merger.add(first, "a"), std::nullopt);
  if (const auto error = merger.add(second, "b")) return *error;
  return merger.find_missing().value_or("");
}

TEST(SweepMerger, RefusesWhatDoesNotBelongTogether) {
  const CompiledCatalog catalog = quadrotor();
  SweepSettings settings = settings_of(8, 1);
  settings.shard = {1, 3};
  const SweepResult first = run(catalog, settings);
  const auto with = [&](auto change) {
    SweepResult other = first;
    other.settings.shard.index = 2;
    change(other);
    return merge_error(first, other);
  };
  const auto of = [](const std::string& what) { return "'b' does not belong to 'a': " + what; };
  EXPECT_EQ(with([](SweepResult&) {}), "a shard of the sweep is missing: 3/3");
  EXPECT_EQ(with([](SweepResult& r) { r.settings.shard.index = 1; }),
            "'b' is shard 1/3 again, after 'a'");
  EXPECT_EQ(with([](SweepResult& r) { r.settings.seed = 2; }), of("its seed is 2, not 1"));
  EXPECT_EQ(with([](SweepResult& r) { r.settings.sequences = 9; }),
            of("its number of sequences is 9, not 8"));
  EXPECT_EQ(with([](SweepResult& r) { r.settings.shard.count = 4; }),
            of("its number of shards is 4, not 3"));
  EXPECT_EQ(with([](SweepResult& r) { r.settings.shape.events = 1; }), of("it has other options"));
  EXPECT_EQ(with([](SweepResult& r) { r.settings.search.max_nodes = 1; }),
            of("it has other options"));
  EXPECT_EQ(with([](SweepResult& r) { r.digest = "x"; }), of("it is for another catalog"));
  EXPECT_EQ(with([](SweepResult& r) { r.task_names.pop_back(); }), of("it is for another catalog"));
  EXPECT_EQ(with([](SweepResult& r) { r.version = "9"; }),
            of("its version of cbc is '9', not '" + first.version + "'"));
  EXPECT_EQ(with([](SweepResult& r) { r.times.emplace(); }),
            of("only one of them was made with '--stats'"));
}

TEST(SweepMerger, NamesTheFirstMissingShards) {
  SweepSettings settings = settings_of(8, 1);
  settings.shard = {2, 40};
  SweepMerger merger;
  EXPECT_EQ(merger.add(run(quadrotor(), settings), "a"), std::nullopt);
  EXPECT_EQ(merger.find_missing(),
            "shards of the sweep are missing: 1/40, 3/40, 4/40, 5/40, 6/40, 7/40, 8/40, 9/40, "
            "10/40, 11/40 and 29 more");
}

// Files that are no shards -----------------------------------------------------------------------

/// Of a small catalog, so that there are few values of each kind, with reasons of every kind.
Json small_shard() {
  const CompiledCatalog catalog = test::compile_text(R"(
behaviors:
- {behavior: walk, task: WALK, requires: [{task: SEE, minimum_performance: 60}]}
- {behavior: creep, task: WALK, suitability: 70, requires: [{task: SEE}, {task: LIGHT}]}
- {behavior: camera, task: SEE, suitability: 50}
- {behavior: radar, task: SEE}
- {behavior: lamp, task: LIGHT}
- {behavior: rest, task: REST}
tasks:
- {task: SEE, start_on_request: false}
- {task: FLY}
exclusivity_constraints:
- mutually_exclusive: [WALK, REST]
)");
  SweepSettings settings = settings_of(6, 1);
  settings.shard = {1, 2};
  SweepOutcome outcome = sweep(catalog, settings, 1, nullptr);
  SweepTimes& times = outcome.result.times.value();
  times.events = {};  // each event has a time of its own
  for (const std::uint64_t time : {std::uint64_t{7}, std::uint64_t{8}, times.slowest->cost}) {
    times.events.add(time);
  }
  Json shard = Json::parse(sweep_to_json(outcome.result));
  std::set<std::string> kinds;
  for (const Json& reason : shard["reasons"]) kinds.insert(reason["kind"]);
  EXPECT_EQ(kinds.size(), 9U) << shard["reasons"];
  return shard;
}

bool is_refused(const Json& json) {
  auto read = sweep_from_json(json.dump());
  if (std::holds_alternative<std::string>(read)) {
    EXPECT_FALSE(std::get<std::string>(read).empty());
    return true;
  }
  // What is taken can be merged and reported.
  SweepMerger merger;
  const SweepResult& result = std::get<SweepResult>(read);
  EXPECT_EQ(merger.add(result, "a"), std::nullopt);
  EXPECT_FALSE(sweep_to_text(result, plain_style()).empty());
  EXPECT_FALSE(sweep_to_json(merger.take()).empty());
  return false;
}

/// Calls with every value in a tree.
void for_each_value(Json& json, const std::function<void(Json&)>& call) {
  call(json);
  if (!json.is_structured()) return;
  for (Json& item : json) for_each_value(item, call);
}

TEST(SweepJson, ValuesOfWrongTypesAreRefused) {
  Json shard = small_shard();
  ASSERT_FALSE(is_refused(shard));
  const std::vector<Json> others{nullptr,
                                 true,
                                 -1,
                                 0.5,
                                 "x",
                                 UINT64_MAX,
                                 Json::array(),
                                 Json::object(),
                                 Json::array({1, 2, 3})};
  std::size_t refused = 0;
  std::size_t taken = 0;
  for_each_value(shard, [&](Json& value) {
    Json kept = value;
    for (const Json& other : others) {
      value = other;
      ++(is_refused(shard) ? refused : taken);
    }
    value = std::move(kept);
  });
  EXPECT_FALSE(is_refused(shard));
  // Taken is little: texts for texts, numbers for numbers that nothing tells from the right ones,
  // and what is worked out anew.
  EXPECT_GT(refused, 6 * taken);
  for (const char* const name :
       {"schema", "catalog", "digest", "version", "sequences", "seed", "options", "shard", "events",
        "tasks", "behaviors", "reasons", "nodes", "slowest", "stats"}) {
    Json lacking = shard;
    lacking[name] = false;
    EXPECT_TRUE(is_refused(lacking)) << name;
    if (std::string(name) == "stats") continue;
    lacking.erase(name);
    EXPECT_TRUE(is_refused(lacking)) << name;
  }
}

TEST(SweepJson, NumbersThatAreTooLargeAreRefused) {
  const Json shard = small_shard();
  for (const char* const member :
       {"/events/0/accepted", "/tasks/3/runs", "/reasons/0/count", "/behaviors/0/activations",
        "/nodes/histogram/0/1", "/slowest/event", "/shard/count", "/options/priorities"}) {
    Json changed = shard;
    const Json::json_pointer place{std::string(member)};
    changed[place] = largest_count + 1;
    EXPECT_TRUE(is_refused(changed)) << member;
  }
}

TEST(SweepJson, TextThatIsCutOffIsRefused) {
  const std::string text = small_shard().dump();
  for (std::size_t size = 0; size < text.size(); size += 31) {
    EXPECT_TRUE(std::holds_alternative<std::string>(sweep_from_json(text.substr(0, size))));
  }
  EXPECT_TRUE(std::holds_alternative<std::string>(sweep_from_json(text + "x")));
  EXPECT_TRUE(std::holds_alternative<std::string>(
      sweep_from_json(std::string(1'000'000, '[') + std::string(1'000'000, ']'))));
  EXPECT_TRUE(std::holds_alternative<std::string>(sweep_from_json(std::string(1'000'000, '['))));
  EXPECT_TRUE(std::holds_alternative<std::string>(sweep_from_json("\xff\xfe")));
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
