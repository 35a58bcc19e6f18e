#include "cli/lint_command.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cbc/rules.h"
#include "cli/exit_status.h"
#include "cli/help_format.h"
#include "cli/input.h"
#include "cli/linter.h"
#include "cli/progress.h"
#include "cli/terminal.h"
#include "cli/validators.h"
#include "cli/value_kind.h"
#include "report/lint_gcc.h"
#include "report/lint_github.h"
#include "report/lint_json.h"
#include "report/lint_sarif.h"
#include "report/lint_summary.h"
#include "report/lint_text.h"
#include "report/rule_text.h"
#include "text/nearest.h"
#include "text/quote.h"
#include "text/style.h"

namespace cbc::cli {
namespace {

constexpr const char* lint_examples =
    "  cbc lint robot.yaml                       every mistake, with place and reason\n"
    "  cbc lint --diff robot.yaml                what --fix would change\n"
    "  cbc lint --explain dead-behavior          what a rule is about; how to mend it\n";

constexpr const char* lint_footer =
    "More examples:\n"
    "  cbc lint --strict catalogs/               a folder; warnings fail, too\n"
    "  cbc lint --format sarif catalogs/ > lint.sarif\n"
    "                                            for code scanning\n"
    "  cbc lint --script mission.yaml robot.yaml  an event script as well\n"
    "\n"
    "A comment '# cbc: allow RULE' at the end of a line, or above an entry, allows a finding "
    "there. A file .cbc.yaml in the folder of a catalog, or above it, has settings for all of "
    "them:\n"
    "  error: [RULE, ...]   warn: [RULE, ...]   allow: [RULE, ...]   strict: true\n"
    "\n"
    "Exit status: 0 nothing is wrong, 1 there is an error (under --strict: or a warning), 2 a "
    "file could not be read or written, or the usage is wrong, 3 an internal error.\n"
    "\n"
    "Read more: man cbc-lint, man cbc-rules (every rule, with examples)";

struct LintCommand {
  std::vector<std::string> paths;
  std::vector<std::string> scripts;
  std::string format = "text";
  SeverityOptions severities;
  std::string stdin_filename;
  std::uint64_t max_nodes = LintOptions{}.max_nodes;
  std::string explain;
  bool list_rules = false;
  bool summary = false;
  bool fix = false;
  bool diff = false;
};

int explain_rule(const std::string& name) {
  const Rule* rule = find_rule(name);
  if (rule == nullptr) {
    std::vector<std::string_view> names;
    for (const Rule& known : all_rules()) names.push_back(known.name);
    const std::string meant = did_you_mean(nearest(name, names));
    return usage_error("lint", fmt::format("there is no rule {}{}", quote(name),
                                           meant.empty() ? " (--list-rules lists them)" : meant));
  }
  fmt::print("{}", rule_text(*rule, style_for(stdout)));
  return exit_ok;
}

/// What is wrong with the combination of options; empty if nothing is.
std::string find_misuse(const LintCommand& command) {
  if (command.list_rules || !command.explain.empty()) {
    const bool is_alone =
        command.paths.empty() && command.scripts.empty() && command.format == "text";
    return is_alone ? "" : "--explain and --list-rules print a text about rules, and lint nothing";
  }
  if (command.paths.empty() && command.scripts.empty()) {
    return "no catalog given to lint";
  }
  if (!command.scripts.empty() &&
      (command.paths.size() > 1 || (command.paths.size() == 1 && is_folder(command.paths[0])))) {
    return "--script checks against one catalog, but several are given";
  }
  const auto stdin_count = std::count(command.paths.begin(), command.paths.end(), "-") +
                           std::count(command.scripts.begin(), command.scripts.end(), "-");
  if (stdin_count > 1) return stdin_only_once;
  if (!command.stdin_filename.empty() && stdin_count == 0) {
    return "--stdin-filename is of use with '-' only";
  }
  if (command.fix && !command.diff && stdin_count > 0) {
    return "standard input cannot be fixed in place; --diff shows what would change";
  }
  if (command.diff && command.summary) {
    return "--diff writes a diff, so --summary does not go with it";
  }
  if (command.summary && command.format != "text" && command.format != "json") {
    return fmt::format("--summary goes with --format text or json, not {}", command.format);
  }
  if (command.diff && command.format != "text") {
    return "--diff writes a diff, so --format does not go with it";
  }
  return {};
}

/// A file to lint.
struct Target {
  std::string path;
  bool is_named = false;  ///< by itself: it is linted whatever it is
  std::string folder;     ///< that was given, if the file is in it
};

/// The files of all paths, each once. A folder that cannot be read is complained of.
std::vector<Target> find_targets(const std::vector<std::string>& paths, bool& has_failed) {
  std::vector<Target> targets;
  std::unordered_map<std::string, std::size_t> places;
  const auto target_of = [&](const std::string& path) -> Target& {
    const auto [known, is_new] = places.try_emplace(path, targets.size());
    if (is_new) targets.push_back({path, false, {}});
    return targets[known->second];
  };
  for (const std::string& path : paths) {
    if (!is_folder(path)) {
      target_of(path).is_named = true;
    } else {
      for (const std::string& file : list_folder(path, {".yaml", ".yml"}, has_failed)) {
        target_of(file).folder = path;
      }
    }
  }
  return targets;
}

/// Whether there was a catalog to lint.
bool lint_target(const Target& target, Linter& linter) {
  if (!target.is_named) return linter.lint_if_catalog(target.path);
  const std::size_t before = linter.files().size();
  linter.lint_catalog(target.path);
  return linter.files().size() > before && !linter.files().back().is_script;
}

/// Lints all that is given. Whether there was anything to lint everywhere.
bool lint_all(const LintCommand& command, Linter& linter) {
  bool has_failed = false;
  const std::vector<Target> targets = find_targets(command.paths, has_failed);
  std::set<std::string> folders_with_files;
  std::set<std::string> folders_with_catalogs;
  Progress progress("linting", targets.size() + command.scripts.size());
  for (const Target& target : targets) {
    progress.begin(target.path);
    folders_with_files.insert(target.folder);
    if (lint_target(target, linter)) folders_with_catalogs.insert(target.folder);
  }
  for (const std::string& script : command.scripts) {
    progress.begin(script);
    linter.lint_script(script, command.paths.empty() ? "" : command.paths[0]);
  }
  progress.clear();
  for (const std::string& path : command.paths) {
    if (!is_folder(path) || folders_with_catalogs.contains(path)) continue;
    complain(fmt::format("found no catalog in {}{}", quote(path),
                         folders_with_files.contains(path)
                             ? "; an event script is checked if it is named itself"
                             : ""));
    has_failed = true;
  }
  return !has_failed;
}

void print_report(const LintCommand& command, const Linter& linter, bool is_complete) {
  const std::vector<LintedFile>& files = linter.files();
  if (command.diff) {
    fmt::print("{}", linter.diff());
    if (linter.has_found()) complain("there is more that only a person can mend: see 'cbc lint'");
  } else if (command.format == "json") {
    fmt::print("{}", lint_json(files));
  } else if (command.format == "sarif") {
    fmt::print("{}", lint_sarif(files, std::filesystem::current_path().string(), is_complete));
  } else if (command.format == "github") {
    fmt::print("{}", lint_github(files));
  } else if (command.format == "gcc") {
    fmt::print("{}", lint_gcc(files));
  } else {
    const Style style = style_for(stdout);
    if (command.summary) {
      for (const LintedFile& file : files) {
        if (!file.is_script) fmt::print("{}", lint_summary(file, style));
      }
    }
    fmt::print("{}", lint_text(files, style));
  }
}

bool has_faults(const std::vector<LintedFile>& files) {
  return std::any_of(files.begin(), files.end(), [](const LintedFile& file) {
    return count(file, Severity::error) + count(file, Severity::warning) > 0;
  });
}

int lint(const LintCommand& command) {
  if (const std::string misuse = find_misuse(command); !misuse.empty())
    return usage_error("lint", misuse);
  if (command.list_rules) {
    fmt::print("{}", rule_list(style_for(stdout)));
    return exit_ok;
  }
  if (!command.explain.empty()) return explain_rule(command.explain);

  Linter::Options options;
  options.lint.max_nodes = command.max_nodes;
  options.stdin_filename = command.stdin_filename;
  options.is_to_fix = command.fix || command.diff;
  options.is_to_show_fixes = command.diff;
  options.is_to_summarize = command.summary;
  options.has_scripts = !command.scripts.empty();
  std::vector<std::string> errors;
  options.settings = settings_of_options(command.severities, errors);
  if (!errors.empty()) return usage_error("lint", fmt::format("{}", fmt::join(errors, "\ncbc: ")));

  Linter linter(std::move(options));
  const bool has_all = lint_all(command, linter);
  if (!linter.files().empty()) print_report(command, linter, has_all && !linter.has_failed());
  if (command.fix && !command.diff && !linter.has_mended() && has_faults(linter.files())) {
    complain("nothing of this can be mended in place");
  }
  if (linter.has_internal_error()) return exit_internal;
  if (!has_all || linter.has_failed()) return exit_unusable;
  return linter.has_found() ? exit_no : exit_ok;
}

}  // namespace

void add_lint_command(CLI::App& program, int& status) {
  const auto options = std::make_shared<LintCommand>();
  CLI::App* const command = program.add_subcommand(
      "lint", "Finds every mistake in catalogs, with its place and its reason.");
  set_help(*command, {{"[OPTION...] [CATALOG...]", "--fix|--diff [OPTION...] CATALOG...",
                       "--explain RULE", "--list-rules"},
                      lint_examples,
                      lint_footer});
  command
      ->add_option("CATALOG", options->paths,
                   "Catalogs: files, folders (all *.yaml and *.yml in them that look like "
                   "catalogs), or - for standard input; event scripts, too, if they name their "
                   "catalogs")
      ->option_text("...")
      ->check(stands_for(ValueKind::catalog));
  command
      ->add_option("--script", options->scripts,
                   "Check an event script, too, against the one catalog that is given (may be "
                   "repeated)")
      ->option_text("FILE")
      ->check(stands_for(ValueKind::script))
      ->allow_extra_args(false);
  command
      ->add_option("--format", options->format, "text (the default), json, sarif, github, or gcc")
      ->option_text("FORMAT")
      ->check(one_of({"text", "json", "sarif", "github", "gcc"}));
  command->add_flag("--summary", options->summary,
                    "Show the catalogs in numbers: tasks, behaviors, constraints, groups, search "
                    "space; compiled ones, too");
  command->add_flag("--fix", options->fix,
                    "Mend in place what can be mended without changing what a catalog means");
  command->add_flag("--diff", options->diff, "Show what --fix would change, as a diff");
  const auto add_rules = [command](const char* name, std::vector<std::string>& rules,
                                   const char* text) {
    command->add_option(name, rules, text)
        ->option_text("RULE,...")
        ->check(stands_for(ValueKind::rule))
        ->delimiter(',')
        ->allow_extra_args(false);
  };
  add_rules("--error", options->severities.error, "Report findings of a rule as errors");
  add_rules("--warn", options->severities.warn, "Report findings of a rule as warnings");
  add_rules("--allow", options->severities.allow, "Do not report findings of a rule");
  command->add_flag("--strict", options->severities.strict, "Let warnings fail, too");
  command
      ->add_option("--stdin-filename", options->stdin_filename,
                   "Name of standard input in messages and for .cbc.yaml")
      ->option_text("NAME")
      ->check(stands_for(ValueKind::file));
  command
      ->add_option("--max-nodes", options->max_nodes,
                   "Decisions that the proof of one finding may take (default: 100000)")
      ->option_text("N")
      ->check(whole_number(1));
  command->add_option("--explain", options->explain, "Explain a rule")
      ->option_text("RULE")
      ->check(stands_for(ValueKind::rule));
  command->add_flag("--list-rules", options->list_rules, "List all rules");
  command->callback([options, &status] { status = lint(*options); });
}

}  // namespace cbc::cli
