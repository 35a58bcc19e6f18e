#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cbc/event.h"
#include "cbc/units.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/values.h"
#include "runtime/compiled/compiled_catalog.h"

/// The keys of the mappings in a script.
namespace cbc::shape {

extern const yaml::Shape script;
extern const yaml::Shape event;
extern const yaml::Shape expectation;
extern const yaml::Shape finished_task;

}  // namespace cbc::shape

namespace cbc {

/// Parameters as a script gives them.
struct Parameters {
  std::string canonical;  ///< see Event::parameters
  std::string json;       ///< as JSON text, for reports
};

/// A check of the state at its place in the script.
struct Expectation {
  struct Running {
    std::uint32_t task = 0;
    std::vector<std::uint32_t> behaviors;  ///< it runs with one of these; empty: any
  };
  std::optional<Outcome> outcome;  ///< of the last scripted start, stop or finish
  std::vector<Running> running;
  std::vector<std::uint32_t> stopped;                ///< tasks that do not run
  std::optional<std::vector<std::uint32_t>> active;  ///< exactly these behaviors are active
  std::vector<std::uint32_t> active_includes;        ///< these are active, others or not
  /// Exactly these tasks have a suspended request; exactly these behaviors have failed, and are not
  /// tried again.
  std::optional<std::vector<std::uint32_t>> suspended;
  std::optional<std::vector<std::uint32_t>> failed;
};

/// What an event changes of the situation.
struct Situation {
  std::vector<Availability> availability;
  std::vector<VariableValue> variables;

  [[nodiscard]] bool is_empty() const { return availability.empty() && variables.empty(); }
};

/// One entry of a script: an event, or an expectation.
struct Step {
  Range range;
  std::optional<Microseconds> time;   ///< absolute; empty: the time of the step before
  std::optional<Expectation> expect;  ///< if set, the fields below mean nothing
  Verb verb = Verb::wait;
  std::uint32_t subject = 0;
  std::optional<std::int32_t> priority;
  std::optional<Parameters> parameters;
  bool is_by_task = false;  ///< see Event
  FinishCause cause = FinishCause::goal_achieved;
  Situation situation;
};

/// A scripted mission, checked against its catalog. Tasks and behaviors are in catalog order.
struct Script {
  std::string file;
  std::string catalog;  ///< path of the catalog, as the script names it; empty: it names none
  Microseconds reactive_delay = 80'000;
  bool timeouts = true;  ///< see CoordinatorOptions
  Situation situation;   ///< before the first event
  std::vector<Step> steps;
};

/// A script as text for `cbc solve`, below the lines of `comment`. `comments`: by step, lines to
/// write before it; it may be empty.
[[nodiscard]] std::string write_script(const CompiledCatalog& catalog, const Script& script,
                                       const std::string& comment,
                                       std::span<const std::string> comments = {});

}  // namespace cbc
