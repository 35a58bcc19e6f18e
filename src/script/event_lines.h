#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coordinator/state.h"
#include "script/script.h"
#include "script/step_reader.h"
#include "yaml/json_reader.h"

namespace cbc {

/// Reads events that come line by line, each a JSON object or a mapping in YAML.
class EventLines {
 public:
  /// What a line says: a step, an error, or, if neither is there, nothing (an empty line or a
  /// comment).
  struct Reading {
    std::optional<Step> step;
    std::string error;
    std::vector<std::string> warnings;  ///< the step may be used all the same
  };

  /// The catalog must outlive this object.
  explicit EventLines(const CompiledCatalog& catalog) : reader_(catalog, Severity::warning) {}

  [[nodiscard]] Reading read(std::string_view line, std::uint32_t number);

  /// Goes on from the state that a coordinator has come to: at the beginning, or to forget what a
  /// line with errors said.
  void resume(Microseconds now, const State& state) { reader_.resume(now, state); }

 private:
  yaml::JsonReader json_;
  StepReader reader_;
};

}  // namespace cbc
