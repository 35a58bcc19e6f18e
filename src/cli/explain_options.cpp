#include "cli/explain_options.h"

#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/input.h"
#include "cli/validators.h"
#include "cli/value_kind.h"
#include "text/nearest.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

constexpr std::uint32_t most_alternatives = 1000;

/// The name that an unknown one may stand for.
std::string suggest(const CompiledCatalog& catalog, const std::string& name) {
  std::vector<std::string_view> names;
  for (const std::string_view task : catalog.task_names) names.push_back(task);
  for (const std::string_view behavior : catalog.behavior_names) names.push_back(behavior);
  return did_you_mean(nearest(name, names));
}

}  // namespace

void add_explain_options(CLI::App& command, ExplainOptions& options) {
  command
      .add_option("--why", options.why,
                  "Say of each accepted event why this task or behavior is as it is: where the "
                  "best alternative loses. Repeatable")
      ->option_text("NAME")
      ->check(stands_for(ValueKind::task_or_behavior))
      ->allow_extra_args(false);
  command
      .add_option("--alternatives", options.alternatives,
                  fmt::format("List the K best configurations of each accepted event (at most {})",
                              most_alternatives))
      ->option_text("K")
      ->check(whole_number(1, most_alternatives));
}

ExplanationOptions explanation_for(const CompiledCatalog& catalog, const ExplainOptions& options) {
  ExplanationOptions result;
  result.alternatives = options.alternatives;
  for (const std::string& name : options.why) {
    // A task and a behavior may have the same name.
    if (const auto task = catalog.find_task(name)) result.why.push_back({true, *task});
    if (const auto behavior = catalog.find_behavior(name)) result.why.push_back({false, *behavior});
  }
  return result;
}

bool knows_names(const CompiledCatalog& catalog, const ExplainOptions& options) {
  for (const std::string& name : options.why) {
    if (catalog.find_task(name) || catalog.find_behavior(name)) continue;
    complain(fmt::format("--why: catalog {} has no task or behavior {}{}", quote(catalog.file),
                         quote(name), suggest(catalog, name)));
    return false;
  }
  return true;
}

}  // namespace cbc::cli
