#pragma once

#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "core/report/event_json.h"
#include "core/report/failure_explanation.h"
#include "core/report/run_report.h"
#include "core/report/run_text.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"

// The reports of `cbc solve` that others do not have, and all its formats.

namespace cbc {

/// Writes failed expectations and runs that ended early as workflow commands of GitHub Actions:
/// each becomes an annotation of its line in the script. Nothing is written about successes.
class GithubReport final : public SolveReport {
 public:
  explicit GithubReport(std::FILE* out) : out_(out) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override;
  void end_run(const RunResult& result, const std::string& error) override;

  [[nodiscard]] std::unique_ptr<SolveReport> make_part(std::FILE* out) const override;
  void add_part(std::string_view text, const RunResult& result) override;

  /// Writes the errors of files that could not be read, in place of runs.
  static void report_unreadable(std::FILE* out, const std::vector<Diagnostic>& findings);

 private:
  std::FILE* const out_;
  std::string script_file_;
  FailureExplanation explanation_;
};

/// Writes runs as JUnit XML (the schema that Jenkins validates with): a script is a test suite, an
/// expectation a test case. A run that ended early is an error, and the expectations it did not
/// reach are skipped. There are no times: those of a mission are not durations of tests.
class JunitReport final : public SolveReport {
 public:
  explicit JunitReport(std::FILE* out) : JunitReport(out, false) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override;
  void end_run(const RunResult& result, const std::string& error) override;
  void end() override;

  [[nodiscard]] std::unique_ptr<SolveReport> make_part(std::FILE* out) const override;
  void add_part(std::string_view text, const RunResult& result) override;

  /// Writes why there were no runs. Each file with errors is a suite; if there is none, one suite
  /// says that something else is wrong.
  static void report_unreadable(std::FILE* out, const std::vector<Diagnostic>& findings);

 private:
  struct FailedCase {
    const Step* step = nullptr;
    std::string message;
    std::string details;  ///< as XML
  };

  JunitReport(std::FILE* out, bool is_part);
  void write_cases(const RunResult& result) const;
  std::FILE* const out_;
  const CompiledCatalog* catalog_ = nullptr;
  const Script* script_ = nullptr;
  FailureExplanation explanation_;
  std::vector<FailedCase> failed_;  ///< in the order of the script
};

/// What a report depends on besides the runs.
struct ReportSettings {
  std::FILE* out = stdout;
  Style style = plain_style();  ///< of a text for people
  EventAdditions adds;          ///< of a report for programs
  TextLayout layout;            ///< of a text for people
};

/// A format of `cbc solve` for whole runs. Event streams (jsonl) are not among them.
struct SolveFormat {
  std::string_view name;
  std::unique_ptr<SolveReport> (*make)(const ReportSettings& settings);
  /// Writes why there are no runs, in place of a report. Null: nothing is written then.
  void (*report_unreadable)(std::FILE* out, const std::vector<Diagnostic>& findings) = nullptr;
};

/// The first one is the default.
[[nodiscard]] std::span<const SolveFormat> solve_formats();

}  // namespace cbc
