#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "compiled/compiled_catalog.h"
#include "coordinator/record.h"
#include "coordinator/state.h"
#include "report/memory_file.h"
#include "report/solve_json.h"
#include "report/solve_report.h"
#include "script/runner.h"
#include "script/script.h"

namespace cbc {

/// Makes one page of all runs, with everything in it: a picture to look at, to step through, to
/// print. Its data are the report in JSON, and of each catalog what the picture needs beyond that.
class HtmlReport final : public SolveReport {
 public:
  HtmlReport() : json_(memory_.stream()) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override;
  void on_end(const State& state) override;
  void end_run(const RunResult& result, const std::string& error) override;
  void end() override;

  /// The page, after the end.
  [[nodiscard]] std::string page();

 private:
  MemoryFile memory_;
  JsonReport json_;
  std::vector<const CompiledCatalog*> catalogs_;
  nlohmann::ordered_json catalogs_json_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json runs_ = nlohmann::ordered_json::array();
};

}  // namespace cbc
