#pragma once

#include <cstdio>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "compiled/compiled_catalog.h"
#include "coordinator/record.h"
#include "coordinator/state.h"
#include "report/solve_report.h"
#include "script/runner.h"
#include "script/script.h"

namespace cbc {

/// One event as the JSON of `cbc solve` has it. `step` is the scripted one, or null.
[[nodiscard]] nlohmann::ordered_json event_to_json(const CompiledCatalog& catalog,
                                                   const EventRecord& record, const Step* step,
                                                   const State& state);

/// A set of reasons as the JSON of `cbc solve` has it.
[[nodiscard]] nlohmann::ordered_json reasons_to_json(const CompiledCatalog& catalog,
                                                     const EventRecord& record,
                                                     std::span<const Reason> reasons);

/// What the events have beside the keys that they always have.
struct JsonAdditions {
  bool why = false;
  bool alternatives = false;
};

/// Writes runs as one JSON document, event by event, so that memory does not grow with the run.
class JsonReport final : public SolveReport {
 public:
  explicit JsonReport(std::FILE* out, const JsonAdditions& adds = {});

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override;
  void on_end(const State& /*state*/) override {}
  void end_run(const RunResult& result, const std::string& error) override;
  void end() override;

 private:
  void write(const std::string& text);
  void begin_item(bool& is_first, const char* indent);

  std::FILE* const out_;
  const JsonAdditions adds_;
  const CompiledCatalog* catalog_ = nullptr;
  bool is_first_run_ = true;
  bool is_first_event_ = true;
  nlohmann::ordered_json failures_;
};

}  // namespace cbc
