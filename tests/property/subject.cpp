#include "property/subject.h"

#include <stdexcept>
#include <utility>

#include "catalog/reader.h"
#include "compile/compile.h"
#include "compiled/compiled_file.h"
#include "report/solve_report.h"
#include "script/reader.h"
#include "script/runner.h"
#include "yaml/document.h"

namespace cbc::oracle {
namespace {

[[noreturn]] void refuse(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    text += diagnostic.file + ":" + std::to_string(diagnostic.range.begin.line) + ": " +
            diagnostic.message + "\n";
  }
  throw std::runtime_error(text);
}

nlohmann::ordered_json event_to_json(const CompiledCatalog& catalog, const EventRecord& record,
                                     const Step* step, const State& state,
                                     const EventAdditions& adds) {
  std::string text;
  append_event(text, catalog, record, step, state, adds);
  return nlohmann::ordered_json::parse(text);
}

class Events final : public RunListener {
 public:
  explicit Events(const CompiledCatalog& catalog) : catalog_(catalog) {}

  void on_event(const EventRecord& record, const Step* step, const State& state) override {
    events_.push_back(event_to_json(catalog_, record, step, state, {}));
  }
  void on_failure(const Failure& failure) override { throw std::runtime_error(failure.message); }
  void on_end(const State& /*state*/) override {}

  [[nodiscard]] nlohmann::ordered_json take() { return std::move(events_); }

 private:
  const CompiledCatalog& catalog_;
  nlohmann::ordered_json events_ = nlohmann::ordered_json::array();
};

CompiledCatalog compile_text(const std::string& catalog_yaml) {
  Diagnostics diagnostics;
  const auto catalog = read_catalog(catalog_yaml, "catalog.yaml", diagnostics);
  if (!catalog) refuse(diagnostics);
  return compile(*catalog);
}

cbc::Script read_text(const std::string& script_yaml, const CompiledCatalog& catalog) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(script_yaml, "script.yaml", diagnostics);
  if (!document) refuse(diagnostics);
  const auto script = read_script(*document, catalog, Severity::warning, diagnostics);
  if (!script) refuse(diagnostics);
  return *script;
}

class ExplainedEvents final : public RunListener {
 public:
  explicit ExplainedEvents(const CompiledCatalog& catalog) : catalog_(catalog) {}

  void on_event(const EventRecord& record, const Step* step, const State& state) override {
    auto event = event_to_json(catalog_, record, step, state, {true, true});
    EventRecord of_displaced = record;
    of_displaced.explanation.why.clear();
    for (const Displacement& displaced : record.explanation.displaced) {
      Why why;
      why.task = displaced.task;
      why.why_not = displaced.why_not;
      of_displaced.explanation.why.push_back(why);
    }
    const auto explained = event_to_json(catalog_, of_displaced, step, state, {true, false});
    event["displaced"] = explained.value("why", nlohmann::ordered_json::array());
    events_.push_back(std::move(event));
  }
  void on_failure(const Failure& failure) override { throw std::runtime_error(failure.message); }
  void on_end(const State& /*state*/) override {}

  [[nodiscard]] nlohmann::ordered_json take() { return std::move(events_); }

 private:
  const CompiledCatalog& catalog_;
  nlohmann::ordered_json events_ = nlohmann::ordered_json::array();
};

/// `easy_nodes`, `bounded_nodes`: see SearchOptions; 0 puts the means of hard searches to work from
/// the start.
nlohmann::ordered_json run(const CompiledCatalog& catalog, const cbc::Script& script,
                           std::uint64_t easy_nodes, std::uint64_t bounded_nodes) {
  Events events(catalog);
  CoordinatorOptions options;
  options.search.easy_nodes = easy_nodes;
  options.search.bounded_nodes = bounded_nodes;
  const RunResult result = run_script(catalog, script, options, events);
  if (result.status != Coordinator::Status::ok) {
    throw std::runtime_error("the run ended early: " + result.internal_error);
  }
  return events.take();
}

void strip_effort(nlohmann::ordered_json& events) {
  for (auto& event : events) {
    if (event["search"].is_object()) {
      event["search"].erase("nodes");
      event["search"].erase("solutions");
    }
  }
}

}  // namespace

nlohmann::ordered_json run_subject(const std::string& catalog_yaml,
                                   const std::string& script_yaml) {
  const CompiledCatalog compiled = compile_text(catalog_yaml);
  const cbc::Script script = read_text(script_yaml, compiled);
  nlohmann::ordered_json easy =
      run(compiled, script, SearchOptions{}.easy_nodes, SearchOptions{}.bounded_nodes);
  const CompiledFileResult loaded = read_compiled(write_compiled(compiled, {}));
  if (!loaded.file) throw std::runtime_error("the compiled file is refused: " + loaded.error);
  nlohmann::ordered_json hard = run(loaded.file->catalog, script, 0, UINT64_MAX);
  nlohmann::ordered_json learned = run(loaded.file->catalog, script, 0, 0);
  strip_effort(easy);
  strip_effort(hard);
  strip_effort(learned);
  if (easy != hard || easy != learned) {
    throw std::runtime_error(
        "answers depend on the file, or on when the search looks ahead, or learns");
  }
  return easy;
}

nlohmann::ordered_json explain_subject(const std::string& catalog_yaml,
                                       const std::string& script_yaml, std::uint32_t alternatives) {
  const CompiledCatalog compiled = compile_text(catalog_yaml);
  CoordinatorOptions options;
  options.explain.displaced = true;
  options.explain.alternatives = alternatives;
  for (std::uint32_t task = 0; task < compiled.task_names.size(); ++task) {
    options.explain.why.push_back({true, task});
  }
  for (std::uint32_t behavior = 0; behavior < compiled.behavior_names.size(); ++behavior) {
    options.explain.why.push_back({false, behavior});
  }
  ExplainedEvents events(compiled);
  const RunResult result = run_script(compiled, read_text(script_yaml, compiled), options, events);
  if (result.status != Coordinator::Status::ok) {
    throw std::runtime_error("the run ended early: " + result.internal_error);
  }
  return events.take();
}

}  // namespace cbc::oracle
