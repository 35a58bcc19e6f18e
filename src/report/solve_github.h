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

/// Writes failed expectations, and runs that ended early, as workflow commands of GitHub Actions:
/// each becomes an annotation of its line of the script. Nothing is written of what went well.
class GithubReport final : public SolveReport {
 public:
  explicit GithubReport(std::FILE* out) : out_(out) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override;
  void on_end(const State& /*state*/) override {}
  void end_run(const RunResult& result, const std::string& error) override;
  void end() override {}

  [[nodiscard]] std::unique_ptr<SolveReport> make_part(std::FILE* out) const override;
  void add_part(std::string_view text, const RunResult& result) override;

  /// In place of runs: why there were none, as far as files have errors.
  void add_unreadable(const std::vector<Diagnostic>& findings);

 private:
  std::FILE* const out_;
  std::string script_file_;
  FailureStory story_;
};

}  // namespace cbc
