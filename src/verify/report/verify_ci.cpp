// The formats of a verification, those for continuous integration, and the page.

#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/report/test_report.h"
#include "core/report/words.h"
#include "core/support/wording.h"
#include "page/html_report.h"
#include "runtime/base/text.h"
#include "verify/report/verify_report.h"

namespace cbc {
namespace {

constexpr std::string_view command = "cbc verify";

TestCase case_of(const VerifyResult& result, const VerifyPart& part,
                 const ReportedAnswer& reported) {
  const Answer& answer = *reported.answer;
  const Property& property = *answer.property;
  const std::string title = title_of(*result.catalog, property);
  TestCase test{fmt::format("line {}: {}", property.line, title)};
  if (answer.verdict.result == Verdict::Result::proved) return test;
  const bool is_violated = answer.verdict.result == Verdict::Result::violated;
  test.status = is_violated ? TestCase::Status::failed : TestCase::Status::error;
  test.type = is_violated ? "property" : "limit";
  test.message = describe_answer(result, part, answer);
  const std::string statement = describe_property(*result.catalog, property) + "\n";
  test.details = statement;
  std::string message = title + "\n";
  if (!property.name.empty()) message += statement;
  message += test.message;
  if (reported.replay) {
    const std::string reasons = join(reported.replay->explanation, "\n");
    test.details += reasons + "\n\n" + answer.witness->text;
    message += "\n" + reasons;
  }
  test.annotations.push_back({Severity::error, place_of_line(property.line),
                              fmt::format("cbc property {}", name_of(answer.verdict.result)),
                              message});
  return test;
}

template <const TestFormat& format>
std::string write_tests(const VerifyResult& result, const Style& /*style*/) {
  std::vector<TestSuite> suites;
  for (const VerifyPart& part : result.parts) {
    suites.push_back({part.file->path, std::string(result.catalog->file)});
    for (const ReportedAnswer& answer : part.answers) {
      suites.back().cases.push_back(case_of(result, part, answer));
    }
  }
  return tests_to_text(format, command, suites);
}

template <const TestFormat& format>
std::string write_unreadable(const std::vector<Diagnostic>& findings) {
  return unreadable_to_text(format, command, findings);
}

}  // namespace

std::span<const VerifyFormat> verify_formats() {
  static constexpr VerifyFormat formats[] = {
      {"text", verify_to_text},
      {"json",
       [](const VerifyResult& result, const Style& /*style*/) { return verify_to_json(result); }},
      {"junit", write_tests<junit_format>, true, write_unreadable<junit_format>},
      {"github", write_tests<github_format>, true, write_unreadable<github_format>},
  };
  return formats;
}

std::string verify_to_html(const VerifyResult& result) {
  const CompiledCatalog& catalog = *result.catalog;
  HtmlReport page;
  std::vector<PropertyOfPage> properties;
  for (const VerifyPart& part : result.parts) {
    for (const ReportedAnswer& reported : part.answers) {
      const Answer& answer = *reported.answer;
      const Property& property = *answer.property;
      PropertyOfPage& item = properties.emplace_back();
      item.title =
          fmt::format("{}:{}: {}", part.file->path, property.line, title_of(catalog, property));
      item.statement = describe_property(catalog, property);
      item.result = name_of(answer.verdict.result);
      item.description = describe_answer(result, part, answer);
      item.has_run = reported.replay.has_value();
      if (!item.has_run) continue;
      const Script& script = answer.witness->script;
      page.begin_run(catalog, script);
      page.end_run(run_script(catalog, script, {}, page), {});
    }
  }
  page.list_properties(properties);
  page.end();
  return page.page();
}

}  // namespace cbc
