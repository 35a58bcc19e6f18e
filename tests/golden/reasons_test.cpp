// Reasons are told alike by all formats, and by --replay.
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "golden/process.h"
#include "support/scratch_folder.h"

namespace cbc::golden::reasons_test {
namespace {

namespace fs = std::filesystem;

const fs::path shared = fs::path(CBC_SOURCE_DIR) / "tests/golden/shared";

TEST(Reasons, AreTheSameInAllFormats) {
  const test::ScratchFolder folder;
  const std::string page = folder / "page.html";
  for (const std::string format : {"text", "json", "junit", "github", "html"}) {
    const std::string printed = format == "html" ? "text" : format;
    const Result result = run({{"solve", "mission.yaml", "--format", printed, "--html", page},
                               shared / "reasons_request_ended"});
    const std::string report = format == "html" ? folder.read("page.html") : result.out;
    for (const std::string fact :
         {"MISSION stopped with event 3 at 100.000 s", "INSPECT does not fit: BATTERY is low",
          "its request (priority 1) ended there; request it again"}) {
      EXPECT_NE(report.find(fact), std::string::npos) << format << " does not say: " << fact;
    }
  }
}

TEST(Reasons, OfPropertiesNameWhatCameDueWithoutAnEvent) {
  const test::ScratchFolder folder;
  const Result result = run(
      {{"verify", "robot.properties.yaml", "--format", "github", "--html", folder / "page.html"},
       shared / "verify_queue_idle"});
  for (const std::string& report : {result.out, folder.read("page.html")}) {
    EXPECT_NE(report.find("GO_HOME is due, and cannot start by itself"), std::string::npos);
  }
}

class ReplayReasons : public testing::Test {
 protected:
  /// Runs events, and the log of it again, which `change` has changed before.
  template <typename Change>
  [[nodiscard]] Result replay(const fs::path& catalog, const std::string& events, Change change) {
    folder.write("events", events);
    const Call first{
        {"solve", catalog.string(), "-", "--format", "jsonl"}, folder.path(), folder / "events"};
    folder.write("log.jsonl", change(run(first).out));
    const Call again{{"solve", "--replay", "log.jsonl", catalog.string(), "--format", "jsonl"},
                     folder.path()};
    return run(again);
  }

  test::ScratchFolder folder;
};

TEST_F(ReplayReasons, NameWhatDiffersInALongList) {
  std::string events;
  for (int task = 0; task < 30; ++task) events += "{start: T" + std::to_string(task) + "}\n";
  const Result result =
      replay(shared / "reasons_active_difference/robot.yaml", events, [](std::string log) {
        const std::size_t place = log.rfind(R"("T17":"BEHAVIOR_17")");
        return log.replace(place, 19, R"("T17":"BEHAVIOR_7")");
      });
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("the first difference: they differ in 'running'\n"
                            "  running: missing: T17: \"BEHAVIOR_7\"; "
                            "not expected: T17: \"BEHAVIOR_17\"\n"),
            std::string::npos)
      << result.err;
}

TEST_F(ReplayReasons, MayBeMissingAsInLogsOf0_1_0) {
  bool is_changed = false;
  const Result result = replay(
      shared / "reasons_equal_priority/robot.yaml",
      "{start: REAR}\n{start: FRONT}\n{start: REPORT}\n{stop: FRONT}\n",
      [&](const std::string& log) {
        const std::regex cause(
            R"re(("stopped_tasks":\[[^\]]*?"cause":")(requested|displaced|released)("))re");
        const std::regex reasons(R"re("interrupted"(,"conflict":\[\])?(,"message":"[^"]*")?)re");
        std::string old = log;
        for (std::string last; last != old;) {
          last = old;
          old = std::regex_replace(old, cause, "$1interrupted$3");
          old = std::regex_replace(old, reasons, "\"interrupted\"");
        }
        is_changed = old != log && old.find("message") == std::string::npos;
        return old;
      });
  EXPECT_TRUE(is_changed);
  EXPECT_EQ(result.status, 0) << result.err;
}

}  // namespace
}  // namespace cbc::golden::reasons_test
