// Our catalogs with a wrong suitability, so that an expectation of their missions fails: the right
// one must be among the values that repair it. CBC_SEED and CBC_PROPERTY_CASES are as in
// property_test.cpp.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/compile/compile.h"
#include "core/script/reader.h"
#include "core/yaml/document.h"
#include "demand.h"
#include "random.h"
#include "random_cases.h"
#include "support/catalog_files.h"
#include "support/read_file.h"
#include "tune/engine/numbers.h"
#include "tune/engine/tuner.h"

namespace cbc::tune_catalogs_test {
namespace {

namespace fs = std::filesystem;
using oracle::demand;
using oracle::Random;
using oracle::Results;

constexpr std::uint64_t default_cases = 200;

struct Robot {
  std::string name;
  CatalogReading reading;
  std::vector<Script> missions;
  std::vector<TunableNumber> numbers;

  [[nodiscard]] Missions all() const {
    Missions all;
    for (const Script& mission : missions) all.push_back(&mission);
    return all;
  }
};

/// With its missions, which pass.
Robot read_robot(const fs::path& file) {
  Robot robot;
  robot.name = file.stem().string();
  Diagnostics diagnostics;
  const auto document = yaml::parse(test::read_file(file), file.string(), diagnostics);
  robot.reading = understand_catalog(*document, diagnostics);
  robot.numbers = find_numbers(robot.reading);
  const CompiledCatalog compiled = compile(robot.reading.catalog);
  std::vector<fs::path> files = {file.parent_path() / (robot.name + ".mission.yaml")};
  for (const auto& entry : fs::directory_iterator(file.parent_path() / "missions")) {
    if (entry.path().filename().string().starts_with(robot.name + "-")) files.push_back(entry);
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& mission : files) {
    const auto script = yaml::parse(test::read_file(mission), mission.string(), diagnostics);
    robot.missions.push_back(*read_script(*script, compiled, Severity::note, diagnostics));
  }
  return robot;
}

/// Those with a suitability on which an expectation depends.
const std::vector<Robot>& robots() {
  static const std::vector<Robot> all = [] {
    std::vector<Robot> found;
    for (const fs::path& file : test::catalog_files(CBC_SOURCE_DIR "/catalogs")) {
      if (file.stem() != "autoware") found.push_back(read_robot(file));
    }
    return found;
  }();
  return all;
}

bool make_wrong(const Robot& robot, Random& random, oracle::Statistics& statistics) {
  const std::size_t place = random.below(robot.numbers.size());
  const TunableNumber& right = robot.numbers[place];
  if (right.kind != TunableNumber::Kind::suitability || right.uses.empty()) return false;
  std::vector<TunableNumber> numbers = robot.numbers;
  numbers[place].value = static_cast<Millionths>(random.between(0, one_million));
  Catalog wrong = robot.reading.catalog;
  set_number(wrong, numbers[place], numbers[place].value);
  const Tuner tuner(wrong, numbers, robot.all(), 0);
  if (tuner.present().failures.empty()) return false;
  const Repairs repairs = tuner.repairs(place);
  const auto has_right = [&](const NumberRepair& repair) {
    return repair.values.low <= right.value && right.value <= repair.values.high;
  };
  demand(std::any_of(repairs.intervals.begin(), repairs.intervals.end(), has_right),
         "the right value of the " + describe(right, wrong) + " repairs nothing");
  for (const NumberRepair& repair : repairs.intervals) {
    set_number(wrong, right, repair.nearest);
    demand(record(compile(wrong), robot.all(), Until::end).holds(), "the nearest value does not");
  }
  statistics.count(robot.name);
  return true;
}

void run_case(std::uint64_t seed, Results& results) {
  constexpr int attempts = 1000;
  const Robot& robot = robots()[seed % robots().size()];
  Random random(seed);
  try {
    bool is_done = false;
    for (int attempt = 0; attempt < attempts && !is_done; ++attempt) {
      is_done = make_wrong(robot, random, results.statistics);
    }
    demand(is_done, "nothing fails");
  } catch (const std::exception& error) {
    results.faults.push_back(
        {seed, "seed " + std::to_string(seed) + ", " + robot.name + ": " + error.what()});
  }
}

TEST(Tune, FindsTheRightSuitabilityAmongTheRepairs) {
  oracle::run_random_cases(default_cases, run_case, {});
}

}  // namespace
}  // namespace cbc::tune_catalogs_test
