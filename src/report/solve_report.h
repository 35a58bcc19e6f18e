#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "compiled/compiled_catalog.h"
#include "script/runner.h"
#include "script/script.h"

namespace cbc {

/// Is told of all runs of a call, one after the other; what happens in a run comes between its
/// begin and its end. Catalogs and scripts outlive it.
class SolveReport : public RunListener {
 public:
  virtual void begin_run(const CompiledCatalog& catalog, const Script& script) = 0;
  /// `error`: why the run ended early, or empty.
  virtual void end_run(const RunResult& result, const std::string& error) = 0;
  /// After the last run.
  virtual void end() = 0;

  // For runs that are not told one after the other.

  /// A report that is told of one run, on any thread, and writes to `out` what this one would write
  /// of it. Null: this report has to be told of all runs itself.
  [[nodiscard]] virtual std::unique_ptr<SolveReport> make_part(std::FILE* /*out*/) const {
    return nullptr;
  }
  /// Takes, in place of a run, what a part has written of it.
  virtual void add_part(std::string_view /*text*/, const RunResult& /*result*/) {}
};

/// Passes everything on to two reports.
class ReportPair final : public SolveReport {
 public:
  ReportPair(SolveReport& one, SolveReport& other) : first_(one), second_(other) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override {
    first_.begin_run(catalog, script);
    second_.begin_run(catalog, script);
  }
  void on_event(const EventRecord& record, const Step* step, const State& state) override {
    first_.on_event(record, step, state);
    second_.on_event(record, step, state);
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
