// The missions of the catalogs in catalogs/ test them completely: all goals of coverage that can be
// met, and every change that a mission can notice.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "golden/process.h"
#include "support/catalog_files.h"

namespace cbc::golden::gallery_test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_of_catalogs() {
  std::vector<std::string> names;
  for (const fs::path& file : test::catalog_files(CBC_SOURCE_DIR "/catalogs")) {
    names.push_back(file.stem());
  }
  return names;
}

/// NAME.mission.yaml, those that `cbc coverage --write-missing` wrote, and those about something
/// else.
std::vector<std::string> missions_of(const std::string& catalog) {
  std::vector<std::string> missions{"catalogs/" + catalog + ".mission.yaml",
                                    "catalogs/tests/" + catalog};
  for (const auto& entry : fs::directory_iterator(CBC_SOURCE_DIR "/catalogs/missions")) {
    const std::string name = entry.path().filename();
    if (name.starts_with(catalog + "-")) missions.push_back("catalogs/missions/" + name);
  }
  return missions;
}

class Gallery : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] Result cbc(std::vector<std::string> arguments,
                           const std::vector<std::string>& more) const {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run({arguments, CBC_SOURCE_DIR});
  }
  const std::string catalog = "catalogs/" + GetParam() + ".yaml";
  const std::vector<std::string> missions = missions_of(GetParam());
};

TEST_P(Gallery, MissionsMeetAllGoalsThatCanBeMet) {
  std::vector<std::string> arguments{"coverage", catalog};
  arguments.insert(arguments.end(), missions.begin(), missions.end());
  const std::vector<std::string> complete{"--fail-under", "100"};
  // A proof is needed only if some goals cannot be met.
  if (cbc(arguments, complete).status == 0) return;
  const Result result = cbc(arguments, {"--fail-under", "100", "--prove"});
  EXPECT_EQ(result.status, 0) << result.out << result.err;
}

TEST_P(Gallery, MissionsNoticeEveryChange) {
  const bool is_large = GetParam() == "autoware" || GetParam() == "hospital" || GetParam() == "px4";
  if (is_large && std::getenv("CBC_NIGHT") == nullptr) {
    GTEST_SKIP() << "this takes minutes: CBC_NIGHT=1 lets it run";
  }
  std::vector<std::string> arguments{"coverage", catalog, "--mutants", "--fail-under", "100"};
  if (GetParam() == "hospital") {
    // By default each task has two priorities, which makes five times as many states.
    arguments.insert(arguments.end(), {"--assume", "catalogs/hospital.properties.yaml"});
  }
  const Result result = cbc(arguments, missions);
  EXPECT_EQ(result.status, 0) << result.out << result.err;
}

INSTANTIATE_TEST_SUITE_P(Catalogs, Gallery, testing::ValuesIn(names_of_catalogs()),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace cbc::golden::gallery_test
