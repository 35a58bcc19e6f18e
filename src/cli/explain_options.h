#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coordinator/explanation.h"

namespace CLI {
class App;
}

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

/// Whether the catalog has all names; says on standard error which it has not.
[[nodiscard]] bool knows_names(const CompiledCatalog& catalog, const ExplainOptions& options);

}  // namespace cbc::cli
