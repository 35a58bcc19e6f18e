#include "script_run.h"

#include "core/diagnostic/diagnostic.h"
#include "core/script/reader.h"
#include "core/script/runner.h"
#include "core/yaml/document.h"
#include "demand.h"
#include "runtime/coordinator/coordinator.h"

namespace cbc::plain {

using oracle::contains;
using oracle::demand;

namespace {

class Recorder final : public RunListener {
 public:
  Recorder(const CompiledCatalog& catalog, const std::vector<TaskId>& tasks, ScriptRun& run)
      : catalog_(catalog), tasks_(tasks), run_(run) {
    for (const TaskId task : tasks) groups_.push_back(catalog.tasks[task].group);
  }

  void on_event(const ExplainedRecord& record, const Step*, const State& state) override {
    demand(record.origin != Origin::timeout, "a timeout fired");
    if (!is_foreign(record)) {
      run_.happenings.push_back(happening_of(catalog_, record, state, tasks_));
    }
  }
  void on_failure(const Failure& failure) override { run_.failures.push_back(failure.message); }
  void on_end(const State& state) override { run_.end = visible_part(catalog_, state, tasks_); }

 private:
  [[nodiscard]] bool is_foreign(const EventRecord& record) const {
    if (record.task != none) return !contains(groups_, catalog_.tasks[record.task].group);
    return record.behavior != none && !contains(groups_, catalog_.group_of(record.behavior));
  }

  const CompiledCatalog& catalog_;
  const std::vector<TaskId>& tasks_;
  std::vector<GroupId> groups_;
  ScriptRun& run_;
};

}  // namespace

ScriptRun run_text(const CompiledCatalog& catalog, const std::string& text,
                   const std::vector<TaskId>& tasks) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "script.yaml", diagnostics);
  demand(document != nullptr, "no YAML");
  const auto script = read_script(*document, catalog, Severity::error, diagnostics);
  std::string impossible;
  for (const Diagnostic& finding : diagnostics.all()) {
    if (finding.rule == "supporting-request") continue;  // the assumptions request any task
    const std::string what =
        "a finding in line " + std::to_string(finding.range.begin.line) + ": " + finding.message;
    demand(finding.rule == "impossible-expectation", what);
    impossible = what;
  }
  demand(script.has_value(), "no script");
  demand(!script->timeouts, "timeouts are on");
  CoordinatorOptions options;
  ScriptRun run;
  Recorder recorder(catalog, tasks, run);
  const RunResult result = run_script(catalog, *script, options, recorder);
  demand(result.status == Coordinator::Status::ok, "the run ended early");
  demand(result.passed + result.failed == 1, "not one expectation");
  demand(impossible.empty() || result.failed == 1,
         "the expectation holds, but there is " + impossible);
  return run;
}

}  // namespace cbc::plain
