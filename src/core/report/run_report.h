#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "core/script/runner.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// Receives all runs of a call, one after the other: for each run begin_run, its events, end_run.
/// Catalogs and scripts must outlive it.
class SolveReport : public RunListener {
 public:
  virtual void begin_run(const CompiledCatalog& catalog, const Script& script) = 0;
  /// `error`: why the run ended early, or empty.
  virtual void end_run(const RunResult& result, const std::string& error) = 0;
  /// After the last run.
  virtual void end() {}

  // For runs in parallel.

  /// A report for one run, on any thread, which writes to `out` what this one would write. Null:
  /// this report must receive all runs itself.
  [[nodiscard]] virtual std::unique_ptr<SolveReport> make_part(std::FILE* /*out*/) const {
    return nullptr;
  }
  /// Adds what a part has written, in place of its run.
  virtual void add_part(std::string_view /*text*/, const RunResult& /*result*/) {}
};

/// Forwards everything to two reports.
class ReportPair final : public SolveReport {
 public:
  ReportPair(SolveReport& one, SolveReport& other) : first_(one), second_(other) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override {
    first_.begin_run(catalog, script);
    second_.begin_run(catalog, script);
  }
  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override {
    first_.on_event(record, step, state);
    second_.on_event(record, step, state);
  }
  void on_success(const Success& success) override {
    first_.on_success(success);
    second_.on_success(success);
  }
  void on_failure(const Failure& failure) override {
    first_.on_failure(failure);
    second_.on_failure(failure);
  }
  void on_end(const State& state) override {
    first_.on_end(state);
    second_.on_end(state);
  }
  void end_run(const RunResult& result, const std::string& error) override {
    first_.end_run(result, error);
    second_.end_run(result, error);
  }
  void end() override {
    first_.end();
    second_.end();
  }

 private:
  SolveReport& first_;
  SolveReport& second_;
};

}  // namespace cbc
