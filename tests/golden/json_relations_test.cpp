#include "golden/json_relations.h"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cbc::golden::json_relations_test {
namespace {

using Replacement = std::pair<std::string, std::string>;

/// Of a good text, each part replaced by another one makes a fault.
void expect_faults(const std::string& good, const std::vector<Replacement>& replacements) {
  EXPECT_EQ(find_contradictions(good), std::vector<std::string>());
  for (const auto& [part, other] : replacements) {
    std::string bad = good;
    ASSERT_NE(bad.find(part), std::string::npos) << part;
    bad.replace(bad.find(part), part.size(), other);
    EXPECT_EQ(find_contradictions(bad).size(), 1U) << part << " " << other;
  }
}

TEST(JsonRelations, OfLint) {
  expect_faults(
      R"({"schema":"cbc.lint/1","files":[{"file":"a.yaml","diagnostics":[)"
      R"({"severity":"note","line":2,"column":3,"end_line":2,"end_column":7},)"
      R"({"severity":"warning","line":2,"column":4,"end_line":3,"end_column":1}],)"
      R"("summary":{"tasks":2,"constraints":{"exclusive_pairs":1,"requirements":0,)"
      R"("task_minimums":2,"total":3},"groups":[{"tasks":["A"],"constraints":2},)"
      R"({"tasks":["B"],"constraints":1}]}},{"file":"b.yaml","diagnostics":[],"summary":null}],)"
      R"("errors":0,"warnings":1,"notes":1})",
      {{R"("warnings":1)", R"("warnings":2)"},
       {R"("errors":0)", R"("errors":1)"},
       {R"("notes":1)", R"("notes":0)"},
       {R"("column":4)", R"("column":2)"},
       {R"("end_column":7)", R"("end_column":2)"},
       {R"("end_line":3)", R"("end_line":2)"},
       {R"("exclusive_pairs":1)", R"("exclusive_pairs":0)"},
       {R"("tasks":2)", R"("tasks":3)"},
       {R"(["B"])", R"(["A"])"},
       {R"("constraints":1)", R"("constraints":2)"},
       {"cbc.lint/1", "cbc.lint/2"},
       {"}", ""}});
}

TEST(JsonRelations, OfSolve) {
  expect_faults(R"({"schema":"cbc.solve/1","runs":[{"events":[{"index":1},{"index":2}],)"
                R"("expectations":{"failed":1,"failures":[{}]}}]})",
                {{R"("index":1)", R"("index":0)"},
                 {R"("index":2)", R"("index":1)"},
                 {R"("failed":1)", R"("failed":0)"}});
}

TEST(JsonRelations, OfSweep) {
  expect_faults(
      R"({"schema":"cbc.sweep/1","tasks":[{"task":"A","runs":0},{"task":"B","runs":1}],)"
      R"("behaviors":[{"behavior":"a","activations":2},{"behavior":"b","activations":0}],)"
      R"("never_ran":["A"],"never_active":["b"],)"
      R"("nodes":{"p50":1,"p99":2,"max":3,"histogram":[[1,1],[2,1],[3,1]]},"slowest":{"nodes":3},)"
      R"("stats":{"event_ns":{"p50":4,"p99":5,"max":6,"histogram":[]},"slowest":null}})",
      {{R"("runs":0)", R"("runs":1)"},
       {R"("never_ran":["A"])", R"("never_ran":[])"},
       {R"("activations":2)", R"("activations":0)"},
       {R"("never_active":["b"])", R"("never_active":["a"])"},
       {R"("slowest":{"nodes":3})", R"("slowest":{"nodes":2})"},
       {R"("slowest":{"nodes":3})", R"("slowest":null)"},
       {R"("p50":1)", R"("p50":3)"},
       {R"("p99":2)", R"("p99":4)"},
       {R"("histogram":[])", R"("histogram":[[4,1]])"},
       {R"("slowest":null)", R"("slowest":{"ns":7})"}});
}

TEST(JsonRelations, OfGraph) {
  expect_faults(R"({"schema":"cbc.graph/1","nodes":[{"id":"task:A","kind":"task","mark":"faulty"},)"
                R"({"id":"behavior:a","kind":"behavior","mark":null}],)"
                R"("edges":[{"from":"task:A","to":"behavior:a","mark":null}]})",
                {{R"("id":"behavior:a")", R"("id":"behavior:b")"},
                 {R"("from":"task:A")", R"("from":"task:B")"},
                 {R"("kind":"task")", R"("kind":"task","priority":1)"},
                 {R"("mark":"faulty")", R"("mark":"active")"}});
  expect_faults(R"({"schema":"cbc.graph/1","state":{"index":1,"time":0,"event":"wait"},"nodes":[)"
                R"({"id":"task:A","kind":"task","priority":null,"mark":"active"},)"
                R"({"id":"task:B","kind":"task","priority":null,"mark":null}],"edges":[]})",
                {{R"("time":0)", R"("time":null)"},
                 {R"("event":"wait")", R"("event":null)"},
                 {R"("priority":null,)", ""},
                 {R"("id":"task:B")", R"("id":"task:A")"},
                 {R"("mark":"active")", R"("mark":"faulty")"}});
}

TEST(JsonRelations, OfTogether) {
  expect_faults(R"({"schema":"cbc.together/1","tasks":["A","B"],"possible":0,"excluded":1,)"
                R"("excluded_indirectly":0,"excluded_in_each_situation":0,)"
                R"("excluded_by_situation":0,"undecided":0,"forbidden":0,"pairs":[)"
                R"({"tasks":["A","B"],"together":"excluded","forbidden":false,)"
                R"("reasons":[{"kind":"exclusive"}]}]})",
                {{R"("tasks":["A","B"],"possible")", R"("tasks":["A","C"],"possible")"},
                 {R"("excluded":1)", R"("excluded":2)"},
                 {R"("forbidden":false)", R"("forbidden":true)"},
                 {R"("forbidden":0)", R"("forbidden":1)"},
                 {R"([{"kind":"exclusive"}])", "[]"}});
}

TEST(JsonRelations, OfSituation) {
  expect_faults(R"({"schema":"cbc.situation/1","variables":[{"variable":"V","values":[)"
                R"({"value":"x","fit":["a"],"do_not_fit":["b"]},)"
                R"({"value":true,"fit":["b"],"do_not_fit":["a"]}]}],"behaviors":[)"
                R"({"behavior":"a","situation":{"V":["x"]}},)"
                R"({"behavior":"b","situation":{"V":[true]}}]})",
                {{R"("value":"x")", R"("value":"y")"},
                 {R"("fit":["a"])", R"("fit":[])"},
                 {R"("do_not_fit":["a"])", R"("do_not_fit":["c"])"},
                 {R"([true])", "[false]"},
                 {R"({"V":["x"]})", R"({"V":["x",true]})"}});
}

TEST(JsonRelations, OfDiff) {
  expect_faults(R"({"schema":"cbc.diff/1","changes":[)"
                R"({"kind":"added","subject":"task","task":"A",)"
                R"("attributes":[{"name":"timeout","before":null,"after":5}]},)"
                R"({"kind":"removed","subject":"task","task":"B",)"
                R"("attributes":[{"name":"timeout","before":6,"after":null}]}]})",
                {{R"("before":null)", R"("before":7)"},
                 {R"("after":null)", R"("after":7)"},
                 {R"("after":5)", R"("after":null)"},
                 {R"("task":"B")", R"("task":"A")"}});
}

}  // namespace
}  // namespace cbc::golden::json_relations_test
