#include "coverage/engine/mutants/telling_script.h"

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "core/script/reader.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "core/yaml/document.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/record.h"

namespace cbc {
namespace {

/// What an expectation at the end of a script can see.
struct Sight {
  std::vector<std::string_view> behaviors;  ///< by task in catalog order; empty: it does not run
  std::optional<Outcome> outcome;           ///< of the last step
};

/// Empty if the script cannot be read or run.
std::optional<Sight> see_end(const CompiledCatalog& catalog, const std::string& text) {
  Diagnostics ignored;
  const auto document = yaml::parse(text, "script", ignored);
  if (document == nullptr) return std::nullopt;
  const auto script = read_script(*document, catalog, Severity::note, ignored);
  if (!script) return std::nullopt;
  CoordinatorOptions options = options_of(*script);
  options.find_conflicts = false;
  SilentRun listener;
  Runner runner(catalog, options, listener);
  runner.begin(script->situation);
  for (const Step& step : script->steps) {
    if (!runner.take(step)) return std::nullopt;
  }
  Sight sight;
  const State& state = runner.coordinator().state();
  for (const TaskId task : catalog.task_ids) {
    const BehaviorId behavior = state.behavior(task);
    sight.behaviors.push_back(behavior == none ? std::string_view()
                                               : catalog.name_of_behavior(behavior));
  }
  sight.outcome = runner.snapshot().outcome;
  return sight;
}

/// What the original shows and the mutant does not.
Expectation find_difference(const CompiledCatalog& original, const Sight& of_original,
                            const Sight& of_mutant) {
  Expectation expectation;
  for (std::uint32_t task = 0; task < of_original.behaviors.size(); ++task) {
    const std::string_view behavior = of_original.behaviors[task];
    if (behavior == of_mutant.behaviors[task]) continue;
    if (behavior.empty()) {
      expectation.stopped.push_back(task);
    } else {
      expectation.running.push_back({task, original.find_behavior(behavior)});
    }
  }
  if (of_original.outcome != of_mutant.outcome) expectation.outcome = of_original.outcome;
  return expectation;
}

}  // namespace

std::optional<std::string> find_telling_script(const CompiledCatalog& original,
                                               const CompiledCatalog& mutant, const Script& script,
                                               std::span<const Microseconds> times) {
  for (const bool timeouts : {true, false}) {
    for (const Microseconds time : times) {
      Script told = script;
      told.timeouts = timeouts;
      Step& end = told.steps.emplace_back();
      end.time = time;
      const std::string text = write_script(original, told, {});
      const std::optional<Sight> of_original = see_end(original, text);
      const std::optional<Sight> of_mutant = see_end(mutant, text);
      if (!of_original || !of_mutant) continue;
      Expectation expectation = find_difference(original, *of_original, *of_mutant);
      if (!expectation.outcome && expectation.running.empty() && expectation.stopped.empty()) {
        continue;
      }
      told.steps.back().expect = std::move(expectation);
      return write_script(original, told, {});
    }
  }
  return std::nullopt;
}

}  // namespace cbc
