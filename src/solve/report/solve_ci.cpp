#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

#include "core/diagnostic/diagnostic.h"
#include "core/report/github.h"
#include "core/report/junit_parts.h"
#include "core/report/run_json.h"
#include "core/report/run_report.h"
#include "core/report/run_text.h"
#include "core/report/sentences.h"
#include "solve/report/solve_report.h"

namespace cbc {

constexpr std::string_view junit_command = "cbc solve";

JunitReport::JunitReport(std::FILE* out, bool is_part) : out_(out) {
  if (is_part) return;
  fmt::print(out_, "{}", open_junit(junit_command));
}

void JunitReport::begin_run(const CompiledCatalog& catalog, const Script& script) {
  catalog_ = &catalog;
  script_ = &script;
  explanation_.begin_run(catalog);
  failed_.clear();
}

void JunitReport::on_event(const EventRecord& record, const Step* step, const State& state) {
  explanation_.add(record, step, state);
}

void JunitReport::on_failure(const Failure& failure) {
  std::string details =
      fmt::format("{}: {}\n", format_place(xml_text(script_->file), failure.range.begin),
                  xml_text(failure.message));
  for (const std::string& line : explanation_.tell(failure)) details += xml_text(line) + "\n";
  failed_.push_back({failure.step, failure.message, std::move(details)});
}

void JunitReport::end_run(const RunResult& result, const std::string& error) {
  const auto tests = static_cast<std::uint64_t>(
      std::count_if(script_->steps.begin(), script_->steps.end(),
                    [](const Step& step) { return step.expect.has_value(); }));
  const std::uint64_t errors = error.empty() ? 0 : 1;
  fmt::print(out_, "{}<properties><property name=\"catalog\" value=\"{}\"/></properties>\n",
             open_suite(script_->file, tests + errors, result.failed, errors,
                        tests - result.passed - result.failed),
             xml_text(catalog_->file));
  write_cases(result);
  if (!error.empty()) {
    fmt::print(out_, "{}",
               broken_case("runs to its end", script_->file,
                           junit_problem("error", "run", error, xml_text(error))));
  }
  fmt::print(out_, "{}", close_suite());
}

/// Expectations are checked in the order of the script, so if a run ends early, the first ones are
/// done.
void JunitReport::write_cases(const RunResult& result) const {
  std::uint64_t to_come = result.passed + result.failed;
  auto failed = failed_.begin();
  for (const Step& step : script_->steps) {
    if (!step.expect) continue;
    fmt::print(out_, R"(<testcase name="line {}: {}" classname="{}")", step.range.begin.line,
               xml_text(describe_expectation(*catalog_, *step.expect)), xml_text(script_->file));
    if (to_come == 0) {
      fmt::print(out_, "><skipped message=\"the run ended earlier\"/></testcase>\n");
      continue;
    }
    --to_come;
    if (failed != failed_.end() && failed->step == &step) {
      fmt::print(out_, ">\n{}\n</testcase>\n",
                 junit_problem("failure", "expectation", failed->message, failed->details));
      ++failed;
    } else {
      fmt::print(out_, "/>\n");
    }
  }
}

void JunitReport::end() { fmt::print(out_, "{}", close_junit()); }

std::unique_ptr<SolveReport> JunitReport::make_part(std::FILE* out) const {
  return std::unique_ptr<SolveReport>(new JunitReport(out, true));
}

void JunitReport::add_part(std::string_view text, const RunResult& /*result*/) {
  fmt::print(out_, "{}", text);
}

void JunitReport::report_unreadable(std::FILE* out, const std::vector<Diagnostic>& findings) {
  fmt::print(out, "{}", junit_of_unreadable(junit_command, findings));
}

void GithubReport::begin_run(const CompiledCatalog& catalog, const Script& script) {
  script_file_ = script.file;
  explanation_.begin_run(catalog);
}

void GithubReport::on_event(const EventRecord& record, const Step* step, const State& state) {
  explanation_.add(record, step, state);
}

void GithubReport::on_failure(const Failure& failure) {
  std::string message = failure.message;
  for (const std::string& line : explanation_.tell(failure)) message += "\n" + line;
  fmt::print(
      out_, "{}",
      github_command("error", {script_file_, failure.range}, "cbc expectation failed", message));
}

void GithubReport::end_run(const RunResult& /*result*/, const std::string& error) {
  if (error.empty()) return;
  fmt::print(out_, "{}", github_command("error", {script_file_}, "cbc run ended early", error));
}

std::unique_ptr<SolveReport> GithubReport::make_part(std::FILE* out) const {
  return std::make_unique<GithubReport>(out);
}

void GithubReport::add_part(std::string_view text, const RunResult& /*result*/) {
  fmt::print(out_, "{}", text);
}

void GithubReport::report_unreadable(std::FILE* out, const std::vector<Diagnostic>& findings) {
  for (const Diagnostic& finding : findings) {
    if (finding.severity == Severity::error) fmt::print(out, "{}", github_command_of(finding));
  }
}

std::span<const SolveFormat> solve_formats() {
  using Report = std::unique_ptr<SolveReport>;
  using Settings = const ReportSettings&;
  static constexpr SolveFormat formats[] = {
      {"text",
       [](Settings settings) -> Report {
         return std::make_unique<TextReport>(settings.style, settings.out, settings.layout);
       }},
      {"json",
       [](Settings settings) -> Report {
         return std::make_unique<JsonReport>(settings.out, settings.adds);
       }},
      {"junit",
       [](Settings settings) -> Report { return std::make_unique<JunitReport>(settings.out); },
       JunitReport::report_unreadable},
      {"github",
       [](Settings settings) -> Report { return std::make_unique<GithubReport>(settings.out); },
       GithubReport::report_unreadable},
  };
  return formats;
}

}  // namespace cbc
