#include "report/solve_github.h"

#include <fmt/format.h>

#include "report/github_command.h"
#include "report/lint_github.h"

namespace cbc {

void GithubReport::begin_run(const CompiledCatalog& catalog, const Script& script) {
  script_file_ = script.file;
  story_.begin_run(catalog);
}

void GithubReport::on_event(const EventRecord& record, const Step* step, const State& state) {
  story_.add(record, step, state);
}

void GithubReport::on_failure(const Failure& failure) {
  std::string message = failure.message;
  for (const std::string& line : story_.tell(*failure.step->expect)) message += "\n" + line;
  fmt::print(
      out_, "{}",
      github_command("error", {script_file_, failure.range}, "cbc expectation failed", message));
}

void GithubReport::end_run(const RunResult& /*result*/, const std::string& error) {
  if (error.empty()) return;
  fmt::print(out_, "{}", github_command("error", {script_file_}, "cbc run ended early", error));
}

std::unique_ptr<SolveReport> GithubReport::make_part(std::FILE* out) const {
  return std::make_unique<GithubReport>(out);
}

void GithubReport::add_part(std::string_view text, const RunResult& /*result*/) {
  fmt::print(out_, "{}", text);
}

void GithubReport::add_unreadable(const std::vector<Diagnostic>& findings) {
  for (const Diagnostic& finding : findings) {
    if (finding.severity != Severity::error) continue;
    fmt::print(out_, "{}", github_command_of(finding));
  }
}

}  // namespace cbc
