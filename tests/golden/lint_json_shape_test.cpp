#include "golden/lint_json_shape.h"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cbc::golden {
namespace {

const std::string good =
    R"({"schema":"cbc.lint/1","files":[{"file":"a.yaml","diagnostics":[)"
    R"({"rule":"dead-task","severity":"warning","message":"m","line":2,"column":3,"end_line":2,)"
    R"("end_column":7,"related":[{"file":"a.yaml","line":1,"column":1,"message":"n"}]}],)"
    R"("summary":{"tasks":2,"behaviors":3,"constraints":{"exclusive_pairs":1,"requirements":0,)"
    R"("task_minimums":0,"total":1},"groups":[{"tasks":["A","B"],"constraints":1}],)"
    R"("search_space":"6"}}],"errors":0,"warnings":1,"notes":0})";

TEST(LintJsonShape, SeesEachFault) {
  EXPECT_EQ(find_lint_shape_faults(good), std::vector<std::string>());
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"cbc.lint/1", "cbc.lint/2"},
      {R"("warnings":1)", R"("warnings":2)"},
      {R"("errors":0)", R"("errors":1)"},
      {R"(,"notes":0)", ""},
      {R"("notes":0)", R"("notes":0,"x":0)"},
      {R"("rule":"dead-task","severity":"warning")", R"("severity":"warning","rule":"dead-task")"},
      {R"("severity":"warning")", R"("severity":"fatal")"},
      {"dead-task", "dead task"},
      {R"("line":2)", R"("line":0)"},
      {R"("line":2)", R"("line":"2")"},
      {R"("end_column":7)", R"("end_column":2)"},
      {R"("line":1,"column":1)", R"("line":1,"column":0)"},
      {R"("message":"n")", R"("text":"n")"},
      {R"("tasks":2)", R"("tasks":3)"},
      {R"("total":1)", R"("total":2)"},
      {R"(["A","B"])", R"(["A","A"])"},
      {R"("constraints":1}])", R"("constraints":2}])"},
      {R"("search_space":"6")", R"("search_space":6)"},
      {R"("search_space":"6")", R"("search_space":"6.0")"},
      {R"("related":[)", R"("related":[7,)"},
      {"}", ""}};
  for (const auto& [part, other] : faults) {
    std::string bad = good;
    bad.replace(bad.find(part), part.size(), other);
    EXPECT_NE(find_lint_shape_faults(bad), std::vector<std::string>()) << part << " " << other;
  }
}

}  // namespace
}  // namespace cbc::golden
