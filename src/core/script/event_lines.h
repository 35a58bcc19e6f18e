#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "core/script/reader.h"
#include "core/script/script.h"
#include "core/support/json.h"
#include "core/yaml/document.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/state.h"

namespace cbc {

// Events that are read line by line, from streams and from logs, and saved states.

/// Reads events from single lines, each a JSON object or a YAML mapping.
class EventLines {
 public:
  /// The content of a line: a step, an error, or neither (an empty line or a comment).
  struct Reading {
    std::optional<Step> step;
    std::string error;
    std::vector<std::string> warnings;  ///< the step can still be used
  };

  /// The catalog must outlive this object.
  explicit EventLines(const CompiledCatalog& catalog) : reader_(catalog, Severity::warning) {}

  [[nodiscard]] Reading read(std::string_view line, std::uint32_t number);

  /// Continues from the state of a coordinator: at the beginning, or to forget a line with errors.
  void resume(Microseconds now, const State& state) { reader_.resume(now, state); }

  /// Saves the time that warnings take, for a caller that shows no more of them.
  void stop_warnings() { reader_.stop_checking_parameters(); }

 private:
  yaml::JsonReader json_;
  StepReader reader_;
};

/// The schema that the first line of a stream of events names.
inline constexpr std::string_view events_schema = "cbc.events/1";

/// Whether a text begins as `cbc solve --format jsonl` begins.
[[nodiscard]] bool is_log(std::string_view text);

/// Reads the lines of a recorded stream of events (`cbc solve --format jsonl`).
class EventLog {
 public:
  struct Header {
    std::string catalog;  ///< its path, as the user gave it
    Microseconds reactive_delay = 0;
    bool timeouts = true;
    std::string_view clock;  ///< "events" or "real"; empty in logs of older versions
    Situation situation;     ///< with the values of all variables
  };
  struct Entry {
    bool is_event = false;     ///< false: the answer to a line that was not an event
    Microseconds time = 0;     ///< of an event
    std::optional<Step> step;  ///< of an event of origin script
  };

  /// The catalog must outlive this object.
  explicit EventLog(const CompiledCatalog& catalog)
      : catalog_(catalog), reader_(catalog, Severity::note) {
    reader_.stop_checking_parameters();
  }

  /// Both are empty if the line is not as expected: see error().
  [[nodiscard]] std::optional<Header> read_header(std::string_view line);
  [[nodiscard]] std::optional<Entry> read_entry(std::string_view line, std::uint32_t number);
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  [[nodiscard]] const yaml::Node* read_object(std::string_view line, std::uint32_t number,
                                              Reporter& reporter);
  [[nodiscard]] Entry read_event(const yaml::Node& event, Reporter& reporter);
  [[nodiscard]] Step read_step(const yaml::Node& event, Reporter& reporter);
  [[nodiscard]] bool is_good(const Reporter& reporter, const Diagnostics& diagnostics);

  const CompiledCatalog& catalog_;
  StepReader reader_;
  yaml::JsonReader json_;
  std::string error_;
};

/// The state of a coordinator as a JSON document (see `cbc solve --state-out`):
///
///     {"schema": "cbc.state/1",
///      "digest": "…",                       of the catalog, see identity_of
///      "time_us": 4080000, "events": 12,    the clock, and the number of the last event
///      "reactive_delay_us": 80000,
///      "timeouts": false,                   only if they are off
///      "running": [{"task": "HOVER", "behavior": "HOVER_WITH_MPC", "since_us": 4000000,
///                   "waits_for_timeout": false,
///                   "request": {"priority": 2, "event": 9, "parameters": "…"}}],   or null
///      "active": {"HOVER_WITH_MPC": 4000000},    and when it was activated
///      "unavailable": ["GPS"], "faulty": [],
///      "variables": {"LIGHT": "dark"},           all of them
///      "queue": {"LAND": 4160000},               reactive tasks, and when they are due
///      "waiting": ["LAND"]}                      those that wait for a change of their group
///
/// Parameters are in canonical form (see Event::parameters).

/// The value of a situation variable, as a member: true or false for one without values of its own.
void write_value(JsonWriter& json, const CompiledCatalog& catalog, VariableValue value);
/// A situation, as the member "situation".
void write_situation(JsonWriter& json, const CompiledCatalog& catalog, const Situation& situation);
/// The values of all variables, as an object.
void write_variables(JsonWriter& json, const CompiledCatalog& catalog, std::string_view key,
                     std::span<const std::uint32_t> values);

[[nodiscard]] std::string write_state(const CompiledCatalog& catalog, const Snapshot& snapshot);

/// A snapshot that a coordinator on the catalog can continue from, or why there is none.
struct StateReading {
  std::optional<Snapshot> snapshot;
  std::string error;
};
[[nodiscard]] StateReading read_state(std::string_view text, const CompiledCatalog& catalog);

}  // namespace cbc
