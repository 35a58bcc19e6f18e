// Random catalogs and missions with an expectation: the tolerance of each number must be what the
// oracle says of the catalog with other numbers, at the bounds, one step beyond them, and inside;
// the same of the values that repair the expectation. CBC_SEED and CBC_PROPERTY_CASES are as in
// property_test.cpp.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "catalog_changes.h"
#include "core/compile/compile.h"
#include "core/script/reader.h"
#include "demand.h"
#include "generator.h"
#include "oracle.h"
#include "random_cases.h"
#include "read_yaml.h"
#include "tune/engine/numbers.h"
#include "tune/engine/tuner.h"
#include "yaml_text.h"

namespace cbc::oracle::tune_property_test {
namespace {

using nlohmann::ordered_json;

constexpr std::uint64_t default_cases = 60;
constexpr std::size_t numbers_per_case = 4;
constexpr std::size_t values_inside = 4;

/// What the oracle makes of a mission.
struct Run {
  ordered_json events;  // of each what was decided
  Assignment values;    // at the last event of the script

  bool operator==(const Run&) const = default;
};

/// A mission, and a catalog whose numbers may be changed.
class Sample {
 public:
  explicit Sample(Case sample) : sample_(std::move(sample)) {}

  void set(const TunableNumber& number, std::int64_t value) {
    for (const TunableNumber::Use& use : number.uses) {
      if (use.behavior == cbc::none) {
        sample_.catalog.tasks[use.task].minimum = value;
        continue;
      }
      Behavior& behavior = sample_.catalog.behaviors[use.behavior];
      if (number.kind == TunableNumber::Kind::suitability) {
        Performance& performance = behavior.performs.at(use.entry);
        demand(performance.task == use.task, "another task");
        performance.suitability = value;
      } else {
        Requirement& requirement = behavior.requirements.at(use.entry);
        demand(requirement.task == use.task, "another task");
        requirement.minimum = value;
      }
    }
  }

  [[nodiscard]] Run run() const {
    Oracle oracle(std::make_shared<const CatalogFacts>(sample_.catalog), sample_.script, nullptr);
    for (const Event& event : sample_.script.events) oracle.handle(event);
    Run run;
    run.values = oracle.state().values;
    oracle.finish();
    for (ordered_json event : oracle.events()) {
      for (const char* const key :
           {"index", "objective", "search", "stopped_tasks", "requests", "queue"}) {
        event.erase(key);
      }
      run.events.push_back(std::move(event));
    }
    return run;
  }
  [[nodiscard]] Run run_with(const TunableNumber& number, std::int64_t value) const {
    Sample changed = *this;
    changed.set(number, value);
    return changed.run();
  }

 private:
  Case sample_;
};

/// What is read from the texts of a case.
struct Files {
  CatalogReading reading;
  cbc::Script mission;
};

Files read_files(const Case& sample, Random& forms) {
  Files files;
  files.reading = read_yaml(
      catalog_yaml(sample.catalog, forms),
      [](const auto& document, auto& found) { return understand_catalog(document, found); });
  const CompiledCatalog compiled = compile(files.reading.catalog);
  files.mission = *read_yaml(script_yaml(sample.catalog, sample.script, forms),
                             [&](const auto& document, auto& found) {
                               return read_script(document, compiled, Severity::note, found);
                             });
  return files;
}

/// That exactly these tasks run, with these behaviors.
void expect(const Assignment& values, cbc::Script& mission) {
  Step& step = mission.steps.emplace_back();
  step.range.begin.line = 1'000'000;
  Expectation& expectation = step.expect.emplace();
  for (std::uint32_t task = 0; task < values.size(); ++task) {
    if (values[task] == none) {
      expectation.stopped.push_back(task);
    } else {
      expectation.running.push_back({task, {static_cast<std::uint32_t>(values[task])}});
    }
  }
}

/// Compares the answers about one number with the oracle.
class NumberCheck {
 public:
  NumberCheck(const Sample& sample, const TunableNumber& number, const Assignment& expected,
              Random& random, Statistics& statistics)
      : sample_(sample),
        number_(number),
        expected_(expected),
        random_(random),
        statistics_(statistics),
        present_(sample.run()) {}

  void check(const Tolerance& tolerance) {
    const auto is_same = [&](std::int64_t value) {
      return sample_.run_with(number_, value) == present_;
    };
    demand(tolerance.values.low <= number_.value && number_.value <= tolerance.values.high,
           "the value is outside");
    check_inside(tolerance.values, is_same, "the tolerance");
    check_beyond(tolerance.values, is_same, "the tolerance");
    demand(tolerance.below.has_value() == (tolerance.values.low > 0), "below");
    demand(tolerance.above.has_value() == (tolerance.values.high < one_million), "above");
    for (const auto& [value, difference] :
         {std::pair(tolerance.values.low - 1, &tolerance.below),
          std::pair(tolerance.values.high + 1, &tolerance.above)}) {
      if (!*difference) continue;
      check_difference(sample_.run_with(number_, value), **difference);
      count("bound of a tolerance");
    }
    if (!tolerance.below && !tolerance.above) count("no bound");
  }

  void check(const Repairs& repairs) {
    const auto holds = [&](std::int64_t value) {
      return sample_.run_with(number_, value).values == expected_;
    };
    demand(repairs.is_complete, "incomplete");
    std::int64_t next = 0;
    for (const NumberRepair& repair : repairs.intervals) {
      check_inside(repair.values, holds, "a repair");
      check_beyond(repair.values, holds, "a repair");
      demand(repair.nearest == std::clamp(number_.value, repair.values.low, repair.values.high),
             "the nearest value");
      check_outside(next, std::int64_t{repair.values.low} - 1, holds);
      next = std::int64_t{repair.values.high} + 1;
      count("repair");
    }
    check_outside(next, whole_degree, holds);
    if (repairs.intervals.size() > 1) count("several intervals");
  }

 private:
  void count(const char* what) {
    statistics_.count(what);
    if (number_.uses.size() > 1) statistics_.count(std::string(what) + " of several pairs");
    if (number_.kind == TunableNumber::Kind::minimum_performance) {
      statistics_.count(std::string(what) + " of a minimum");
    }
  }
  template <typename Holds>
  void check_inside(const Interval& values, const Holds& holds, const std::string& what) {
    demand(holds(values.low) && holds(values.high), what + " does not hold at its ends");
    for (std::size_t count = 0; count < values_inside; ++count) {
      const std::int64_t value = random_.between(values.low, values.high);
      demand(holds(value), what + " does not hold at " + std::to_string(value));
    }
  }
  template <typename Holds>
  static void check_beyond(const Interval& values, const Holds& holds, const std::string& what) {
    if (values.low > 0) demand(!holds(std::int64_t{values.low} - 1), what + " goes on below");
    if (values.high < one_million) {
      demand(!holds(std::int64_t{values.high} + 1), what + " goes on above");
    }
  }
  template <typename Holds>
  void check_outside(std::int64_t first, std::int64_t last, const Holds& holds) {
    if (first > last) return;
    for (std::size_t count = 0; count < values_inside; ++count) {
      const std::int64_t value = random_.between(first, last);
      demand(!holds(value), "there is a repair at " + std::to_string(value));
    }
  }
  void check_difference(const Run& beyond, const RunDifference& difference) const {
    std::size_t first = 0;
    while (first < present_.events.size() && first < beyond.events.size() &&
           present_.events[first] == beyond.events[first]) {
      ++first;
    }
    demand(difference.event == first + 1, "the first event that differs");
    demand(difference.before.has_value() == (first < present_.events.size()), "the event before");
    demand(difference.now.has_value() == (first < beyond.events.size()), "the event beyond");
    const bool was_met = present_.values == expected_;
    demand(difference.failure.has_value() == (was_met && beyond.values != expected_),
           "the expectation that fails");
  }

  const Sample& sample_;
  const TunableNumber& number_;
  const Assignment& expected_;
  Random& random_;
  Statistics& statistics_;
  const Run present_;
};

/// What a mission does, or else what it would do with another number, if there is such a one.
Assignment pick_expected(const Sample& sample, const std::vector<TunableNumber>& numbers,
                         Random& random) {
  constexpr int attempts = 12;
  Assignment present = sample.run().values;
  for (int attempt = 0; attempt < attempts && random.percent(95); ++attempt) {
    Assignment other =
        sample.run_with(random.pick(numbers), random.between(0, whole_degree)).values;
    if (other != present) return other;
  }
  return present;
}

void check_case(const Case& generated, Random& random, Statistics& statistics) {
  Files files = read_files(generated, random);
  const Sample sample(generated);
  const std::vector<TunableNumber> numbers = find_numbers(files.reading);
  if (numbers.empty()) return;
  const Assignment expected = pick_expected(sample, numbers, random);
  expect(expected, files.mission);
  const Tuner tuner(files.reading.catalog, numbers, {&files.mission}, 0);
  const bool fails = sample.run().values != expected;
  demand(tuner.present().failures.size() == (fails ? 1U : 0U), "whether it fails");
  if (fails) statistics.count("expectation that fails");
  for (std::size_t count = 0; count < numbers_per_case; ++count) {
    const std::size_t place = random.below(numbers.size());
    NumberCheck check(sample, numbers[place], expected, random, statistics);
    check.check(tuner.tolerance(place));
    if (!fails) continue;
    check.check(tuner.repairs(place));
  }
}

/// Of some catalogs many pairs have the default, so that one number stands for all of them.
Case generate_tuned_case(std::uint64_t seed) {
  Case sample = generate_case(seed);
  Random random(seed);
  plain::share_a_suitability(sample.catalog, random);
  return sample;
}

void run_case(std::uint64_t seed, Results& results) {
  const Case sample = generate_tuned_case(seed);
  Random random(~seed);
  try {
    check_case(sample, random, results.statistics);
  } catch (const std::exception& error) {
    Random forms(~seed);
    const std::string catalog = catalog_yaml(sample.catalog, forms);
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n--- catalog\n" + catalog +
                                        "--- script\n" +
                                        script_yaml(sample.catalog, sample.script, forms) + "--- " +
                                        error.what() + "\n"});
  }
}

const LowerBound lower_bounds[] = {
    {"bound of a tolerance", 1000},
    {"bound of a tolerance of several pairs", 100},
    {"bound of a tolerance of a minimum", 150},
    {"no bound", 1000},
    {"expectation that fails", 200},
    {"repair", 90},
    {"repair of several pairs", 10},
    {"repair of a minimum", 10},
};

TEST(Tune, TolerancesAndRepairsAreThoseOfTheOracle) {
  run_random_cases(default_cases, run_case, lower_bounds);
}

}  // namespace
}  // namespace cbc::oracle::tune_property_test
