#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/compile/catalog_json.h"
#include "core/script/script.h"
#include "core/support/json_description.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/state.h"

namespace cbc {

/// The state of a coordinator as a JSON document (see `cbc solve --state-out`).
[[nodiscard]] std::string write_state(const CompiledCatalog& catalog, const Snapshot& snapshot);
[[nodiscard]] std::string state_schema();

/// A snapshot that a coordinator on the catalog can continue from, or why there is none.
struct StateReading {
  std::optional<Snapshot> snapshot;
  std::string error;
};
[[nodiscard]] StateReading read_state(std::string_view text, const CompiledCatalog& catalog);

}  // namespace cbc

namespace cbc::json {

/// What a Map makes of what is said of the situation: behaviors, then variables.
[[nodiscard]] inline auto entries_of(const Situation& said, const CompiledCatalog& catalog) {
  return [&](const auto& put) {
    for (const Availability& entry : said.availability) {
      put(catalog.behavior_names[entry.behavior], entry.available);
    }
    for (const VariableValue value : said.variables) {
      put(catalog.name_of_variable(value.variable), value);
    }
  };
}

/// The same of the values of all situation variables.
[[nodiscard]] inline auto entries_of(std::span<const std::uint32_t> values,
                                     const CompiledCatalog& catalog) {
  return [values, &catalog](const auto& put) {
    for (std::uint32_t place = 0; place < values.size(); ++place) {
      put(catalog.name_of_variable(place), VariableValue{place, values[place]});
    }
  };
}

}  // namespace cbc::json
