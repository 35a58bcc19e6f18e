#include <string>
#include <string_view>
#include <vector>

#include "core/check/severity_settings.h"
#include "core/diagnostic/diagnostic.h"
#include "fuzz/catalogs.h"
#include "fuzz/lint.h"
#include "fuzz/target.h"

// A settings file, and a catalog with comments that allow findings.
namespace cbc::fuzz {
namespace {

void run(const std::string& input) {
  const std::vector<std::string> parts = split_parts(input);
  if (parts.size() != 2) return;
  Diagnostics diagnostics;
  const auto settings = read_settings(parts.front(), ".cbc.yaml", diagnostics);
  require(settings.has_value() != diagnostics.has_errors(),
          "settings are refused without a reason");
  // Comments count without settings, too.
  const SeveritySettings used = settings.value_or(SeveritySettings());
  const LintedCatalog linted = lint(parts.back(), used);
  report(linted.file);
  fix(linted, used);
  std::vector<std::string_view> tasks;
  for (const Task& task : linted.catalog.tasks) tasks.emplace_back(task.name);
  check_never_together_names(used.never_together(), tasks, diagnostics);
}

std::vector<std::string> seeds() {
  std::vector<std::string> inputs;
  for (const Pair& pair : settings_with_catalogs()) {
    inputs.push_back(join_parts(std::vector{pair.text, pair.catalog}));
  }
  return inputs;
}

}  // namespace

Target settings_target() {
  return {"settings",     "a settings file, and a catalog with comments that allow findings",
          Language::yaml, 0,
          4096,           run,
          seeds};
}

}  // namespace cbc::fuzz
