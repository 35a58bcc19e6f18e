#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "commands.h"
#include "core/command_line/command_line.h"
#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/files/file_search.h"
#include "core/files/output.h"
#include "core/files/progress.h"
#include "core/files/read.h"
#include "core/support/wording.h"
#include "lint/linter.h"
#include "lint/report/lint_report.h"

namespace cbc::cli {
namespace {

constexpr const char* lint_examples =
    "  cbc lint robot.yaml                       every mistake, with place and reason\n"
    "  cbc lint --strict .                       a folder; also fail on warnings\n"
    "  cbc lint --diff robot.yaml                what --fix would change\n"
    "  cbc lint --explain dead-behavior          what a rule means and how to fix it\n";

constexpr const char* lint_footer =
    "A comment '# cbc: allow RULE' allows a finding where it stands; a file .cbc.yaml has settings "
    "for a folder.\n"
    "\n"
    "Exit status: 0 no errors, 1 errors (with --strict, also warnings), 2 a file could not be read "
    "or written, or the usage is wrong, 3 an internal error.\n"
    "\n"
    "Read more: man cbc-lint, man cbc-rules (every rule, with examples)";

int explain_rule(const std::string& name) {
  const Rule* rule = find_rule(name);
  if (rule == nullptr) {
    std::vector<std::string_view> names;
    for (const Rule& known : all_rules()) names.push_back(known.name);
    const std::string meant = did_you_mean(nearest(name, names));
    return usage_error("lint", "there is no rule {}{}", quote(name),
                       meant.empty() ? " (--list-rules lists them)" : meant);
  }
  fmt::print("{}", rule_text(*rule, style_for(stdout)));
  return exit_ok;
}

/// Says what is wrong with the choice of files; empty if nothing is.
std::string find_misuse(const LintCommand& command) {
  if (command.paths.empty() && command.scripts.empty())
    return "expected a catalog, or an event script or property file that names one";
  if (!command.scripts.empty() &&
      (command.paths.size() > 1 || (command.paths.size() == 1 && is_folder(command.paths[0])))) {
    return "--script checks against one catalog, but several are given";
  }
  const auto is_stdin_in = [](const std::vector<std::string>& paths) {
    return std::find(paths.begin(), paths.end(), "-") != paths.end();
  };
  const bool has_stdin = is_stdin_in(command.paths) || is_stdin_in(command.scripts);
  if (!command.stdin_filename.empty() && !has_stdin) {
    return "--stdin-filename needs '-' (standard input) among the files";
  }
  if (command.fix && !command.diff && has_stdin) {
    return "standard input cannot be fixed in place; --diff shows what would change";
  }
  return {};
}

/// Lints everything. Returns whether each path had something to lint.
bool lint_all(const LintCommand& command, Linter& linter) {
  bool has_failed = false;
  const std::vector<FoundFile> targets = find_files(command.paths, {".yaml", ".yml"}, has_failed);
  std::set<std::string> folders_of_named;
  Progress progress("linting", targets.size() + command.scripts.size());
  for (const FoundFile& target : targets) {
    progress.begin(target.path);
    if (target.is_named) {
      linter.lint_catalog(target.path);
      folders_of_named.insert(target.folder);
    } else {
      linter.lint_in_folder(target.path, target.folder);
    }
  }
  linter.lint_found();
  for (const std::string& script : command.scripts) {
    progress.begin(script);
    linter.lint_script(script, command.paths.empty() ? "" : command.paths[0]);
  }
  progress.clear();
  linter.check_settings();
  for (const std::string& path : command.paths) {
    if (!is_folder(path) || linter.has_checked(path) || folders_of_named.contains(path)) continue;
    complain("found nothing to check in {}", quote(path));
    has_failed = true;
  }
  return !has_failed;
}

void print_report(const LintCommand& command, const Linter& linter, bool is_complete) {
  if (command.diff) {
    fmt::print("{}", linter.diff());
    if (linter.has_found()) complain("other findings need a person to fix them: see 'cbc lint'");
    return;
  }
  const LintRun run{std::filesystem::current_path().string(), is_complete, style_for(stdout),
                    linter.not_understood()};
  if (command.summary && command.format == "text") {
    for (const LintedFile& file : linter.files()) {
      if (file.kind == LintedFile::Kind::catalog || file.kind == LintedFile::Kind::unknown) {
        fmt::print("{}", lint_summary(file, run.style));
      }
    }
  }
  fmt::print("{}", find_named(lint_formats(), command.format)->write(linter.files(), run));
}

bool has_faults(const std::vector<LintedFile>& files) {
  return std::any_of(files.begin(), files.end(), [](const LintedFile& file) {
    return count(file, Severity::error) + count(file, Severity::warning) > 0;
  });
}

int lint(const LintCommand& command) {
  if (command.list_rules) {
    fmt::print("{}", rule_list(style_for(stdout)));
    return exit_ok;
  }
  if (!command.explain.empty()) return explain_rule(command.explain);
  if (const std::string misuse = find_misuse(command); !misuse.empty()) {
    return usage_error("lint", misuse);
  }

  std::vector<std::string> errors;
  SeveritySettings settings = settings_of_options(command.severities, errors);
  if (!errors.empty()) return usage_error("lint", join(errors, "\ncbc: "));

  Linter linter(command, std::move(settings));
  const bool has_all = lint_all(command, linter);
  if (!linter.files().empty() || !linter.not_understood().empty()) {
    print_report(command, linter, has_all && !linter.has_failed());
  }
  if (command.fix && !command.diff && !linter.has_mended() && has_faults(linter.files())) {
    complain("none of these findings can be fixed in place");
  }
  if (linter.has_internal_error()) return exit_internal;
  if (!has_all || linter.has_failed()) return exit_unusable;
  return linter.has_found() ? exit_no : exit_ok;
}

}  // namespace

void add_lint_command(Program& program) {
  const std::vector<std::string> formats = names_in(lint_formats());
  const auto options = std::make_shared<LintCommand>();
  Command& command =
      program.add_command("lint", "Finds mistakes in catalogs, each with its place and its reason.",
                          {{"[OPTION...] [CATALOG...]", "--fix|--diff [OPTION...] CATALOG...",
                            "--explain RULE", "--list-rules"},
                           lint_examples,
                           lint_footer});
  command.argument("CATALOG", options->paths, input("...", ValueKind::catalog),
                   "Catalogs, and scripts and property files that name theirs; folders of them; - "
                   "for standard input");
  command.option("--script", options->scripts, input("FILE", ValueKind::script),
                 "Also check this script or property file");
  command.format_option(options->format, formats);
  command.flag("--summary", options->summary, "Show figures of each catalog, compiled ones too")
      .only_with_values("--format", {"text", "json"});
  command.flag("--fix", options->fix, "Fix in place what can be without changing the meaning");
  command.flag("--diff", options->diff, "Show what --fix would change, as a diff")
      .not_with({"--summary"})
      .only_with_values("--format", {"text"});
  command.option("--stdin-filename", options->stdin_filename, name_of("NAME", ValueKind::file),
                 "Name of standard input in messages, for .cbc.yaml");
  command.option("--max-nodes", options->max_nodes, whole_number("N", 1),
                 "Decisions for the proof of a finding");
  command.add_confinement();

  command.group("Rules");
  const auto names = [] {
    std::vector<NameWithHelp> all;
    for (const Rule& known : all_rules()) {
      all.push_back({std::string(known.name), std::string(known.summary)});
    }
    return all;
  };
  const Values rules{"RULE,...", "a rule", {}, names};
  command.option("--error", options->severities.error, rules, "Report findings of a rule as errors")
      .separated_by(',');
  command.option("--warn", options->severities.warn, rules, "Report findings of a rule as warnings")
      .separated_by(',');
  command
      .option("--note", options->severities.note, rules,
              "Report findings of a rule as notes; turns it on")
      .separated_by(',');
  command.option("--allow", options->severities.allow, rules, "Do not report findings of a rule")
      .separated_by(',');
  command.flag("--strict", options->severities.strict, "Also fail on warnings");
  const std::string only_explains = "it describes rules and checks no files";
  command.option("--explain", options->explain, {"RULE", "a rule", {}, names}, "Explain a rule")
      .not_with({"CATALOG", "--script"}, only_explains)
      .only_with_values("--format", {"text"});
  command.flag("--list-rules", options->list_rules, "List all rules")
      .not_with({"CATALOG", "--script"}, only_explains)
      .only_with_values("--format", {"text"});
  command.action([options] { return lint(*options); });
}

}  // namespace cbc::cli
