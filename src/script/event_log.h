#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "diagnostic/reporter.h"
#include "script/names.h"
#include "script/script.h"
#include "yaml/json_reader.h"

namespace cbc {

/// Reads the lines of a recorded stream of events (`cbc solve --format jsonl`).
class EventLog {
 public:
  struct Header {
    std::string catalog;  ///< as it was named
    Microseconds reactive_delay = 0;
    std::vector<Availability> situation;
  };
  struct Entry {
    bool is_event = false;     ///< if not, it is the answer to a line that was no event
    Microseconds time = 0;     ///< of an event
    std::optional<Step> step;  ///< of an event of origin script
  };

  /// The catalog must outlive this object.
  explicit EventLog(const CompiledCatalog& catalog) : catalog_(catalog), names_(catalog) {}

  /// Each is empty if the line is not what it should be: see error().
  [[nodiscard]] std::optional<Header> read_header(std::string_view line);
  [[nodiscard]] std::optional<Entry> read_entry(std::string_view line, std::uint32_t number);
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  [[nodiscard]] const yaml::Node* read_object(std::string_view line, std::uint32_t number,
                                              Reporter& reporter);
  [[nodiscard]] std::vector<Availability> read_situation(const yaml::Node& node,
                                                         Reporter& reporter);
  [[nodiscard]] Entry read_event(const yaml::Node& event, Reporter& reporter);
  [[nodiscard]] Step read_step(const yaml::Node& event, Reporter& reporter);
  [[nodiscard]] bool is_good(const Reporter& reporter, const Diagnostics& diagnostics);

  const CompiledCatalog& catalog_;
  NameIndex names_;
  yaml::JsonReader json_;
  std::string error_;
};

}  // namespace cbc
