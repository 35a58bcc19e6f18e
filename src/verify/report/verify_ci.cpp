#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/report/github.h"
#include "core/report/junit_parts.h"
#include "runtime/base/text.h"
#include "verify/report/verify_report.h"

namespace cbc {
namespace {

constexpr std::string_view verify_command = "cbc verify";

std::string file_of(const VerifyPart& part) { return part.file->path; }

std::size_t count(const VerifyPart& part, Verdict::Result result) {
  return static_cast<std::size_t>(std::count_if(
      part.answers.begin(), part.answers.end(),
      [&](const ReportedAnswer& reported) { return reported.answer->verdict.result == result; }));
}

/// With line ends that are easier to read than those of xml_text.
std::string xml_lines(std::string_view text) {
  std::string escaped;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    escaped += xml_text(text.substr(begin, end - begin)) + "\n";
    begin = end + 1;
  }
  return escaped;
}

std::string test_case(const VerifyResult& result, const VerifyPart& part,
                      const ReportedAnswer& reported) {
  const Answer& answer = *reported.answer;
  const std::string name = fmt::format("line {}: {}", answer.property->line,
                                       title_of(*result.catalog, *answer.property));
  if (answer.verdict.result == Verdict::Result::proved) {
    return fmt::format("<testcase name=\"{}\" classname=\"{}\"/>\n", xml_text(name),
                       xml_text(file_of(part)));
  }
  const bool is_violated = answer.verdict.result == Verdict::Result::violated;
  std::string details = xml_text(describe(*result.catalog, *answer.property)) + "\n";
  if (reported.replay) {
    for (const std::string& line : reported.replay->explanation) details += xml_text(line) + "\n";
    details += "\n" + xml_lines(answer.witness->text);
  }
  return broken_case(
      name, file_of(part),
      junit_problem(is_violated ? "failure" : "error", is_violated ? "property" : "limit",
                    describe_answer(result, part, answer), details));
}

}  // namespace

std::string verify_to_junit(const VerifyResult& result) {
  std::string text = open_junit(verify_command);
  for (const VerifyPart& part : result.parts) {
    text += open_suite(file_of(part), part.answers.size(), count(part, Verdict::Result::violated),
                       count(part, Verdict::Result::undecided), 0);
    text += fmt::format("<properties><property name=\"catalog\" value=\"{}\"/></properties>\n",
                        xml_text(result.catalog->file));
    for (const ReportedAnswer& answer : part.answers) text += test_case(result, part, answer);
    text += close_suite();
  }
  return text + close_junit();
}

std::string verify_to_github(const VerifyResult& result) {
  std::string text;
  for (const VerifyPart& part : result.parts) {
    for (const ReportedAnswer& reported : part.answers) {
      const Answer& answer = *reported.answer;
      if (answer.verdict.result == Verdict::Result::proved) continue;
      const Property& property = *answer.property;
      std::string message = title_of(*result.catalog, property) + "\n";
      if (!property.name.empty()) message += describe(*result.catalog, property) + "\n";
      message += describe_answer(result, part, answer);
      if (reported.replay) {
        for (const std::string& line : reported.replay->explanation) message += "\n" + line;
      }
      const Position begin{static_cast<std::uint32_t>(property.line), 1};
      text +=
          github_command("error", {file_of(part), Range{begin, begin}},
                         fmt::format("cbc property {}", name_of(answer.verdict.result)), message);
    }
  }
  return text;
}

std::span<const VerifyFormat> verify_formats() {
  using Result = const VerifyResult&;
  static constexpr VerifyFormat formats[] = {
      {"text", verify_to_text},
      {"json", [](Result result, const Style& /*style*/) { return verify_to_json(result); }},
      {"junit", [](Result result, const Style& /*style*/) { return verify_to_junit(result); }, true,
       [](const std::vector<Diagnostic>& findings) {
         return junit_of_unreadable(verify_command, findings);
       }},
      {"github", [](Result result, const Style& /*style*/) { return verify_to_github(result); },
       true,
       [](const std::vector<Diagnostic>& findings) {
         std::string text;
         for (const Diagnostic& finding : findings) {
           if (finding.severity == Severity::error) text += github_command_of(finding);
         }
         return text;
       }},
  };
  return formats;
}

}  // namespace cbc
