#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "cli/drawable.h"

namespace CLI {
class App;
}

namespace cbc::cli {

/// Which state of a mission `cbc graph` draws.
struct StateOptions {
  std::optional<std::string> script;  ///< empty: no state, but the catalog
  std::optional<std::uint64_t> after;
  std::string at;
};

void add_state_options(CLI::App& command, StateOptions& options);

/// What is wrong with the combination of options; empty if nothing is.
[[nodiscard]] std::string find_misuse(const StateOptions& options);

/// Runs the script on the catalog, or on the one that it names if `catalog` is empty. Null if there
/// is no such state: why is printed, and `status` is set.
[[nodiscard]] std::unique_ptr<Drawable> read_state(const std::string& catalog,
                                                   const StateOptions& options, int& status);

}  // namespace cbc::cli
