#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "core/command_line/command_line.h"
#include "core/support/memory_file.h"
#include "solve/report/solve_report.h"
#include "unit/compiled_fixture.h"

namespace cbc::solve_github_test {
namespace {

/// Runs a script with the expectation that a task runs, which it does not.
std::string report_of(const std::string& file, const std::string& error = "") {
  const CompiledCatalog catalog = test::compile_text("behaviors: [{behavior: a, task: A}]");
  Step expectation;
  expectation.range = {{3, 4}, {3, 9}};
  expectation.expect.emplace().running.push_back({0, {}});
  Script script;
  script.file = file;
  script.steps.push_back(expectation);
  MemoryFile memory;
  ReportSettings settings;
  settings.out = memory.stream();
  const auto report = cli::find_named(solve_formats(), "github")->make(settings);
  report->begin_run(catalog, script);
  report->end_run(run_script(catalog, script, {}, *report), error);
  report->end();
  return std::string(memory.text());
}

TEST(SolveGithub, WritesACommandForAFailedExpectation) {
  EXPECT_EQ(report_of("m.yaml"),
            "::error file=m.yaml,line=3,endLine=3,col=4,endColumn=9,title=cbc expectation failed::"
            "expected task 'A' to run, but it does not run%0Abefore the first event\n");
}

TEST(SolveGithub, EscapesTheNameOfTheFile) {
  EXPECT_EQ(report_of("a,b:c%\n.yaml").rfind("::error file=a%2Cb%3Ac%25%0A.yaml,line=3,", 0), 0U);
}

TEST(SolveGithub, WritesACommandForARunThatEndedEarly) {
  const std::string text = report_of("m.yaml", "too long\n::error::x");
  EXPECT_NE(text.find("\n::error file=m.yaml,title=cbc run ended early::too long%0A::error::x\n"),
            std::string::npos);
}

}  // namespace
}  // namespace cbc::solve_github_test
