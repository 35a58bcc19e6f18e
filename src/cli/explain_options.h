#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/mission.h"
#include "coordinator/explanation.h"

namespace cbc::cli {

/// What to explain, as the command line has it.
struct ExplainOptions {
  std::vector<std::string> why;  ///< names of tasks and behaviors
  std::uint32_t alternatives = 0;
};

void add_explain_options(CLI::App& command, ExplainOptions& options);

/// The same for one catalog, that knows the names.
[[nodiscard]] ExplanationOptions explanation_for(const CompiledCatalog& catalog,
                                                 const ExplainOptions& options);

/// Whether each catalog knows all names; says on standard error what is wrong.
[[nodiscard]] bool knows_all_names(const std::vector<Mission>& missions,
                                   const ExplainOptions& options);

}  // namespace cbc::cli
