// Reasons are told alike by all formats.
#include <filesystem>
#include <string>

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

}  // namespace
}  // namespace cbc::golden::reasons_test
