#pragma once

#include <cstdint>
#include <string>

#include "cbc/units.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/state.h"

namespace cbc {

/// A stream of events, or its end, as the HTML page gets it: the page is that of HtmlReport.
struct StreamOfPage {
  std::string name;            ///< of the stream
  std::string begin;           ///< the state before it, see state_of_page()
  std::string events;          ///< as in cbc.events/1, separated by commas
  std::uint64_t left_out = 0;  ///< events after these, which do not fit on a page
  std::string error;           ///< why it ended early, or empty
  /// If it is not empty, the page gets further events from "events?run=TOKEN", relative to itself.
  std::string token;
};

[[nodiscard]] std::string stream_page(const CompiledCatalog& catalog, const StreamOfPage& stream);

/// What the page has to know about a state to show the events after it, as JSON on one line:
///
///   index, time    of the last event before
///   running, requests, queue    as in an event of cbc.solve/1
///   situation      the values of all variables, and the behaviors that are not available
///   faulty         behaviors
[[nodiscard]] std::string state_of_page(const CompiledCatalog& catalog, std::uint64_t index,
                                        Microseconds time, const State& state);

}  // namespace cbc
