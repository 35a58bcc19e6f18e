#pragma once

#include <cstddef>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "compiled/compiled_catalog.h"
#include "coordinator/record.h"
#include "coordinator/search_totals.h"
#include "coordinator/state.h"
#include "report/explanation.h"
#include "report/solve_report.h"
#include "script/runner.h"
#include "script/script.h"
#include "text/style.h"

namespace cbc {

/// Writes a run for a person: a line for each event, below it the changes in the columns of the
/// execution viewer of the paper (P priority, T type, S success), at the end what is active.
class TextReport final : public SolveReport {
 public:
  TextReport(const Style& style, std::FILE* out) : style_(style), out_(out) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override;
  void on_end(const State& state) override;
  /// An error is told elsewhere.
  void end_run(const RunResult& result, const std::string& error) override;
  /// The sum, if there are several runs, and what searches took, if that was measured.
  void end() override;

  [[nodiscard]] std::unique_ptr<SolveReport> make_part(std::FILE* out) const override;
  void add_part(std::string_view text, const RunResult& result) override;

 private:
  [[nodiscard]] std::string describe_outcome(const EventRecord& record) const;
  void write_change(const EventRecord& record, const Change& change);
  void write_stopped(const EventRecord& record);
  void write_explanation(const EventRecord& record, const State& state);
  void write_alternatives(const EventRecord& record, const State& state);
  void write(const Sentences& sentences);
  void count(const RunResult& result);

  const Style style_;
  std::FILE* const out_;
  const CompiledCatalog* catalog_ = nullptr;
  std::string script_file_;
  std::size_t behavior_width_ = 0;
  std::size_t task_width_ = 0;
  std::size_t runs_ = 0;
  std::size_t failed_runs_ = 0;
  std::optional<SearchTotals> totals_;
};

}  // namespace cbc
