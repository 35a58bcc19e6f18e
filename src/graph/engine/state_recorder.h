#pragma once

#include <cstdint>
#include <optional>

#include "cbc/units.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "graph/engine/catalog_graph.h"
#include "graph/engine/diagram.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// Selects a state of a run: the one after an event, after all events up to a time, or, if neither
/// is given, at the end.
struct WantedState {
  std::optional<std::uint64_t> index;  ///< of the event; 0: before the first one
  std::optional<Microseconds> time;
};

/// Records the selected state of a run, for a picture of it.
class StateRecorder final : public RunListener {
 public:
  /// `catalog` must outlive this object.
  StateRecorder(const CompiledCatalog& catalog, const Script& script, const WantedState& wanted);

  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override;
  void on_end(const State& state) override;

  /// Whether the run has reached the state. A run that reached its end has passed all times.
  [[nodiscard]] bool has_passed() const { return has_passed_; }
  /// Number of events so far.
  [[nodiscard]] std::uint64_t events() const { return events_; }
  /// The selected state, or the last one before it.
  [[nodiscard]] const draw::RunState& state() const { return state_; }
  [[nodiscard]] const draw::Moment& moment() const { return moment_; }

 private:
  void note_behaviors(const State& state);

  const CompiledCatalog& catalog_;
  const WantedState wanted_;
  draw::RunState state_;
  draw::Moment moment_;
  std::uint64_t events_ = 0;
  bool has_passed_ = false;
};

}  // namespace cbc
