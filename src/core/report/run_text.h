#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cbc/units.h"
#include "core/diagnostic/diagnostic.h"
#include "core/report/blocks.h"
#include "core/report/run_report.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "core/words/explanation_words.h"
#include "core/words/failure_explanation.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"

namespace cbc {

// What stands at the end of the text about runs, where people look first.

/// The summary of one run: how many events were accepted and rejected, which were rejected, which
/// behaviors time out again and again while the script does nothing, and which expectations failed,
/// with their places.
class RunSummary {
 public:
  /// Starts a run.
  void begin_run(const CompiledCatalog& catalog, const Script& script);
  void add(const EventRecord& record, const Step* step);

  void write(const RunResult& result, Text& text);

 private:
  /// Timeouts since the last event of the script.
  struct Timeouts {
    Microseconds first = 0;
    Microseconds last = 0;
    std::map<BehaviorId, std::uint64_t> counts;
  };

  void note_timeout(const EventRecord& record);
  void end_timeouts();

  const CompiledCatalog* catalog_ = nullptr;
  std::string file_;
  std::vector<std::string> rejected_;
  Timeouts timeouts_;
  std::vector<std::string> cycles_;
};

/// The summary of several runs: a row for each script, and the places of all failures.
void write_scripts(const std::vector<RunResult>& results, Text& text);

/// The form of a text about runs.
struct TextLayout {
  std::size_t columns = 0;  ///< lines are wrapped to so many; 0: not at all
  bool is_brief = false;    ///< an event is one line, but for reasons
};

/// Writes a run for people: a line for each event, below it the changes with the columns of the
/// execution viewer in the paper (P priority, T type, S success); at the end the active behaviors
/// and a summary.
class TextReport final : public SolveReport {
 public:
  TextReport(const Style& style, std::FILE* out, const TextLayout& layout = {})
      : style_(style), layout_(layout), out_(out), text_(style, layout.columns) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override;
  /// Something that is no event, at its place among the events.
  void write_between(Microseconds time, const std::string& what,
                     const std::vector<std::string>& reasons);
  void on_end(const State& state) override;
  /// Errors go to standard error, not here.
  void end_run(const RunResult& result, const std::string& error) override;
  /// Writes the totals: of several runs, and of searches if they were measured.
  void end() override;

  [[nodiscard]] std::unique_ptr<SolveReport> make_part(std::FILE* out) const override;
  void add_part(std::string_view text, const RunResult& result) override;

 private:
  [[nodiscard]] std::string outcome_of(const ExplainedRecord& record, const State& state) const;
  [[nodiscard]] std::string brief_details(const ExplainedRecord& record) const;
  void write_event(const std::string& time, const std::string& event, const std::string& outcome);
  void write_details(const ExplainedRecord& record, const State& state);
  void write_change(const EventRecord& record, const Change& change);
  void write_failed(const EventRecord& record);
  void write_stopped(const EventRecord& record);
  void write_asked(const ExplainedRecord& record, const State& state);
  void write_alternatives(const ExplainedRecord& record, const State& state);
  void write(const Sentences& sentences);
  void flush();
  void count(const RunResult& result);

  const Style style_;
  const TextLayout layout_;
  std::FILE* const out_;
  Text text_;  ///< what is not yet written
  const CompiledCatalog* catalog_ = nullptr;
  FailureExplanation explanation_;
  RunSummary summary_;
  std::vector<RunResult> results_;
  std::string script_file_;
  std::optional<Table> changes_;
  std::size_t runs_ = 0;
  std::size_t failed_runs_ = 0;
  std::size_t missing_runs_ = 0;  ///< of scripts that were not run
  std::optional<SearchTotals> totals_;
};

}  // namespace cbc
