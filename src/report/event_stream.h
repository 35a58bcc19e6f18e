#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "cbc/event.h"
#include "cbc/units.h"
#include "compiled/compiled_catalog.h"
#include "coordinator/search_totals.h"
#include "report/event_json.h"
#include "script/runner.h"

namespace cbc {

// The lines of a stream of events, each with the end of the line.

/// `catalog_name`: as it was named.
[[nodiscard]] std::string stream_header(const CompiledCatalog& catalog,
                                        std::string_view catalog_name, Microseconds reactive_delay,
                                        std::span<const Availability> situation);
/// Of a line of the input that is no event.
[[nodiscard]] std::string stream_error(std::string_view message, std::uint64_t line);

/// What searches took, for the end of a stream; and the process, until now.
[[nodiscard]] std::string stream_totals(const SearchTotals& totals);

/// Gives each event away as a line as soon as it is solved.
class EventStream final : public RunListener {
 public:
  using TakeLine = std::function<void(std::string_view)>;
  using TakeFailure = std::function<void(const Failure&)>;

  /// The catalog must outlive this object.
  EventStream(const CompiledCatalog& catalog, const EventAdditions& adds, TakeLine take_line,
              TakeFailure take_failure)
      : catalog_(catalog),
        adds_(adds),
        take_line_(std::move(take_line)),
        take_failure_(std::move(take_failure)) {}

  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override { take_failure_(failure); }
  void on_end(const State& /*state*/) override {}

 private:
  const CompiledCatalog& catalog_;
  const EventAdditions adds_;
  TakeLine take_line_;
  TakeFailure take_failure_;
  std::string line_;  ///< kept for its memory
};

}  // namespace cbc
