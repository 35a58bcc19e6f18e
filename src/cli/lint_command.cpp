#include "cli/lint_command.h"

#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/exit_status.h"
#include "cli/input.h"
#include "cli/terminal.h"
#include "diagnostic/text.h"
#include "lint/lint.h"

namespace cbc::cli {

void add_lint_command(CLI::App& program, int& status) {
  const auto paths = std::make_shared<std::vector<std::string>>();
  CLI::App* const command = program.add_subcommand("lint", "Finds every mistake in catalogs.");
  command->add_option("CATALOG", *paths)->required();
  command->callback([paths, &status] {
    status = exit_ok;
    for (const std::string& path : *paths) {
      const auto text = read_input(path);
      if (!text) continue;
      Diagnostics diagnostics;
      const auto document = yaml::parse(*text, path, diagnostics);
      if (document) (void)lint_catalog(*document, {}, diagnostics);
      diagnostics.sort();
      SourceTexts sources;
      sources.add(path, *text);
      for (const Diagnostic& finding : diagnostics.all()) {
        if (finding.rule == "deprecated-key") continue;
        fmt::print("{}", render(finding, sources, wants_color(stdout)));
      }
    }
  });
}

}  // namespace cbc::cli
