#include <cstddef>
#include <string>
#include <vector>

#include "core/script/runner.h"
#include "core/script/state_json.h"
#include "fuzz/catalogs.h"
#include "fuzz/program.h"
#include "fuzz/target.h"
#include "support/exercise.h"

// A saved state, from which a mission goes on.
namespace cbc::fuzz {
namespace {

class NoListener final : public RunListener {
 public:
  void on_event(const ExplainedRecord&, const Step*, const State&) override {}
};

void run(const std::string& input) {
  const std::vector<std::string> parts = split_parts(input);
  if (parts.size() != 2) return;
  const auto catalog = catalog_of(parts.front());
  if (catalog == nullptr) return;
  const StateReading reading = read_state(parts.back(), *catalog);
  require(reading.snapshot.has_value() == reading.error.empty(),
          "a state is refused without a reason");
  if (!reading.snapshot) return;

  const std::string text = write_state(*catalog, *reading.snapshot);
  const StateReading again = read_state(text, *catalog);
  if (!again.snapshot) fail("a state that was accepted is refused when written: " + again.error);
  require(write_state(*catalog, *again.snapshot) == text, "the written state has changed");

  NoListener nobody;
  CoordinatorOptions options = bounded_coordinator();
  options.reactive_delay = reading.snapshot->reactive_delay;
  options.timeouts = reading.snapshot->timeouts;
  Runner runner(*catalog, options, nobody);
  runner.resume(*reading.snapshot);
  // The same, in catalog order.
  const std::string resumed = write_state(*catalog, runner.snapshot());
  require(resumed.size() == text.size(), "resuming changes the state");
  require(read_state(resumed, *catalog).snapshot.has_value(), "a resumed state is refused");
  if (const auto refusal = test::exercise(*catalog, &*reading.snapshot)) fail(*refusal);
}

/// The states in the middle of scripts, and at their ends.
std::vector<std::string> seeds() {
  std::vector<std::string> inputs;
  for (const Pair& pair : catalogs_with_scripts()) {
    const auto catalog = catalog_of(pair.catalog);
    const auto script = script_of(pair.text, *catalog);
    if (!script) continue;
    CoordinatorOptions options = bounded_coordinator();
    options.reactive_delay = script->reactive_delay;
    options.timeouts = script->timeouts;
    NoListener nobody;
    Runner runner(*catalog, options, nobody);
    runner.begin(script->situation);
    for (std::size_t step = 0; step < script->steps.size(); ++step) {
      if (!runner.take(script->steps[step])) break;
      if (step != script->steps.size() / 2 && step + 1 != script->steps.size()) continue;
      const std::string state = write_state(*catalog, runner.snapshot());
      inputs.push_back(join_parts(std::vector{pair.catalog, state}));
    }
  }
  return inputs;
}

}  // namespace

Target state_target() {
  return {"state", "a saved state, on a catalog", Language::json, 1, 6144, run, seeds};
}

}  // namespace cbc::fuzz
