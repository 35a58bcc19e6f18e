#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/report/run_json.h"
#include "core/report/run_report.h"
#include "core/script/reader.h"
#include "core/support/system.h"
#include "page/html_report.h"
#include "unit/compiled_fixture.h"
#include "unit/findings.h"

namespace cbc::solve_html_test {
namespace {

using nlohmann::json;

constexpr std::string_view data_begin = R"(<script type="application/json" id="data">)";
constexpr std::string_view script_end = "</script>";

constexpr const char* plain_catalog = R"(
tasks:
- {task: GO}
- {task: LOCATE, start_on_request: false, execution_goal: keep_running}
- {task: STAY}
behaviors:
- {behavior: go, task: GO, suitability: 62.5, requires: [{task: LOCATE}]}
- {behavior: gps, tasks: [{task: LOCATE, suitability: 80}, {task: STAY}]}
exclusivity_constraints:
- mutually_exclusive: [GO, STAY]
)";

constexpr const char* plain_script = R"(
situation: {gps: true}
events:
- start: GO
- {start: STAY, priority: 2, at: 1.5}
- {start: GO, at: 2}
- expect: {outcome: accepted}
)";

Script read(const CompiledCatalog& catalog, std::string_view text) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "s.yaml", diagnostics);
  auto script = document != nullptr
                    ? read_script(*document, catalog, Severity::warning, diagnostics)
                    : std::optional<Script>{};
  EXPECT_TRUE(script.has_value()) << show(diagnostics);
  return script.value_or(Script{});
}

void run(const CompiledCatalog& catalog, const Script& script, SolveReport& report) {
  report.begin_run(catalog, script);
  report.end_run(run_script(catalog, script, {}, report), "");
}

std::size_t count(std::string_view text, std::string_view part) {
  std::size_t number = 0;
  for (std::size_t place = text.find(part); place != std::string_view::npos;
       place = text.find(part, place + part.size())) {
    ++number;
  }
  return number;
}

/// The data as a browser finds it: the script element ends at the first end tag.
std::string_view data_text(std::string_view page) {
  const std::size_t begin = page.find(data_begin) + data_begin.size();
  return page.substr(begin, page.find(script_end, begin) - begin);
}

/// The page of a run, and the report of the same run in JSON.
struct Made {
  std::string page;
  json data;
  json report;
};

Made make(std::string_view catalog_text, std::string_view script_text) {
  const CompiledCatalog catalog = test::compile_text(catalog_text);
  const Script script = read(catalog, script_text);
  MemoryFile file;
  JsonReport report(file.stream());
  HtmlReport html;
  ReportPair both(report, html);
  run(catalog, script, both);
  both.end();
  Made made;
  made.page = html.page();
  made.data = json::parse(data_text(made.page));
  made.report = json::parse(file.text());
  return made;
}

TEST(SolveHtml, HasTheReportInJson) {
  Made made = make(plain_catalog, plain_script);
  // Notes are for the page alone.
  for (json& event : made.data["report"]["runs"][0]["events"]) event.erase("note");
  EXPECT_EQ(made.data["report"], made.report);
  EXPECT_EQ(made.report["runs"][0]["events"].size(), 3U);
  EXPECT_EQ(made.report["runs"][0]["expectations"]["failed"], 1);
}

TEST(SolveHtml, HasTheCatalogInItsOrder) {
  const Made made = make(plain_catalog, plain_script);
  ASSERT_EQ(made.data["catalogs"].size(), 1U);
  const json& catalog = made.data["catalogs"][0];
  EXPECT_EQ(catalog["tasks"], json::parse(R"(["GO", "LOCATE", "STAY"])"));
  EXPECT_EQ(catalog["behaviors"],
            json::parse(R"([{"name": "go", "performs": [{"task": "GO", "suitability": 62.5}],
                             "requires": ["LOCATE"], "situation": {}},
                            {"name": "gps", "performs": [{"task": "LOCATE", "suitability": 80.0},
                                                         {"task": "STAY", "suitability": 100.0}],
                             "requires": [], "situation": {}}])"));
  EXPECT_EQ(catalog["variables"], json::array());
  EXPECT_EQ(catalog["exclusive"], json::parse(R"([["GO", "STAY"]])"));
  EXPECT_EQ(made.data["runs"],
            json::parse(R"([{"catalog": 0, "situation": {"gps": true}, "left_out": 0}])"));
}

TEST(SolveHtml, HasSituationVariablesAndConditions) {
  const Made made = make(R"(
situation:
- {variable: TARGET, values: [far, near]}
- {variable: LIGHT}
behaviors:
- {behavior: see, task: LOOK, situation: {TARGET: near, LIGHT: true}}
)",
                         "{situation: {TARGET: near, see: false}, events: [start: LOOK]}");
  const json& catalog = made.data["catalogs"][0];
  EXPECT_EQ(catalog["variables"], json::parse(R"([{"variable": "TARGET", "values": ["far", "near"]},
                                                  {"variable": "LIGHT", "values": [true, false]}])"));
  EXPECT_EQ(catalog["behaviors"][0]["situation"],
            json::parse(R"({"TARGET": ["near"], "LIGHT": [true]})"));
  EXPECT_EQ(made.data["runs"][0]["situation"], json::parse(R"({"see": false, "TARGET": "near"})"));
}

TEST(SolveHtml, KeepsHostileNamesInTheData) {
  constexpr const char* catalog = R"(
tasks:
- {task: "</script><script>alert(1)</script>"}
behaviors:
- {behavior: "<!-- \"'&\u2028\u2029\\ {{data}} {{script}}", task: "</script><script>alert(1)</script>"}
)";
  constexpr const char* script = R"(
events:
- {start: "</script><script>alert(1)</script>", parameters: {"</SCRIPT>": "<!--\u2028"}}
)";
  const Made made = make(catalog, script);
  EXPECT_EQ(made.data["report"], made.report);
  EXPECT_EQ(data_text(made.page).find('<'), std::string_view::npos);
  EXPECT_EQ(made.data["catalogs"][0]["behaviors"][0]["name"],
            "<!-- \"'&\u2028\u2029\\ {{data}} {{script}}");
  // All of the page but its data is as for any other run.
  const Made plain = make(plain_catalog, plain_script);
  EXPECT_EQ(made.page.size() - data_text(made.page).size(),
            plain.page.size() - data_text(plain.page).size());
  EXPECT_EQ(count(made.page, script_end), count(plain.page, script_end));
}

TEST(SolveHtml, RefersToNothingOutside) {
  const Made made = make(plain_catalog, plain_script);
  const std::string_view page = made.page;
  EXPECT_EQ(count(page, "<!DOCTYPE html>"), 1U);
  EXPECT_EQ(count(page, script_end), 2U);
  EXPECT_EQ(count(page, "{{"), 0U);
  EXPECT_EQ(count(page, "https:"), 0U);
  EXPECT_EQ(count(page, "http:"), count(page, "http://www.w3.org/2000/svg"));  // a name, no address
  EXPECT_EQ(count(page, " src="), 0U);
  EXPECT_EQ(count(page, "@import"), 0U);
  EXPECT_EQ(count(page, "url("), count(page, "url(#"));
  EXPECT_EQ(count(page, "innerHTML"), 0U);
  EXPECT_EQ(count(page, "default-src 'none'"), 1U);
}

TEST(SolveHtml, HasACatalogOfSeveralRunsOnce) {
  const CompiledCatalog one = test::compile_text(plain_catalog);
  const CompiledCatalog other = test::compile_text("behaviors: [{behavior: b, task: B}]");
  const Script of_one = read(one, plain_script);
  const Script of_other = read(other, "[{start: B}]");
  HtmlReport html;
  run(one, of_one, html);
  run(other, of_other, html);
  run(one, of_one, html);
  html.end();
  const std::string page = html.page();
  const json data = json::parse(data_text(page));
  EXPECT_EQ(data["catalogs"].size(), 2U);
  ASSERT_EQ(data["runs"].size(), 3U);
  EXPECT_EQ(data["report"]["runs"].size(), 3U);
  EXPECT_EQ(data["runs"][0]["catalog"], 0);
  EXPECT_EQ(data["runs"][1]["catalog"], 1);
  EXPECT_EQ(data["runs"][2]["catalog"], 0);
}

TEST(SolveHtml, LeavesOutWhatNoLongerFits) {
  const CompiledCatalog catalog = test::compile_text(plain_catalog);
  const Script first = read(catalog, plain_script);
  std::string text = "[";
  constexpr int events = 300;
  for (int event = 0; event < events; ++event) text += "{wait: 1}, {expect: {outcome: rejected}}, ";
  const Script second = read(catalog, text + "]");
  HtmlReport html({}, 20'000);
  run(catalog, first, html);
  run(catalog, second, html);
  run(catalog, first, html);
  html.end();
  const std::string page = html.page();
  const json data = json::parse(data_text(page));
  const json& runs = data["report"]["runs"];
  EXPECT_EQ(data["runs"][0]["left_out"], 0);
  EXPECT_EQ(runs[0]["events"].size(), 3U);
  const std::size_t shown = runs[1]["events"].size();
  EXPECT_GT(shown, 10U);
  EXPECT_LT(shown, 200U);
  EXPECT_EQ(data["runs"][1]["left_out"], events - shown);
  EXPECT_EQ(runs[1]["expectations"]["failed"], events);
  EXPECT_EQ(runs[1]["expectations"]["failures"].size(), shown + 100);
  EXPECT_EQ(runs[2]["events"], json::array());
  EXPECT_EQ(data["runs"][2]["left_out"], 3);
  EXPECT_EQ(html.left_out(), events - shown + 3);
}

TEST(SolveHtml, ListsPropertiesWithTheirRuns) {
  const CompiledCatalog catalog = test::compile_text(plain_catalog);
  HtmlReport html;
  run(catalog, read(catalog, plain_script), html);
  html.list_properties({{"p.yaml:1: one", "never <GO>", "proved", "proved for 3 reachable states"},
                        {"p.yaml:2: two", "GO runs", "violated", "violated after 1 event", true}});
  html.end();
  const json data = json::parse(data_text(html.page()));
  EXPECT_EQ(
      data["properties"],
      json::parse(R"([{"title": "p.yaml:1: one", "statement": "never <GO>", "result": "proved",
                             "description": "proved for 3 reachable states", "run": null},
                            {"title": "p.yaml:2: two", "statement": "GO runs", "result": "violated",
                             "description": "violated after 1 event", "run": 0}])"));
}

TEST(SolveHtml, GivesTheSimulatorItsTexts) {
  const std::string text = std::string(plain_catalog) + "# </script>\n";
  const CompiledCatalog catalog = test::compile_text(text);
  const Script script = read(catalog, plain_script);
  HtmlReport html;
  html.continue_in("/usr/share/cbc play/cbc-play.html", [&](const CompiledCatalog& asked) {
    return &asked == &catalog ? &text : nullptr;
  });
  run(catalog, script, html);
  const CompiledCatalog other = test::compile_text(plain_catalog);  // whose text nobody knows
  run(other, read(other, plain_script), html);
  html.end();
  const json data = json::parse(data_text(html.page()));
  EXPECT_EQ(data["simulator"], "file:///usr/share/cbc%20play/cbc-play.html");
  EXPECT_EQ(data["catalogs"][0]["text"], text);
  const std::string mission = data["runs"][0]["mission"];
  const Script again = read(catalog, mission);
  EXPECT_EQ(again.steps.size(), script.steps.size());
  EXPECT_EQ(again.situation.availability.size(), 1U);
  EXPECT_FALSE(data["catalogs"][1].contains("text"));
  EXPECT_FALSE(data["runs"][1].contains("mission"));
}

TEST(SolveHtml, GivesNoTextsThatAreTooLong) {
  constexpr std::size_t most_runs = 1000;
  const CompiledCatalog catalog = test::compile_text(plain_catalog);
  std::string events = "events:\n";
  for (int i = 0; i < 1000; ++i) events += "- start: GO\n";
  const Script script = read(catalog, events);
  const std::string text(plain_catalog);
  HtmlReport html({}, 1 << 16);
  html.continue_in("/page.html", [&](const CompiledCatalog&) { return &text; });
  for (std::size_t i = 0; i < most_runs; ++i) {
    html.begin_run(catalog, script);
    html.end_run({}, "");
  }
  const std::string huge = text + std::string(std::size_t{1} << 20, '#');
  const CompiledCatalog large = test::compile_text(plain_catalog);
  HtmlReport other;
  other.continue_in("/page.html", [&](const CompiledCatalog&) { return &huge; });
  run(large, script, other);
  html.end();
  other.end();
  const json runs = json::parse(data_text(html.page()))["runs"];
  const auto with_mission = std::count_if(runs.begin(), runs.end(),
                                          [](const json& one) { return one.contains("mission"); });
  EXPECT_GT(with_mission, 100);
  EXPECT_LT(with_mission, 1000);
  EXPECT_LT(html.page().size(), std::size_t{12} << 20);
  const json data = json::parse(data_text(other.page()));
  EXPECT_FALSE(data["catalogs"][0].contains("text"));
  EXPECT_FALSE(data["runs"][0].contains("mission"));
}

TEST(SolveHtml, HasNoTextsWithoutTheSimulator) {
  const Made made = make(plain_catalog, plain_script);
  EXPECT_FALSE(made.data.contains("simulator"));
  EXPECT_FALSE(made.data["catalogs"][0].contains("text"));
  EXPECT_FALSE(made.data["runs"][0].contains("mission"));
}

TEST(SolveHtml, WithoutRunsIsAPageStill) {
  HtmlReport html;
  html.end();
  const std::string page = html.page();
  EXPECT_EQ(json::parse(data_text(page))["report"]["runs"], json::array());
}

}  // namespace
}  // namespace cbc::solve_html_test
