#include "property/subject.h"

#include <optional>
#include <stdexcept>
#include <utility>

#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "core/report/event_json.h"
#include "core/script/reader.h"
#include "core/script/runner.h"
#include "core/words/suitability.h"
#include "core/yaml/document.h"
#include "runtime/compiled/compiled_file.h"

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

nlohmann::ordered_json event_to_json(const CompiledCatalog& catalog, const ExplainedRecord& record,
                                     const Step* step, const State& state,
                                     const EventAdditions& adds) {
  std::string text;
  append_event(text, catalog, record, step, state, adds);
  return nlohmann::ordered_json::parse(text);
}

class Events final : public RunListener {
 public:
  explicit Events(const CompiledCatalog& catalog) : catalog_(catalog) {}

  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override {
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

  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override {
    auto event = event_to_json(catalog_, record, step, state, {true, true});
    ExplainedRecord of_displaced = record;
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
  const RunResult result = run_script(catalog, script, options, events, {.rejections = true});
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

/// What the events of a script, and no others, led to.
class Outcomes final : public RunListener {
 public:
  struct Entry {
    bool is_finish = false;
    Outcome outcome = Outcome::unchanged;
    std::optional<SearchStatus> status;
    bool has_failed_change = false;
    std::uint32_t satisfied = 0;
    double suitability = 0;
    std::optional<AnswerBound> bound;
    bool same_requests = false;
    std::int32_t protection = 0;
    std::vector<std::uint32_t> running;
  };

  explicit Outcomes(const CompiledCatalog& catalog) : catalog_(catalog) {}

  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override {
    if (step == nullptr) return;
    last = {};
    last.is_finish = record.verb == Verb::finish;
    last.outcome = record.outcome;
    if (record.search != nullptr) {
      last.status = record.search->result.status;
      last.protection = record.search->protection;
    }
    for (const Change& change : record.changes) last.has_failed_change |= !change.success;
    last.running = state.running();
    if (!record.objective) return;
    last.satisfied = record.objective->satisfied;
    last.suitability = total_suitability(catalog_, state);
    if (last.status != SearchStatus::feasible) return;
    last.bound = bound_of_answer(catalog_, record, state);
    last.same_requests = record.search->result.bound.same_requests;
  }

  Entry last;

 private:
  const CompiledCatalog& catalog_;
};

/// What is wrong with an answer within limits, against the proven one from the same state.
std::optional<std::string> find_fault(const Outcomes::Entry& limited,
                                      const Outcomes::Entry& proven) {
  if (limited.status != SearchStatus::feasible && limited.status != SearchStatus::unknown) {
    if (limited.outcome != proven.outcome) return "another outcome without a limit";
    if (limited.running != proven.running) return "another answer, which is said to be proven";
    return std::nullopt;
  }
  if (limited.status == SearchStatus::unknown) {
    if (limited.is_finish) return "a finish without an answer";
    return limited.outcome == Outcome::rejected ? std::nullopt
                                                : std::optional("unknown, but not rejected");
  }
  if (proven.outcome != Outcome::accepted) return "an answer where there is none";
  // The best answer may serve fewer requests in order to serve more important ones.
  if (limited.protection == proven.protection && limited.satisfied > proven.satisfied) {
    return "more requests than the best";
  }
  if (limited.bound->satisfied < proven.satisfied) return "the bound of f1 is too low";
  if (limited.bound->suitability < limited.suitability) return "the bound is below the answer";
  if (limited.bound->suitability < proven.suitability) return "the bound of f2 is too low";
  if (limited.same_requests && limited.satisfied != proven.satisfied) return "other requests";
  if (limited.same_requests && limited.suitability > proven.suitability) {
    return "better than the best";
  }
  return std::nullopt;
}

}  // namespace

void check_limits(const std::string& catalog_yaml, const std::string& script_yaml,
                  Statistics& statistics) {
  const CompiledCatalog catalog = compile_text(catalog_yaml);
  const cbc::Script script = read_text(script_yaml, catalog);
  CoordinatorOptions options;
  options.reactive_delay = script.reactive_delay;
  options.timeouts = script.timeouts;
  Outcomes best(catalog);
  Runner proven(catalog, options, best);
  proven.begin(script.situation);
  for (std::size_t index = 0; index < script.steps.size(); ++index) {
    const cbc::Step& step = script.steps[index];
    cbc::Step wait;
    wait.time = step.time;
    if (!proven.take(wait)) throw std::runtime_error("the run ended early");
    const Snapshot before = proven.snapshot();
    if (!proven.take(step)) throw std::runtime_error("the run ended early");
    if (step.expect || !form_of(step.verb).is_decided) continue;
    for (const bool learns : {false, true}) {
      for (const std::uint64_t nodes : {1U, 2U, 4U}) {
        CoordinatorOptions with_limit = options;
        with_limit.search.max_nodes = nodes;
        if (learns) with_limit.search.easy_nodes = with_limit.search.bounded_nodes = 0;
        Outcomes outcomes(catalog);
        Runner limited(catalog, with_limit, outcomes);
        limited.resume(before);
        if (!limited.take(step)) throw std::runtime_error(limited.result().internal_error);
        if (!outcomes.last.status) continue;
        statistics.count("limited: " + std::string(name_of(*outcomes.last.status)));
        if (outcomes.last.same_requests) statistics.count("limited: same requests");
        // A failure of a behavior that the best answer does not touch excludes it.
        if (outcomes.last.has_failed_change || best.last.has_failed_change) continue;
        if (const auto fault = find_fault(outcomes.last, best.last)) {
          throw std::runtime_error(*fault + ": step " + std::to_string(index + 1) +
                                   ", --max-nodes " + std::to_string(nodes));
        }
      }
    }
  }
}

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
  Questions questions{.rejections = true, .displaced = true, .alternatives = alternatives};
  for (std::uint32_t task = 0; task < compiled.task_names.size(); ++task) {
    questions.why.push_back({true, task});
  }
  for (std::uint32_t behavior = 0; behavior < compiled.behavior_names.size(); ++behavior) {
    questions.why.push_back({false, behavior});
  }
  ExplainedEvents events(compiled);
  const RunResult result =
      run_script(compiled, read_text(script_yaml, compiled), {}, events, questions);
  if (result.status != Coordinator::Status::ok) {
    throw std::runtime_error("the run ended early: " + result.internal_error);
  }
  return events.take();
}

}  // namespace cbc::oracle
