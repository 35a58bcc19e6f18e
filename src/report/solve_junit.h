#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cbc/diagnostic.h"
#include "report/failure_story.h"
#include "report/solve_report.h"

namespace cbc {

/// Writes runs as JUnit XML, of the schema that Jenkins validates with: a script is a test suite,
/// an expectation a test case. A run that ended early is an error, and the expectations it did not
/// come to are skipped. Nothing is said of times: those of a mission are no durations of tests.
class JunitReport final : public SolveReport {
 public:
  explicit JunitReport(std::FILE* out) : JunitReport(out, false) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override;
  void on_end(const State& /*state*/) override {}
  void end_run(const RunResult& result, const std::string& error) override;
  void end() override;

  [[nodiscard]] std::unique_ptr<SolveReport> make_part(std::FILE* out) const override;
  void add_part(std::string_view text, const RunResult& result) override;

  /// In place of runs: why there were none. Each file with errors is a suite of its own; if there
  /// is none, one suite says that something else is wrong.
  void add_unreadable(const std::vector<Diagnostic>& findings);

 private:
  struct FailedCase {
    const Step* step = nullptr;
    std::string message;
    std::string details;  ///< as XML
  };

  JunitReport(std::FILE* out, bool is_part);
  void write_cases(const RunResult& result) const;
  void write_broken_suite(const std::string& file, const std::string& message,
                          const std::string& details) const;

  std::FILE* const out_;
  const CompiledCatalog* catalog_ = nullptr;
  const Script* script_ = nullptr;
  FailureStory story_;
  std::vector<FailedCase> failed_;  ///< in the order of the script
};

}  // namespace cbc
