#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sweep/settings.h"

namespace CLI {
class App;
}

namespace cbc::cli {

/// The options of `cbc solve` that make it a sweep.
struct SweepOptions {
  std::optional<std::uint64_t> sequences;  ///< set: a sweep
  bool merge = false;
  std::uint64_t seed = 1;
  std::uint32_t events = SweepShape{}.events;
  std::int32_t priorities = SweepShape{}.priorities;
  std::string failures = "0.3";
  std::string faults = "0.1";
  std::string shard = "1/1";
  std::optional<std::string> slowest;
  std::optional<std::string> slowest_by_time;

  [[nodiscard]] bool is_wanted() const { return sequences.has_value() || merge; }
};

void add_sweep_options(CLI::App& command, SweepOptions& options);

/// All of the settings that these options say; the search is set by others.
[[nodiscard]] SweepSettings settings_of(const SweepOptions& options);

}  // namespace cbc::cli
