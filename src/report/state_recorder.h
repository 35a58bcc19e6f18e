#pragma once

#include <cstdint>
#include <optional>

#include "compiled/compiled_catalog.h"
#include "draw/diagram.h"
#include "draw/state_marks.h"
#include "script/runner.h"
#include "script/script.h"

namespace cbc {

/// Which state of a run is asked for: that after an event, or after all that happens by a time;
/// if neither is given, the one at the end.
struct WantedState {
  std::optional<std::uint64_t> index;  ///< of the event; 0: before the first one
  std::optional<Microseconds> time;
};

/// Keeps one state of a run.
class StateRecorder final : public RunListener {
 public:
  /// `catalog` must outlive this object.
  StateRecorder(const CompiledCatalog& catalog, const Script& script, const WantedState& wanted);

  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& /*failure*/) override {}
  void on_end(const State& state) override;

  /// Whether the run has come to the state, however it goes on. A run that came to its end has
  /// passed all of its times.
  [[nodiscard]] bool has_passed() const { return has_passed_; }
  /// How many events there were.
  [[nodiscard]] std::uint64_t events() const { return events_; }
  /// The state that is asked for, or the last one before it.
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
