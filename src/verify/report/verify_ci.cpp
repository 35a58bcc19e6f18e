// The formats of a verification, those for continuous integration, and the page.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/report/test_report.h"
#include "core/support/wording.h"
#include "core/words/words.h"
#include "page/html_report.h"
#include "page/simulator.h"
#include "runtime/base/text.h"
#include "verify/report/verify_report.h"

namespace cbc {
namespace {

Diagnostic finding_of(std::string_view rule, std::string_view file, std::string message,
                      const Range& place = whole_file) {
  return {rule, Severity::error, std::string(file), place, std::move(message), {}};
}

TestCase case_of(const VerifyResult& result, const VerifyPart& part,
                 const ReportedAnswer& reported) {
  const PropertyAnswer& answer = *reported.answer;
  const Property& property = *answer.property;
  const Range place = place_of_line(property.line);
  const std::string title = title_of(*result.catalog, property);
  TestCase test{fmt::format("line {}: {}", property.line, title)};
  if (answer.verdict.is_vacuous) {
    test.findings.push_back(finding_of("property proved vacuously", part.file->path,
                                       title + ": proved only since " + describe_vacuity(property),
                                       place));
    test.findings.back().severity = Severity::warning;
  }
  if (answer.verdict.result == Verdict::Result::proved) return test;
  std::string message = title + ": " + describe_answer(result, part, answer);
  if (!property.name.empty()) message += "\n" + describe_property(*result.catalog, property);
  if (reported.replay) {
    for (const auto* const reasons :
         {&reported.replay->idle_queue, &reported.replay->explanation}) {
      for (const std::string& reason : *reasons) message += "\n" + reason;
    }
    test.more = answer.witness->text;
  }
  const bool is_violated = answer.verdict.result == Verdict::Result::violated;
  test.fail(finding_of(is_violated ? "property violated" : "property undecided", part.file->path,
                       std::move(message), place),
            is_violated ? TestCase::Status::failed : TestCase::Status::error);
  return test;
}

/// Groups without properties: whether everything was explored.
TestCase case_of(const VerifyResult& result, const VerifyPart& part,
                 const Exploration& exploration) {
  TestCase test{fmt::format("explored: {}", join(exploration.groups, ", ", [](GroupId group) {
                              return fmt::format("group {}", std::uint32_t{group});
                            }))};
  if (exploration.complete) return test;
  test.fail(
      finding_of("exploration incomplete", part.file->path, describe_limit(result, exploration)),
      TestCase::Status::error);
  return test;
}

constexpr std::string_view nothing_compared = "no start, stop or finish comes in both";

/// The events of groups of both catalogs. `differences`: those of the groups.
TestCase case_of(const VerifyResult& result, const GroupComparison& groups,
                 std::span<const ReportedDifference> differences) {
  const std::string_view file = result.catalog->file;
  const std::size_t others = groups.tasks.size() - 1;
  TestCase test{"events of " + printable(groups.tasks.front()) +
                (others == 0 ? "" : " and " + quantity(others, "other task"))};
  for (const ReportedDifference& reported : differences) {
    const std::string lines = join(reported.difference->tasks, "\n",
                                   [](const TaskDifference& task) { return task.line; });
    test.fail(
        finding_of("decided differently", file, lines + "\n" + reported.difference->witness.text));
  }
  if (!differences.empty()) return test;
  if (groups.end) {
    test.fail(finding_of("comparison undecided", file,
                         "undecided: " + result.limits.describe(*groups.end)),
              TestCase::Status::error);
  } else if (!groups.is_compared) {
    test.status = TestCase::Status::skipped;
    test.more = nothing_compared;
  }
  return test;
}

TestSuite suite_of_comparison(const VerifyResult& result) {
  const ReportedComparison& reported = *result.same_as;
  const CatalogComparison& comparison = reported.comparison;
  TestSuite suite{std::string(result.catalog->file), std::string(reported.old_catalog->file)};
  suite.cases = {{"tasks, behaviors and variables"}, {"timeouts, goals and parameters"}};
  for (const DirectDifference& difference : comparison.direct) {
    const bool is_name = difference.kind <= DirectDifference::Kind::value;
    suite.cases[is_name ? 0 : 1].fail(finding_of("catalogs differ", suite.file, difference.line));
  }
  std::size_t first = 0;
  for (const GroupComparison& groups : comparison.groups) {
    suite.cases.push_back(case_of(
        result, groups, std::span(reported.differences).subspan(first, groups.differences.size())));
    first += groups.differences.size();
  }
  if (!comparison.is_compared && !comparison.end) {
    suite.cases.push_back({"something was compared"});
    suite.cases.back().fail(
        finding_of("nothing was compared", suite.file, std::string(nothing_compared)));
  }
  return suite;
}

template <const TestFormat& format>
std::string write_tests(const VerifyResult& result, const Style& /*style*/,
                        std::size_t /*columns*/) {
  std::vector<TestSuite> suites;
  for (const VerifyPart& part : result.parts) {
    suites.push_back({part.file->path, std::string(result.catalog->file)});
    for (const ReportedAnswer& answer : part.answers) {
      suites.back().cases.push_back(case_of(result, part, answer));
    }
    if (!part.is_about_groups()) continue;
    for (const Exploration& exploration : part.verification.explorations) {
      suites.back().cases.push_back(case_of(result, part, exploration));
    }
  }
  if (result.same_as) suites.push_back(suite_of_comparison(result));
  return tests_to_text(format, "cbc verify", suites);
}

}  // namespace

std::span<const VerifyFormat> verify_formats() {
  static constexpr VerifyFormat formats[] = {
      {{"text", [](const VerifyResult& result, const Style& style,
                   std::size_t /*columns*/) { return verify_to_text(result, style); }}},
      {{"json", for_programs<verify_to_json>}},
      {{"junit", write_tests<junit_format>}, true},
      {{"github", write_tests<github_format>}, true},
      {{"csv", [](const VerifyResult& result, const Style& style,
                  std::size_t /*columns*/) { return effects_to_csv(result, style); }},
       false,
       true},
  };
  return formats;
}

std::string verify_to_html(const VerifyResult& result) {
  const CompiledCatalog& catalog = *result.catalog;
  HtmlReport page;
  if (const auto simulator = installed_simulator()) {
    page.continue_in(*simulator,
                     [&](const CompiledCatalog& /*catalog*/) { return result.text.get(); });
  }
  std::vector<PropertyOfPage> properties;
  for (const VerifyPart& part : result.parts) {
    for (const ReportedAnswer& reported : part.answers) {
      const PropertyAnswer& answer = *reported.answer;
      const Property& property = *answer.property;
      PropertyOfPage& item = properties.emplace_back();
      item.title =
          fmt::format("{}:{}: {}", part.file->path, property.line, title_of(catalog, property));
      item.statement = describe_property(catalog, property);
      item.result = name_of(answer.verdict.result);
      item.description = describe_answer(result, part, answer);
      item.has_run = reported.replay.has_value();
      if (!item.has_run) continue;
      for (const std::string& line : reported.replay->idle_queue) item.description += "; " + line;
      const Script& script = answer.witness->script;
      page.begin_run(catalog, script);
      const Exploration& exploration = part.verification.explorations[*answer.exploration];
      page.end_run(run_script(seen_from(catalog, exploration.groups), script, {}, page,
                              {.rejections = true}),
                   {});
    }
  }
  page.list_properties(properties);
  page.end();
  return page.page();
}

}  // namespace cbc
