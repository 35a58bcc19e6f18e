#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coordinator/coordinator.h"
#include "script/script.h"
#include "sweep/settings.h"

namespace cbc {

/// Is told of every event of a sequence, with the state after it.
class SequenceListener {
 public:
  virtual ~SequenceListener() = default;
  virtual void on_event(const EventRecord& record, const State& state) = 0;
};

struct SequenceEnd {
  Coordinator::Status status = Coordinator::Status::ok;
  std::string internal_error;  ///< if an answer was refused
};

/// Runs one random sequence from the start, as its script would run.
[[nodiscard]] SequenceEnd run_sequence(const CompiledCatalog& catalog,
                                       const SweepSettings& settings, std::uint64_t sequence,
                                       SequenceListener& listener);

/// The steps of a sequence up to the one by whose end event `index` has happened; all of them if it
/// never does.
[[nodiscard]] std::vector<Step> steps_of_sequence(const CompiledCatalog& catalog,
                                                  const SweepSettings& settings,
                                                  std::uint64_t sequence, std::uint64_t index);

/// A script for `cbc solve` with these steps. Each line of `comment` stands above it.
[[nodiscard]] std::string write_script(const CompiledCatalog& catalog,
                                       const std::vector<Step>& steps, const std::string& comment);

/// The options of `cbc solve` that a script needs to run as in the sweep: " --max-nodes 5".
[[nodiscard]] std::string options_for_script(const SweepSearch& search);

}  // namespace cbc
