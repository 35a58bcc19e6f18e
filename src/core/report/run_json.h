#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/report/event_json.h"
#include "core/report/run_report.h"
#include "core/words/failure_explanation.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

[[nodiscard]] std::string solve_schema();

/// Writes runs as one JSON document, event by event: memory does not grow with the run.
class JsonReport final : public SolveReport {
 public:
  explicit JsonReport(std::FILE* out, const EventAdditions& adds = {})
      : JsonReport(out, adds, false) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override;
  /// An event that is only to be known to explanations of failed expectations.
  void leave_out(const ExplainedRecord& record, const Step* step, const State& state) {
    explanation_.add(record, step, state);
  }
  void on_success(const Success& success) override;
  void on_failure(const Failure& failure) override;
  void end_run(const RunResult& result, const std::string& error) override;
  void end() override;

  [[nodiscard]] std::unique_ptr<SolveReport> make_part(std::FILE* out) const override;
  void add_part(std::string_view text, const RunResult& result) override;

 private:
  JsonReport(std::FILE* out, const EventAdditions& adds, bool is_part);
  void count(const RunResult& result);
  void write(std::string_view text);
  void begin_item(bool& is_first, const char* indent);

  std::FILE* const out_;
  const EventAdditions adds_;
  const CompiledCatalog* catalog_ = nullptr;
  bool is_first_run_ = true;
  bool is_first_event_ = true;
  std::string event_;                   ///< reused, to save allocations
  std::optional<SearchTotals> totals_;  ///< if time was measured
  FailureExplanation explanation_;
  std::string successes_;  ///< expectations of the run, as JSON
  std::string failures_;
};

}  // namespace cbc
