#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "base/text.h"
#include "catalog/catalog.h"
#include "cli/command_line.h"
#include "cli/input.h"
#include "cli/output.h"
#include "compile/compile.h"
#include "compiled/compiled_catalog.h"
#include "diagnostic/diagnostic.h"
#include "diagnostic/rules.h"
#include "lint/controls.h"
#include "lint/lint.h"
#include "report/lint_report.h"
#include "script/reader.h"
#include "support/wording.h"
#include "verify/property_reader.h"
#include "yaml/document.h"

namespace cbc::cli {
namespace {

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
  bool diff = false;  ///< what --fix would change, instead of changing it
};

/// Lints the files of a command line, with the settings that apply to each. Messages about
/// unreadable files go to standard error.
class Linter {
 public:
  /// `settings` are those of the command line, which override those of files.
  Linter(const LintCommand& command, SeveritySettings settings)
      : command_(command),
        unlinted_(InputFiles::Findings::dropped, settings),
        settings_(std::move(settings)) {}

  /// A catalog; or an event script or a property file that names its catalog; or a settings file.
  void lint_catalog(const std::string& path);
  /// Lints a file that was found in a folder if it is a catalog, or keeps it for lint_found if it
  /// is a script or a property file.
  void lint_in_folder(const std::string& path, const std::string& folder);
  /// Lints the scripts and the property files that were found in folders, with the catalogs that
  /// they name, or else with the only one beside them. Comes after all catalogs.
  void lint_found();
  /// An event script or a property file. `catalog`: path of its catalog; if empty, the one that the
  /// file names.
  void lint_script(const std::string& path, const std::string& catalog);
  /// Checks the settings by what the catalogs are that they apply to. Comes last.
  void check_settings();

  [[nodiscard]] const std::vector<LintedFile>& files() const { return files_; }
  /// Whether a file was linted that was found in a folder of the command line.
  [[nodiscard]] bool has_checked(const std::string& folder) const {
    return checked_folders_.contains(folder);
  }
  /// Whether a file could not be read, or not be written.
  [[nodiscard]] bool has_failed() const { return has_failed_; }
  /// Whether there was an internal error.
  [[nodiscard]] bool has_internal_error() const { return has_internal_error_; }
  /// Whether there is an error, or a warning in a file with strict settings.
  [[nodiscard]] bool has_found() const { return has_found_; }
  [[nodiscard]] const std::string& diff() const { return diff_; }
  /// Whether a file was fixed in place.
  [[nodiscard]] bool has_mended() const { return has_mended_; }

 private:
  struct Linted {
    LintedFile file;
    Catalog catalog;
    std::size_t errors = 0;  ///< whatever the settings say
    bool is_script = false;  ///< or a property file
    std::shared_ptr<const CompiledCatalog>
        compiled;  ///< null if scripts cannot be checked against it
  };

  [[nodiscard]] Linted lint_text(const std::string& name, std::string text,
                                 const SeveritySettings& settings) const;
  void fix(const std::string& path, Linted& linted, const SeveritySettings& settings);
  /// A script or a property file of a folder.
  struct Found {
    std::string path;
    std::string folder;  ///< of the command line
    std::string text;
    bool needs_catalog = false;  ///< it names none
  };
  [[nodiscard]] std::string catalog_beside(const Found& found) const;
  [[nodiscard]] static bool write_fixed(const std::string& path, const std::string& before,
                                        const std::string& after);
  [[nodiscard]] std::shared_ptr<const CompiledCatalog> catalog_of(const yaml::Document& document,
                                                                  const std::string& given);
  void lint_script_text(const std::string& path, std::string text, const std::string& catalog);
  void lint_catalog_text(const std::string& path, std::string text);
  void lint_settings(const std::string& name, std::string text);
  void take_compiled(const CatalogInput& input);
  void note_tasks(const Catalog& catalog, bool is_known, const SeveritySettings& settings);
  void add(LintedFile file, const SeveritySettings& settings);
  [[nodiscard]] std::string name_of(const std::string& path) const;
  [[nodiscard]] bool is_to_fix() const { return command_.fix || command_.diff; }

  const LintCommand& command_;
  std::vector<LintedFile> files_;
  InputFiles unlinted_;
  CatalogLoader catalogs_{unlinted_};  ///< those that were linted, and others that scripts use
  SettingsFinder settings_;
  /// By settings file, what the names of tasks in it are checked against.
  struct NamedTasks {
    SeveritySettings settings;
    std::set<std::string> tasks;
    bool has_all = true;  ///< all catalogs could be read
  };
  std::map<std::string, NamedTasks> named_tasks_;
  std::vector<Found> found_;
  std::set<std::string> checked_folders_;
  /// The catalogs that were linted, by folder.
  std::map<std::filesystem::path, std::vector<std::string>> catalogs_in_;
  std::string diff_;
  bool has_failed_ = false;
  bool has_internal_error_ = false;
  bool has_found_ = false;
  bool has_mended_ = false;
};

/// The same for './robot.yaml' and 'robot.yaml'.
std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.lexically_normal().parent_path();
}

void complain_of_catalog(const std::string& name) {
  complain("{} is a catalog; expected an event script or a property file", quote(name));
}

void Linter::lint_catalog(const std::string& path) {
  std::optional<CatalogInput> input = read_catalog_input(path);
  if (!input) {
    has_failed_ = true;
    catalogs_.keep(path, nullptr);
  } else if (input->is_compiled) {
    take_compiled(*input);
  } else if (const std::string name = name_of(path);
             std::filesystem::path(name).filename() == settings_file_name) {
    lint_settings(name, std::move(input->content));
  } else {
    lint_catalog_text(path, std::move(input->content));
  }
}

void Linter::lint_in_folder(const std::string& path, const std::string& folder) {
  std::optional<CatalogInput> input = read_catalog_input(path);
  has_failed_ |= !input;
  if (!input || input->is_compiled) return;
  const FoundFile kind = recognize(input->content);
  if (kind == FoundFile::catalog) {
    lint_catalog_text(path, std::move(input->content));
    checked_folders_.insert(folder);
  } else if (kind != FoundFile::other) {
    found_.push_back(
        {path, folder, std::move(input->content), kind == FoundFile::script_without_catalog});
  }
}

void Linter::lint_found() {
  std::vector<std::string> unchecked;
  for (Found& found : found_) {
    const std::string catalog = found.needs_catalog ? catalog_beside(found) : std::string();
    if (found.needs_catalog && catalog.empty()) {
      unchecked.push_back(quote(found.path));
      continue;
    }
    lint_script_text(found.path, std::move(found.text), catalog);
    checked_folders_.insert(found.folder);
  }
  if (unchecked.empty()) return;
  complain("not checked, as {} no catalog, and there is not exactly one beside {}: {}",
           unchecked.size() == 1 ? "it names" : "they name", unchecked.size() == 1 ? "it" : "them",
           join(unchecked, ", "));
}

/// The only catalog in the nearest folder that has catalogs: the file's own one, or one above it
/// that was linted, too. Empty if there is none, or several.
std::string Linter::catalog_beside(const Found& found) const {
  const std::filesystem::path top = folder_of(std::filesystem::path(found.folder) / "any");
  std::filesystem::path folder = folder_of(found.path);
  for (;;) {
    if (const auto known = catalogs_in_.find(folder); known != catalogs_in_.end()) {
      return known->second.size() == 1 ? known->second.front() : std::string();
    }
    if (folder == top || !folder.has_relative_path()) return {};
    folder = folder.parent_path();
  }
}

/// A compiled catalog has no text to lint.
void Linter::take_compiled(const CatalogInput& input) {
  std::optional<CompiledFile> file;
  if (is_to_fix() || (!command_.summary && command_.scripts.empty())) {
    complain("{} is a compiled catalog; expected YAML (--summary takes either)",
             quote(name_of(input.path)));
  } else {
    file = load(input);
  }
  if (!file) {
    catalogs_.keep(input.path, nullptr);
    has_failed_ = true;
    return;
  }
  const auto catalog = std::make_shared<const CompiledCatalog>(std::move(file->catalog));
  catalogs_.keep(input.path, catalog);
  if (command_.summary) {
    files_.push_back({name_of(input.path),
                      {},
                      {},
                      summarize(*catalog),
                      summarize_together(*catalog, command_.max_nodes)});
  }
}

void Linter::lint_catalog_text(const std::string& path, std::string text) {
  const std::optional<SeveritySettings> settings =
      settings_.find(path == "-" ? name_of(path) : path);
  if (!settings) {
    has_failed_ = true;
    return;
  }
  Linted linted = lint_text(name_of(path), std::move(text), *settings);
  if (linted.is_script) {
    lint_script_text(path, std::move(linted.file.text), "");
    return;
  }
  catalogs_in_[folder_of(path)].push_back(path);
  if (is_to_fix()) fix(path, linted, *settings);
  note_tasks(linted.catalog, !linted.catalog.tasks.empty(), *settings);
  catalogs_.keep(path, linted.compiled);
  add(std::move(linted.file), *settings);
}

Linter::Linted Linter::lint_text(const std::string& name, std::string text,
                                 const SeveritySettings& settings) const {
  Linted linted;
  linted.file.file = name;
  linted.file.text = std::move(text);
  Diagnostics diagnostics;
  const auto document = yaml::parse(linted.file.text, name, diagnostics);
  if (document == nullptr) {
    linted.file.kind = LintedFile::Kind::unknown;
    linted.errors = diagnostics.count(Severity::error);
    linted.file.findings =
        control_findings(diagnostics.release(), {name, linted.file.text, nullptr, false}, settings);
    return linted;
  }
  linted.is_script = is_script(*document) || is_property_file(*document);
  if (linted.is_script) return linted;
  CheckedCatalog checked = check_catalog(*document, linted.file.text, settings,
                                         LintOptions{command_.max_nodes}, std::move(diagnostics));
  if (checked.compiled) {
    linted.file.summary = summarize(*checked.compiled);
    if (command_.summary) {
      linted.file.together = summarize_together(*checked.compiled, command_.max_nodes);
    }
    linted.compiled = std::make_shared<const CompiledCatalog>(std::move(*checked.compiled));
  }
  linted.catalog = std::move(checked.reading.catalog);
  linted.errors = checked.errors;
  linted.file.findings = std::move(checked.findings);
  return linted;
}

/// Applies all fixes. If the result cannot be written, nothing changes.
void Linter::fix(const std::string& path, Linted& linted, const SeveritySettings& settings) {
  Linted fixed;
  fixed.file = linted.file;
  fixed.catalog = linted.catalog;
  std::size_t mended = 0;
  // A fix may uncover more findings. Each round removes redundancy from the text, so the loop ends.
  for (;;) {
    FixedText text = apply_fixes(fixed.file.text, fixed.file.findings);
    if (text.mended.empty()) break;
    mended += text.mended.size();
    fixed = lint_text(linted.file.file, std::move(text.text), settings);
  }
  if (mended == 0) return;
  if (!same_meaning(linted.catalog, fixed.catalog) || fixed.errors > linted.errors) {
    complain(
        "internal error: fixing {} would change its meaning, so nothing is "
        "written; please report it with the file",
        quote(linted.file.file));
    has_internal_error_ = true;
    return;
  }
  if (command_.diff) {
    diff_ += unified_diff(linted.file.text, fixed.file.text, linted.file.file);
  } else if (!write_fixed(path, linted.file.text, fixed.file.text)) {
    has_failed_ = true;
    return;
  } else {
    has_mended_ = true;
    complain("{}: {} {} fixed", printable(linted.file.file), mended,
             mended == 1 ? "finding" : "findings");
  }
  linted = std::move(fixed);
}

bool Linter::write_fixed(const std::string& path, const std::string& before,
                         const std::string& after) {
  const std::optional<std::string> now = read_input(path);
  if (!now) return false;
  if (*now != before) {
    complain("{} has changed in the meantime; it is not overwritten", quote(path));
    return false;
  }
  return replace_input(path, after) == exit_ok;
}

void Linter::lint_script(const std::string& path, const std::string& catalog) {
  std::optional<CatalogInput> input = read_catalog_input(path);
  if (!input) {
    has_failed_ = true;
  } else if (input->is_compiled) {
    complain_of_catalog(name_of(path));
    has_failed_ = true;
  } else {
    lint_script_text(path, std::move(input->content), catalog);
  }
}

void Linter::lint_script_text(const std::string& path, std::string text,
                              const std::string& catalog) {
  LintedFile file;
  file.file = name_of(path);
  file.text = std::move(text);
  const std::optional<SeveritySettings> settings = settings_.find(path == "-" ? file.file : path);
  Diagnostics diagnostics;
  const auto document = yaml::parse(file.text, file.file, diagnostics);
  file.kind = document != nullptr && is_property_file(*document) ? LintedFile::Kind::properties
                                                                 : LintedFile::Kind::script;
  CommentedFile commented{file.file, file.text, document.get(), false};
  if (document != nullptr && is_catalog(*document)) {
    complain_of_catalog(file.file);
    has_failed_ = true;
    return;
  }
  if (document != nullptr) {
    const auto compiled = catalog_of(*document, catalog);
    if (compiled == nullptr) return;
    const bool is_usable =
        is_property_file(*document)
            ? read_properties(*document, *compiled, diagnostics).has_value()
            : read_script(*document, *compiled, Severity::error, diagnostics).has_value();
    // Findings that may be allowed do not make a file incomplete.
    commented.is_complete =
        is_usable || std::none_of(diagnostics.all().begin(), diagnostics.all().end(), is_fixed);
  }
  if (!settings) {
    has_failed_ = true;
    return;
  }
  file.findings = control_findings(diagnostics.release(), commented, *settings);
  add(std::move(file), *settings);
}

/// The catalog of a script or a property file. Null, after a message, if none can be used.
std::shared_ptr<const CompiledCatalog> Linter::catalog_of(const yaml::Document& document,
                                                          const std::string& given) {
  const bool is_of_properties = is_property_file(document);
  const std::string catalog =
      given.empty() ? path_of_catalog(document.file(), document).value_or("") : given;
  if (catalog.empty()) {
    complain(
        "{} is {} that names no catalog; give one: "
        "cbc lint --script {} CATALOG",
        quote(document.file()), is_of_properties ? "a property file" : "an event script",
        printable(document.file()));
    has_failed_ = true;
    return nullptr;
  }
  const bool is_linted = catalogs_.knows(catalog);
  std::shared_ptr<const CompiledCatalog> compiled =
      catalogs_.load(catalog, given.empty() ? NamedBy::file : NamedBy::command_line);
  if (compiled == nullptr) {
    complain("{} {} is not checked, as its catalog {} cannot be used; {}",
             is_of_properties ? "property file" : "script", quote(document.file()), quote(catalog),
             is_linted ? "correct that first"
                       : fmt::format("'cbc lint {}' says why", printable(catalog)));
    // If it was linted, its errors are findings.
    if (!is_linted) has_failed_ = true;
  }
  return compiled;
}

void Linter::add(LintedFile file, const SeveritySettings& settings) {
  has_found_ |= std::any_of(
      file.findings.begin(), file.findings.end(),
      [&settings](const Diagnostic& finding) { return settings.is_failure(finding.severity); });
  files_.push_back(std::move(file));
}

void Linter::note_tasks(const Catalog& catalog, bool is_known, const SeveritySettings& settings) {
  if (settings.never_together().empty()) return;
  NamedTasks& named = named_tasks_[settings.never_together().front().file];
  named.settings = settings;
  named.has_all = named.has_all && is_known;
  for (const Task& task : catalog.tasks) named.tasks.insert(task.name);
}

/// Names of tasks in it are checked where catalogs are linted that it applies to.
void Linter::lint_settings(const std::string& name, std::string text) {
  LintedFile file;
  file.kind = LintedFile::Kind::settings;
  file.file = name;
  file.text = std::move(text);
  Diagnostics diagnostics;
  const auto settings = read_settings(file.text, file.file, diagnostics);
  diagnostics.sort();
  file.findings = diagnostics.release();
  add(std::move(file), settings.value_or(SeveritySettings()));
}

void Linter::check_settings() {
  for (const auto& [file, named] : named_tasks_) {
    if (!named.has_all) continue;
    Diagnostics diagnostics;
    check_never_together_names(named.settings.never_together(),
                               {named.tasks.begin(), named.tasks.end()}, diagnostics);
    if (diagnostics.all().empty()) continue;
    LintedFile settings;
    settings.kind = LintedFile::Kind::settings;
    settings.file = file;
    std::erase_if(files_,
                  [&settings](const LintedFile& linted) { return linted.file == settings.file; });
    settings.text = read_input(file).value_or("");
    diagnostics.sort();
    settings.findings = diagnostics.release();
    add(std::move(settings), named.settings);
  }
}

std::string Linter::name_of(const std::string& path) const {
  return path == "-" && !command_.stdin_filename.empty() ? command_.stdin_filename
                                                         : display_name(path);
}

constexpr const char* lint_examples =
    "  cbc lint robot.yaml                       every mistake, with place and reason\n"
    "  cbc lint --diff robot.yaml                what --fix would change\n"
    "  cbc lint --explain dead-behavior          what a rule means and how to fix it\n";

constexpr const char* lint_footer =
    "More examples:\n"
    "  cbc lint --strict .                       a folder; also fail on warnings\n"
    "  cbc lint --format sarif catalogs/ > lint.sarif\n"
    "                                            for code scanning\n"
    "  cbc lint --script mission.yaml robot.yaml  also check an event script\n"
    "\n"
    "A comment '# cbc: allow RULE' at the end of a line, or above an entry, allows a finding "
    "there. A file .cbc.yaml in the folder of a catalog, or above it, has settings for all of "
    "them:\n"
    "  error: [RULE, ...]   warn: [RULE, ...]\n"
    "  note: [RULE, ...]    allow: [RULE, ...]\n"
    "  strict: true\n"
    "  never_together: [[TASK, TASK, ...], ...]   no two of them can run together\n"
    "\n"
    "Exit status: 0 no errors, 1 errors (with --strict, also warnings), 2 a file could not be "
    "read or written, or the usage is wrong, 3 an internal error.\n"
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

/// A file to lint.
struct Target {
  std::string path;
  bool is_named = false;  ///< on the command line, so it is linted whatever it is
  std::string folder;     ///< on the command line that contains the file, or empty
};

/// The files of all paths, each once. Prints which folders cannot be read.
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

/// Lints everything. Returns whether each path had something to lint.
bool lint_all(const LintCommand& command, Linter& linter) {
  bool has_failed = false;
  const std::vector<Target> targets = find_targets(command.paths, has_failed);
  std::set<std::string> folders_of_named;
  Progress progress("linting", targets.size() + command.scripts.size());
  for (const Target& target : targets) {
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
  const LintRun run{std::filesystem::current_path().string(), is_complete, style_for(stdout)};
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
  if (!linter.files().empty()) print_report(command, linter, has_all && !linter.has_failed());
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
      program.add_command("lint", "Finds every mistake in catalogs, with its place and its reason.",
                          {{"[OPTION...] [CATALOG...]", "--fix|--diff [OPTION...] CATALOG...",
                            "--explain RULE", "--list-rules"},
                           lint_examples,
                           lint_footer});
  command.argument(
      "CATALOG", options->paths, input("...", ValueKind::catalog),
      "Catalogs: files, folders (all *.yaml and *.yml in them that look like catalogs, "
      "and their event scripts and property files), or - for standard input; also "
      "event scripts and property files that name their catalogs");
  command.option("--script", options->scripts, input("FILE", ValueKind::script),
                 "Also check this event script or property file against the catalog. May be "
                 "repeated");
  command.option("--format", options->format, one_of("FORMAT", formats),
                 fmt::format("{} (default: {})", join_with_or(formats), formats.front()));
  command
      .flag("--summary", options->summary,
            "Show figures for each catalog: tasks, behaviors, constraints, groups, search space, "
            "tasks that can run together; also for compiled catalogs")
      .only_with_values("--format", {"text", "json"});
  command.flag("--fix", options->fix,
               "Fix in place what can be fixed without changing the meaning");
  command.flag("--diff", options->diff, "Show what --fix would change, as a diff")
      .not_with({"--summary"})
      .only_with_values("--format", {"text"});
  Values rule;
  rule.placeholder = "RULE";
  rule.expected = "a rule";
  rule.names = [] {
    std::vector<NameWithHelp> names;
    for (const Rule& known : all_rules()) {
      names.push_back({std::string(known.name), std::string(known.summary)});
    }
    return names;
  };
  Values rules = rule;
  rules.placeholder = "RULE,...";
  command.option("--error", options->severities.error, rules, "Report findings of a rule as errors")
      .separated_by(',');
  command.option("--warn", options->severities.warn, rules, "Report findings of a rule as warnings")
      .separated_by(',');
  command
      .option("--note", options->severities.note, rules,
              "Report findings of a rule as notes; also turns on rules that are off")
      .separated_by(',');
  command.option("--allow", options->severities.allow, rules, "Do not report findings of a rule")
      .separated_by(',');
  command.flag("--strict", options->severities.strict, "Also fail on warnings");
  command.option("--stdin-filename", options->stdin_filename, name_of("NAME", ValueKind::file),
                 "Name of standard input in messages and for .cbc.yaml");
  command.option("--max-nodes", options->max_nodes, whole_number("N", 1),
                 "Decisions that the proof of one finding may take (default: 100000)");
  const std::string only_explains = "it describes rules and checks no files";
  command.option("--explain", options->explain, rule, "Explain a rule")
      .not_with({"CATALOG", "--script"}, only_explains)
      .only_with_values("--format", {"text"});
  command.flag("--list-rules", options->list_rules, "List all rules")
      .not_with({"CATALOG", "--script"}, only_explains)
      .only_with_values("--format", {"text"});
  command.add_confinement();
  command.action([options] { return lint(*options); });
}

}  // namespace cbc::cli
