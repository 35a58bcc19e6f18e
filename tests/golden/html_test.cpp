// `cbc solve --html` from outside. What is in the page is told by the tests of the library and
// those in a browser.
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "golden/process.h"

namespace cbc::golden {
namespace {

namespace fs = std::filesystem;

class Html : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "cbc-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    scratch = name;
  }
  void TearDown() override { fs::remove_all(scratch); }

  /// Runs a script of the folder of a case.
  static Result solve(const std::string& name, const std::vector<std::string>& more) {
    Call call{{"solve", "catalog.yaml", "script.yaml"},
              fs::path(CBC_SOURCE_DIR) / "tests" / "golden" / "cases" / name};
    call.arguments.insert(call.arguments.end(), more.begin(), more.end());
    return run(call);
  }

  fs::path scratch;
};

TEST_F(Html, ComesBesideTheReport) {
  const fs::path page = scratch / "page.html";
  for (const std::string format : {"text", "json"}) {
    const Result alone = solve("mission_text", {"--format", format});
    const Result both = solve("mission_text", {"--format", format, "--html", page.string()});
    EXPECT_EQ(both.status, 0);
    EXPECT_EQ(both.out, alone.out);
    EXPECT_EQ(both.err, "");
    EXPECT_EQ(read_file(page).rfind("<!DOCTYPE html>", 0), 0U);
    fs::remove(page);
  }
}

TEST_F(Html, IsTheSameForTheSameInput) {
  EXPECT_EQ(solve("mission_text", {"--html", (scratch / "a").string()}).status, 0);
  EXPECT_EQ(solve("mission_text", {"--html", (scratch / "b").string()}).status, 0);
  EXPECT_EQ(read_file(scratch / "a"), read_file(scratch / "b"));
}

TEST_F(Html, IsWrittenWhenExpectationsFail) {
  const fs::path page = scratch / "page.html";
  EXPECT_EQ(solve("expectation_fails", {"--html", page.string()}).status, 1);
  EXPECT_TRUE(fs::exists(page));
}

TEST_F(Html, ThatCannotBeWrittenIsAnError) {
  const fs::path page = scratch / "missing" / "page.html";
  const Result alone = solve("expectation_fails", {});
  const Result result = solve("expectation_fails", {"--html", page.string()});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, alone.out);
  EXPECT_EQ(result.err,
            alone.err + "cbc: cannot write '" + page.string() + "': No such file or directory\n");
  EXPECT_TRUE(fs::is_empty(scratch));
}

TEST_F(Html, IsNotWrittenForBadInput) {
  const fs::path page = scratch / "page.html";
  EXPECT_EQ(solve("script_unknown_task", {"--html", page.string()}).status, 2);
  EXPECT_FALSE(fs::exists(page));
}

}  // namespace
}  // namespace cbc::golden
