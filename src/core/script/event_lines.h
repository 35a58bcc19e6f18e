#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "core/script/reader.h"
#include "core/script/script.h"
#include "core/yaml/document.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"

namespace cbc {

// Events that are read line by line, from streams and from logs.

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

/// Takes the first line of a text, without its end.
[[nodiscard]] std::string_view take_line(std::string_view& text);

/// Whether a text begins as `cbc solve --format jsonl` begins.
[[nodiscard]] bool is_log(std::string_view text);

/// Reads the lines of a recorded stream of events (`cbc solve --format jsonl`).
class EventLog {
 public:
  struct Header {
    std::string catalog;  ///< its path, as the user gave it
    Microseconds reactive_delay = 0;
    bool timeouts = true;
    Situation situation;  ///< with the values of all variables
  };
  struct Entry {
    bool is_event = false;         ///< false: the answer to a line that was not an event
    std::uint64_t index = 0;       ///< of an event: how many there are up to it
    Microseconds time = 0;         ///< of an event
    bool is_from_outside = false;  ///< of origin script
    std::optional<Step> step;      ///< of such an event, unless it is left out
    std::string what;              ///< "start LAND"
    std::optional<Outcome> outcome;
    std::vector<std::pair<std::string, std::string>> running;  ///< tasks with their behaviors
  };
  /// Which catalog the log was made with: this one, or any; what this one lacks is then left out.
  enum class Origin : std::uint8_t { same, any };

  /// The catalog must outlive this object.
  explicit EventLog(const CompiledCatalog& catalog, Origin origin = Origin::same)
      : catalog_(catalog), reader_(catalog, Severity::note), is_foreign_(origin == Origin::any) {
    reader_.stop_checking_parameters();
  }

  /// Both are empty if the line is not as expected: see error().
  [[nodiscard]] std::optional<Header> read_header(std::string_view line);
  [[nodiscard]] std::optional<Entry> read_entry(std::string_view line, std::uint32_t number);
  [[nodiscard]] const std::string& error() const { return error_; }
  /// What the catalog lacks, each in words with its line.
  [[nodiscard]] const std::vector<std::string>& left_out() const { return left_out_; }

 private:
  [[nodiscard]] const yaml::Node* read_object(std::string_view line, std::uint32_t number,
                                              Reporter& reporter);
  [[nodiscard]] bool is_known(const std::string& key, const yaml::Node& value) const;
  [[nodiscard]] yaml::Node known_part(const yaml::Node& situation);
  [[nodiscard]] std::string find_unknown(const yaml::Node& event, const VerbForm& form) const;
  void leave_out(const std::string& what);
  [[nodiscard]] Entry read_event(const yaml::Node& event, Reporter& reporter);
  [[nodiscard]] Step read_step(const yaml::Node& event, Verb verb, Reporter& reporter);
  [[nodiscard]] bool is_good(const Reporter& reporter, const Diagnostics& diagnostics);

  const CompiledCatalog& catalog_;
  StepReader reader_;
  yaml::JsonReader json_;
  std::string error_;
  const bool is_foreign_;
  std::uint32_t line_ = 0;
  std::vector<std::string> left_out_;
};

}  // namespace cbc
