#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/script/runner.h"
#include "core/script/script.h"
#include "core/words/failure_explanation.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"

// Events of a run, as JSON.

namespace cbc {

/// The optional keys of events.
struct EventAdditions {
  bool why = false;
  bool alternatives = false;
  bool note = false;  ///< for the page alone: see describe_note
};

/// Appends an expectation that failed, as an object. `explanation`: of its run, up to it.
void append_failure(std::string& text, const CompiledCatalog& catalog, const Failure& failure,
                    const FailureExplanation& explanation);

/// Appends one event as JSON on one line, as in cbc.solve/1. `step` is the scripted one, or null.
/// No tree is built: streams write a hundred thousand events per second.
void append_event(std::string& text, const CompiledCatalog& catalog, const ExplainedRecord& record,
                  const Step* step, const State& state, const EventAdditions& adds);

// The lines of an event stream (schema cbc.events/1), each with its line end.

/// `catalog_name`: the path of the catalog as the user gave it. `variables`: the values of the
/// situation variables. Of the options a replay needs those that a script sets. `clock`: the
/// word of the option.
[[nodiscard]] std::string stream_header(const CompiledCatalog& catalog,
                                        std::string_view catalog_name,
                                        const CoordinatorOptions& options,
                                        const Situation& situation,
                                        std::span<const std::uint32_t> variables,
                                        std::string_view clock);
/// The answer to an input line that is not an event.
[[nodiscard]] std::string stream_error(std::string_view message, std::uint64_t line);

/// The last line of a stream with statistics: the effort of all searches and of the process so far.
[[nodiscard]] std::string stream_totals(const SearchTotals& totals);

/// Of a line.
[[nodiscard]] std::string stream_schema();

/// Passes on each event as a line as soon as it is solved.
class EventStream final : public RunListener {
 public:
  /// A line with its end, and what it is about.
  struct Line {
    std::string_view text;
    const ExplainedRecord& record;
    const Step* step;    ///< the scripted one, or null
    const State& state;  ///< after the event
  };
  using TakeLine = std::function<void(const Line&)>;
  using TakeFailure = std::function<void(const Failure&)>;

  /// The catalog must outlive this object.
  EventStream(const CompiledCatalog& catalog, const EventAdditions& adds, TakeLine take_line,
              TakeFailure take_failure)
      : catalog_(catalog),
        adds_(adds),
        take_line_(std::move(take_line)),
        take_failure_(std::move(take_failure)) {}

  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override { take_failure_(failure); }

 private:
  const CompiledCatalog& catalog_;
  const EventAdditions adds_;
  TakeLine take_line_;
  TakeFailure take_failure_;
  std::string line_;  ///< kept for its memory
};

}  // namespace cbc
