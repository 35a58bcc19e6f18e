#include "lint/linter.h"

#include <algorithm>
#include <optional>

#include <fmt/core.h>

#include "core/check/controls.h"
#include "core/command_line/command_line.h"
#include "core/compile/compile.h"
#include "core/diagnostic/diagnostic.h"
#include "core/files/output.h"
#include "core/property/property_reader.h"
#include "core/script/event_lines.h"
#include "core/script/reader.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc::cli {
namespace {

/// The same for './robot.yaml' and 'robot.yaml'.
std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.lexically_normal().parent_path();
}

void complain_of_catalog(const std::string& name) {
  complain("{} is a catalog; expected an event script or a property file", quote(name));
}

/// What to do about a catalog that cannot be used, behind a message that says so.
std::string advice_on(CatalogLoader::Fault fault, const std::string& path) {
  switch (fault) {
    case CatalogLoader::Fault::printed:
      break;
    case CatalogLoader::Fault::in_findings:
      return fmt::format("; 'cbc lint {}' says why", printable(path));
    case CatalogLoader::Fault::known_before:
      return "; correct that first";
  }
  return {};
}

}  // namespace

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
  } else if (is_log(input->content)) {
    complain_of_log(name);
    has_failed_ = true;
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
    files_.push_back({name_of(input.path), {}, {}, summarize(*catalog)});
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
  const std::optional<NamedCatalog> named = given.empty()
                                                ? catalog_named_by(document.file(), document)
                                                : NamedCatalog{given, printable(document.file())};
  if (!named) {
    complain(
        "{} is {} that names no catalog; give one: "
        "cbc lint --script {} CATALOG",
        quote(document.file()), is_of_properties ? "a property file" : "an event script",
        printable(document.file()));
    has_failed_ = true;
    return nullptr;
  }
  std::shared_ptr<const CompiledCatalog> compiled =
      catalogs_.load(named->path, given.empty() ? NamedBy::file : NamedBy::command_line);
  if (compiled == nullptr) {
    const CatalogLoader::Fault fault = catalogs_.fault_of(named->path);
    complain("{}: this {} is not checked, as the catalog {} cannot be used{}", named->place,
             is_of_properties ? "property file" : "script", quote(display_name(named->path)),
             advice_on(fault, named->path));
    // If it was linted, its errors are findings.
    if (fault != CatalogLoader::Fault::known_before) has_failed_ = true;
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

}  // namespace cbc::cli
