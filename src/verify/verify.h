#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/command_line/limits.h"

namespace cbc::cli {

/// The options of `cbc verify`.
struct VerifyOptions {
  std::vector<std::string> paths;
  std::string format = "text";
  std::string output = "-";
  std::optional<std::string> scripts;
  std::optional<std::string> html;
  std::optional<std::uint64_t> jobs;
  std::optional<std::string> same_as;
  std::vector<std::string> renamed;  ///< OLD=NEW
  bool allow_missing = false;
  StateLimits limits;
  std::vector<std::string> cut_sets;   ///< names of tasks
  std::vector<std::string> refused;    ///< names of tasks
  std::optional<std::uint32_t> order;  ///< default: 2 of cut sets, 1 of effects
  bool in_some_situation = false;
  std::vector<std::string> situation;  ///< KEY=VALUE
  bool effects = false;
  bool overrides = false;
  bool outcomes = false;
  bool situations = false;
  std::optional<std::string> fail_on;  ///< "lost", "degraded:60"
};

/// Answers what the command line asks, and writes the report. Returns the exit status.
[[nodiscard]] int verify(const VerifyOptions& options);

}  // namespace cbc::cli
