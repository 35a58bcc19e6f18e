// Many scripts in one call: whatever -j says, the output is the same.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "golden/process.h"
#include "support/scratch_folder.h"

namespace cbc::golden::solve_runs_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* catalog_text = R"(
behaviors:
- {behavior: MOVE_FAST, task: MOVE}
- {behavior: MOVE_SLOWLY, task: MOVE, suitability: 50}
- {behavior: BEEP, task: BEEP}
- {behavior: TICK_ONCE, task: TICK}
- {behavior: TOCK_ONCE, task: TOCK}
tasks:
- {task: MOVE}
- {task: BEEP}
- {task: TICK, reactive_start: true, timeout: 1}
- {task: TOCK, reactive_start: true, timeout: 1}
exclusivity_constraints:
- mutually_exclusive: [MOVE, BEEP, TICK, TOCK]
)";

/// A folder with scripts of very different lengths, of which every fifth fails, and one comes to
/// too many events of the clock.
class SolveRuns : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("catalog.yaml", catalog_text);
    fs::create_directory(folder / "missions");
    for (std::size_t number = 0; number < scripts; ++number) {
      const std::size_t rounds = number % 7 == 0 ? 300 : number % 3;
      std::string script = "- start: BEEP\n";
      for (std::size_t round = 0; round < rounds; ++round) {
        script += "- {start: MOVE, priority: 2}\n- {stop: MOVE, priority: 2}\n- start: BEEP\n";
      }
      script += number % 5 == 0 ? "- expect: {outcome: rejected}\n"
                                : "- expect: {running: {BEEP: any}}\n";
      if (number == endless) script += "- {stop: BEEP}\n- wait: 1000\n";
      folder.write("missions/m" + std::to_string(100 + number) + ".yaml", script);
    }
  }

  [[nodiscard]] Result cbc(const std::string& command, const std::vector<std::string>& more) const {
    Call call{{command, "catalog.yaml", "missions", "--max-clock-events", "20"}, folder.path()};
    call.arguments.insert(call.arguments.end(), more.begin(), more.end());
    return run(call);
  }
  [[nodiscard]] Result solve(const std::vector<std::string>& more) const {
    return cbc("solve", more);
  }
  [[nodiscard]] Result coverage(const std::vector<std::string>& more) const {
    return cbc("coverage", more);
  }

  static constexpr std::size_t scripts = 40;
  static constexpr std::size_t endless = 23;
  test::ScratchFolder folder;
};

TEST_F(SolveRuns, AreTheSameWhateverTheNumberOfJobs) {
  for (const std::string format : {"text", "json", "junit", "github"}) {
    const Result alone = solve({"--format", format, "-j", "1"});
    EXPECT_EQ(alone.status, 2) << "the highest of all";
    EXPECT_NE(alone.err.find("m123.yaml"), std::string::npos);
    for (const std::vector<std::string>& jobs :
         {std::vector<std::string>{}, {"-j", "2"}, {"--jobs", "7"}, {"-j", "1000000"}}) {
      std::vector<std::string> arguments{"--format", format};
      arguments.insert(arguments.end(), jobs.begin(), jobs.end());
      const Result together = solve(arguments);
      EXPECT_EQ(together.status, alone.status);
      EXPECT_TRUE(together.out == alone.out) << jobs.size();  // too long to print
      EXPECT_EQ(together.err, alone.err);
    }
  }
}

TEST_F(SolveRuns, AreAllInTheReportInOrder) {
  const json report = json::parse(solve({"--format", "json", "-j", "3"}).out);
  std::vector<std::string> names;
  for (const json& run : report["runs"]) names.push_back(run["script"]);
  EXPECT_EQ(names.size(), scripts);
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
}

TEST_F(SolveRuns, MakeTheSamePageWhateverTheNumberOfJobs) {
  static_cast<void>(solve({"--html", "one.html", "-j", "1"}));
  static_cast<void>(solve({"--html", "many.html", "-j", "4"}));
  EXPECT_EQ(folder.read("one.html"), folder.read("many.html"));
}

TEST_F(SolveRuns, HaveStatisticsOfTheProcess) {
  const json report = json::parse(solve({"--format", "json", "--stats", "-j", "4"}).out);
  EXPECT_GT(report["process"]["peak_memory_bytes"], 1 << 20);
  EXPECT_GT(report["process"]["cpu_us"], 0);
}

/// A report without what --stats adds to it.
json without_stats(json report) {
  report.erase("totals");
  report.erase("process");
  for (json& run : report["runs"]) {
    run.erase("totals");
    for (json& event : run["events"]) {
      if (event["search"].is_null()) continue;
      event["search"].erase("propagations");
      event["search"].erase("elapsed_us");
    }
  }
  return report;
}

TEST_F(SolveRuns, AreTheSameWithStatisticsBesideThem) {
  EXPECT_EQ(without_stats(json::parse(solve({"--format", "json", "--stats"}).out)),
            json::parse(solve({"--format", "json"}).out));
}

TEST_F(SolveRuns, HaveTheSameCoverageWhateverTheNumberOfJobs) {
  const Result alone = coverage({"--format", "json", "-j", "1"});
  EXPECT_EQ(alone.status, 2) << "the highest of all";
  EXPECT_EQ(json::parse(alone.out)["catalogs"][0]["missions"].size(), scripts);
  for (const char* const jobs : {"2", "7"}) {
    const Result several = coverage({"--format", "json", "-j", jobs});
    EXPECT_EQ(several.out, alone.out);
    EXPECT_EQ(several.err, alone.err);
  }
}

TEST_F(SolveRuns, HaveTheirCoverageInAFile) {
  for (const char* const format : {"text", "json", "html", "lcov", "github"}) {
    const Result written = coverage({"--format", format, "-o", "file"});
    EXPECT_EQ(written.out, "");
    EXPECT_EQ(folder.read("file"), coverage({"--format", format}).out);
  }
}

TEST_F(SolveRuns, HaveStatisticsInTheText) {
  const std::string text = solve({"--stats"}).out;
  const std::size_t table = text.find("\nsearches\n");
  ASSERT_NE(table, std::string::npos);
  EXPECT_EQ(text.find("\nsearches\n", table + 1), std::string::npos) << "one for all runs";
  EXPECT_NE(text.find("  start (reactive) ", table), std::string::npos);
  EXPECT_NE(text.find("1 solution, "), std::string::npos);
  EXPECT_EQ(solve({}).out.find("propagation"), std::string::npos);
}

}  // namespace
}  // namespace cbc::golden::solve_runs_test
