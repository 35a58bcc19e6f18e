#pragma once

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "golden/process.h"
#include "support/scratch_folder.h"

namespace cbc::golden {

/// A catalog without findings, and a script for it.
inline constexpr const char* robot = R"(behaviors:
- {behavior: PID, task: HOVER, suitability: 70, requires: [{task: LOCALIZE}]}
- {behavior: GPS, task: LOCALIZE}
- {behavior: LAND_SOFTLY, task: LAND}
tasks:
- task: HOVER
- {task: LOCALIZE, start_on_request: false, execution_goal: keep_running}
- task: LAND
exclusivity_constraints:
- mutually_exclusive: [HOVER, LAND]
)";
inline constexpr const char* script = "[{start: HOVER}, {start: LAND}]\n";

/// A folder of files, and the program to run in it.
class CompiledFiles : public testing::Test {
 protected:
  [[nodiscard]] Result cbc(std::vector<std::string> arguments) const {
    return run({std::move(arguments), folder.path()});
  }
  /// Runs the program on what a file holds, by standard input.
  [[nodiscard]] Result cbc_reading(const std::string& name,
                                   std::vector<std::string> arguments) const {
    return run({std::move(arguments), folder.path(), folder / name});
  }
  /// Makes robot.yaml and robot.cbc.
  void compile_robot() const {
    folder.write("robot.yaml", robot);
    expect_silence(cbc({"compile", "robot.yaml"}));
  }

  static void expect_silence(const Result& result) { expect_result(result, 0, "", ""); }
  static void expect_result(const Result& result, int status, const std::string& out,
                            const std::string& err) {
    EXPECT_EQ(result.status, status);
    EXPECT_EQ(result.out, out);
    EXPECT_EQ(result.err, err);
  }

  test::ScratchFolder folder;
};

}  // namespace cbc::golden
