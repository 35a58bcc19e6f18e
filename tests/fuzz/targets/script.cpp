#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "core/report/run_report.h"
#include "core/script/reader.h"
#include "core/script/runner.h"
#include "core/support/system.h"
#include "core/yaml/document.h"
#include "fuzz/catalogs.h"
#include "fuzz/program.h"
#include "fuzz/target.h"
#include "page/html_report.h"
#include "solve/report/solve_report.h"

// A script on a catalog, run and reported.
namespace cbc::fuzz {
namespace {

/// One of the reports: all of them for each input would be slow.
std::unique_ptr<SolveReport> make_report(const ReportSettings& settings, std::size_t number) {
  const auto formats = solve_formats();
  number %= formats.size() + 1;
  if (number == formats.size()) return std::make_unique<HtmlReport>(settings.adds);
  return formats[number].make(settings);
}

void run(const std::string& input) {
  const std::vector<std::string> parts = split_parts(input);
  if (parts.size() != 2) return;
  const auto catalog = catalog_of(parts.front());
  if (catalog == nullptr) return;
  Diagnostics diagnostics;
  const auto document = yaml::parse(parts.back(), "mission.yaml", diagnostics);
  if (document == nullptr) return;
  const auto script = read_script(*document, *catalog, Severity::warning, diagnostics);
  require(script.has_value() != diagnostics.has_errors(), "a script is refused without a reason");
  if (!script) return;

  const Questions questions{
      .rejections = true, .displaced = true, .alternatives = 1, .failures = true};
  MemoryFile memory;
  const auto report = make_report({memory.stream(), plain_style(), {true, true}, {}}, input.size());
  report->begin_run(*catalog, *script);
  const RunResult result = run_script(*catalog, *script, bounded_coordinator(), *report, questions);
  report->end_run(result, "");
  report->end();
  if (result.status == Coordinator::Status::refused_answer) fail(result.internal_error);
}

std::vector<std::string> seeds() {
  std::vector<std::string> inputs;
  for (const Pair& pair : catalogs_with_scripts()) {
    inputs.push_back(join_parts(std::vector{pair.catalog, pair.text}));
  }
  return inputs;
}

}  // namespace

Target script_target() {
  return {"script",       "a script, on a catalog: events, explanations, reports",
          Language::yaml, 1,
          8192,           run,
          seeds};
}

}  // namespace cbc::fuzz
