// `cbc solve --html` from outside. What is in the page is told by the tests of the library and
// those in a browser.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "golden/process.h"
#include "support/read_file.h"
#include "support/scratch_folder.h"

namespace cbc::golden::html_test {
namespace {

namespace fs = std::filesystem;

class Html : public testing::Test {
 protected:
  /// Runs a script of one of the shared folders.
  static Result solve(const std::string& name, const std::vector<std::string>& more) {
    Call call{{"solve", "catalog.yaml", "script.yaml"},
              fs::path(CBC_SOURCE_DIR) / "tests" / "golden" / "shared" / name};
    call.arguments.insert(call.arguments.end(), more.begin(), more.end());
    return run(call);
  }

  test::ScratchFolder scratch;
};

TEST_F(Html, ComesBesideTheReport) {
  const std::string page = scratch / "page.html";
  for (const std::string format : {"text", "json"}) {
    const Result alone = solve("mission_text", {"--format", format});
    const Result both = solve("mission_text", {"--format", format, "--html", page});
    EXPECT_EQ(both.status, 0);
    EXPECT_EQ(both.out, alone.out);
    EXPECT_EQ(both.err, "");
    EXPECT_EQ(test::read_file(page).rfind("<!DOCTYPE html>", 0), 0U);
    fs::remove(page);
  }
}

TEST_F(Html, IsTheSameForTheSameInput) {
  EXPECT_EQ(solve("mission_text", {"--html", scratch / "a"}).status, 0);
  EXPECT_EQ(solve("mission_text", {"--html", scratch / "b"}).status, 0);
  EXPECT_EQ(scratch.read("a"), scratch.read("b"));
}

TEST_F(Html, IsWrittenWhenExpectationsFail) {
  const std::string page = scratch / "page.html";
  EXPECT_EQ(solve("expectation_fails", {"--html", page}).status, 1);
  EXPECT_TRUE(fs::exists(page));
}

TEST_F(Html, HasReasons) {
  const std::string page = scratch / "page.html";
  EXPECT_EQ(solve("failure_why", {"--html", page}).status, 1);
  std::string data = test::read_file(page);
  EXPECT_NE(data.find(R"("loses":{"objective":"suitability","chosen":"0.8","alternative":"0.63"},)"
                      R"("differences":[{"task":"LOCALIZE","chosen":null,)"),
            std::string::npos);
  EXPECT_EQ(data.find(R"("why":[{"task":"DRIVE")"), std::string::npos);
  EXPECT_EQ(data.find(R"("alternatives":{)"), std::string::npos);
  EXPECT_EQ(solve("failure_why", {"--why", "DRIVE", "--alternatives", "2", "--html", page}).status,
            1);
  data = test::read_file(page);
  EXPECT_NE(data.find(R"("why":[{"task":"DRIVE","chosen":"DRIVE_SLOWLY")"), std::string::npos);
  EXPECT_NE(data.find(R"("alternatives":{"limit_reached":false,)"), std::string::npos);
}

TEST_F(Html, ThatCannotBeWrittenIsAnError) {
  const std::string page = scratch / "missing/page.html";
  const Result alone = solve("expectation_fails", {});
  const Result result = solve("expectation_fails", {"--html", page});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, alone.out);
  EXPECT_EQ(result.err,
            alone.err + "cbc: cannot write '" + page + "': No such file or directory\n");
  EXPECT_TRUE(scratch.names().empty());
}

TEST_F(Html, IsNotWrittenForBadInput) {
  const std::string page = scratch / "page.html";
  EXPECT_EQ(solve("script_unknown_task", {"--html", page}).status, 2);
  EXPECT_FALSE(fs::exists(page));
}

}  // namespace
}  // namespace cbc::golden::html_test
