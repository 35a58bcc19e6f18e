#include "lint/linter.h"

#include <algorithm>
#include <optional>

#include <fmt/core.h>

#include "core/catalog/older_format.h"
#include "core/check/severity_settings.h"
#include "core/command_line/command_line.h"
#include "core/diagnostic/diagnostic.h"
#include "core/files/check_file.h"
#include "core/files/output.h"
#include "core/files/replace.h"
#include "core/files/unified_diff.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc::cli {
namespace {

/// What to do about a catalog that cannot be used, behind a message that says so.
std::string advice_on(FileSet::Fault fault, const std::string& path) {
  switch (fault) {
    case FileSet::Fault::printed:
      break;
    case FileSet::Fault::in_findings:
      return fmt::format("; 'cbc lint {}' says why", printable(path));
    case FileSet::Fault::known_before:
      return "; correct that first";
  }
  return {};
}

}  // namespace

void Linter::lint_catalog(const std::string& path) {
  File file = files_.open(path);
  if (file == nullptr) {
    has_failed_ = true;
    files_.keep(path, nullptr);
  } else if (file->is(FileKind::compiled)) {
    take_compiled(*file);
  } else if (file->is(FileKind::settings)) {
    lint_settings(*file);
  } else if (file->is(FileKind::log)) {
    complain_of_log(*file);
    has_failed_ = true;
  } else {
    lint_catalog(std::move(file));
  }
}

void Linter::lint_in_folder(const std::string& path, const std::string& folder) {
  File file = files_.open(path);
  has_failed_ |= file == nullptr;
  if (file == nullptr) return;
  if (!file->what.is_sure) {
    if (file->document == nullptr) not_understood_.push_back(file->name);
    return;
  }
  const FileKind kind = file->what.kind;
  if (kind == FileKind::catalog) {
    lint_catalog(std::move(file));
    checked_folders_.insert(folder);
  } else if (kind == FileKind::script || kind == FileKind::properties) {
    found_.push_back({std::move(file), folder});
  }
}

void Linter::lint_found() {
  std::vector<std::string> unchecked;
  for (const Found& found : found_) {
    const InputFile& file = *found.file;
    // A script that is not valid YAML needs none.
    const bool needs_catalog = file.document != nullptr && !catalog_named_by(file);
    const std::string catalog =
        needs_catalog ? catalogs_.beside(file.path, found.folder) : std::string();
    if (needs_catalog && catalog.empty()) {
      unchecked.push_back(quote(file.path));
      continue;
    }
    lint_script(file, catalog);
    checked_folders_.insert(found.folder);
  }
  if (unchecked.empty()) return;
  complain("not checked, as {} no catalog, and there is not exactly one beside {}: {}",
           unchecked.size() == 1 ? "it names" : "they name", unchecked.size() == 1 ? "it" : "them",
           join(unchecked, ", "));
}

/// A compiled catalog has no text to lint.
void Linter::take_compiled(const InputFile& file) {
  std::shared_ptr<const CheckedCatalog> catalog;
  if (is_to_fix() || (!command_.summary && command_.scripts.empty())) {
    complain("{} is a compiled catalog; expected YAML (--summary takes either)", quote(file.name));
  } else {
    catalog = files_.load(file);
  }
  files_.keep(file.path, catalog);
  if (catalog == nullptr) {
    has_failed_ = true;
  } else if (command_.summary) {
    linted_.push_back({file.name, {}, {}, summarize(*catalog->compiled)});
  }
}

void Linter::lint_catalog(File file) {
  const std::optional<SeveritySettings> settings = files_.settings_of(*file);
  if (!settings) {
    has_failed_ = true;
    return;
  }
  if (file->is(FileKind::script) || file->is(FileKind::properties)) return lint_script(*file, "");
  catalogs_.add(file->path);
  auto catalog = std::make_shared<CheckedCatalog>(check(*file, *settings));
  if (is_to_fix()) fix(file, *catalog, *settings);
  note_tasks(catalog->reading.catalog, *settings);
  files_.keep(file->path, catalog->compiled == nullptr ? nullptr : catalog);
  LintedFile linted;
  linted.kind = file->document == nullptr ? LintedFile::Kind::unknown : LintedFile::Kind::catalog;
  linted.file = file->name;
  linted.text = *file->text;
  linted.findings = std::move(catalog->findings);
  if (catalog->compiled != nullptr) linted.summary = summarize(*catalog->compiled);
  add(std::move(linted), *settings);
}

CheckedCatalog Linter::check(const InputFile& file, const SeveritySettings& settings) const {
  return check_catalog_file(file, settings, LintOptions{command_.max_nodes});
}

/// Replaces a catalog of an older format by what it is in the present one. Returns whether it has
/// been replaced.
bool Linter::convert(File& file, CheckedCatalog& catalog, const SeveritySettings& settings) {
  if (file->document == nullptr || !find_older_format(file->document->root())) return false;
  Conversion conversion = convert_older_format(*file->document, *file->text);
  if (conversion.obstacle) return false;
  for (const Leftover& leftover : conversion.leftovers) {
    complain("{}: {}", format_place(printable(file->name), leftover.range.begin),
             printable(leftover.message));
  }
  file = files_.parse(file->path, std::move(conversion.text));
  catalog = check(*file, settings);
  return true;
}

/// Applies all fixes. If the result cannot be written, nothing changes.
void Linter::fix(File& file, CheckedCatalog& catalog, const SeveritySettings& settings) {
  File fixed_file = file;
  CheckedCatalog fixed = catalog;
  const bool is_converted = convert(fixed_file, fixed, settings);
  const CheckedCatalog before = fixed;
  std::size_t mended = is_converted ? 1 : 0;
  // A fix may uncover more findings. Each round removes redundancy from the text, so the loop ends.
  for (;;) {
    FixedText text = apply_fixes(*fixed_file->text, fixed.findings);
    if (text.mended.empty()) break;
    mended += text.mended.size();
    fixed_file = files_.parse(file->path, std::move(text.text));
    fixed = check(*fixed_file, settings);
  }
  if (mended == 0) return;
  if (!same_meaning(before.reading.catalog, fixed.reading.catalog) ||
      fixed.errors > before.errors) {
    complain(
        "internal error: fixing {} would change its meaning, so nothing is "
        "written; please report it with the file",
        quote(file->name));
    has_internal_error_ = true;
    return;
  }
  const Replacement replacement{file->path, file->text, *fixed_file->text};
  if (command_.diff) {
    const auto diff = unified_diff(*file->text, *fixed_file->text, file->name);
    has_failed_ |= !diff;
    diff_ += diff.value_or("");
  } else if (replace_inputs({&replacement, 1}) != exit_ok) {
    has_failed_ = true;
    return;
  } else {
    has_mended_ = true;
    complain("{}: {} {} fixed", printable(file->name), mended,
             mended == 1 ? "finding" : "findings");
  }
  file = std::move(fixed_file);
  catalog = std::move(fixed);
}

void Linter::lint_script(const std::string& path, const std::string& catalog) {
  const File file = files_.open(path);
  if (file == nullptr) {
    has_failed_ = true;
  } else {
    lint_script(*file, catalog);
  }
}

void Linter::lint_script(const InputFile& file, const std::string& catalog) {
  const std::optional<SeveritySettings> settings = files_.settings_of(file);
  if (file.is(FileKind::compiled) || file.is(FileKind::catalog)) {
    complain("{} is a catalog; expected an event script or a property file", quote(file.name));
    has_failed_ = true;
    return;
  }
  std::shared_ptr<const CheckedCatalog> checked;
  if (file.document != nullptr) {
    checked = catalog_of(file, catalog);
    if (checked == nullptr) return;
  }
  if (!settings) {
    has_failed_ = true;
    return;
  }
  LintedFile linted;
  linted.kind = file.document == nullptr        ? LintedFile::Kind::unknown
                : file.is(FileKind::properties) ? LintedFile::Kind::properties
                                                : LintedFile::Kind::script;
  linted.file = file.name;
  linted.text = *file.text;
  linted.findings = checked == nullptr ? check_catalog_file(file, *settings, {}).findings
                                       : check_about_catalog(file, *checked->compiled, *settings);
  add(std::move(linted), *settings);
}

/// The catalog of a script or a property file. Null, after a message, if none can be used.
std::shared_ptr<const CheckedCatalog> Linter::catalog_of(const InputFile& file,
                                                         const std::string& given) {
  const bool is_of_properties = file.is(FileKind::properties);
  const std::optional<NamedCatalog> named =
      given.empty() ? catalog_named_by(file) : NamedCatalog{given, printable(file.name)};
  if (!named) {
    complain(
        "{} is {} that names no catalog; give one: "
        "cbc lint --script {} CATALOG",
        quote(file.name), is_of_properties ? "a property file" : "an event script",
        printable(file.name));
    has_failed_ = true;
    return nullptr;
  }
  auto catalog = files_.load(named->path, given.empty() ? NamedBy::file : NamedBy::command_line);
  if (catalog == nullptr) {
    const FileSet::Fault fault = files_.fault_of(named->path);
    complain("{}: this {} is not checked, as the catalog {} cannot be used{}", named->place,
             is_of_properties ? "property file" : "script", quote(display_name(named->path)),
             advice_on(fault, named->path));
    // If it was linted, its errors are findings.
    if (fault != FileSet::Fault::known_before) has_failed_ = true;
  }
  return catalog;
}

void Linter::add(LintedFile file, const SeveritySettings& settings) {
  has_found_ |= std::any_of(
      file.findings.begin(), file.findings.end(),
      [&settings](const Diagnostic& finding) { return settings.is_failure(finding.severity); });
  linted_.push_back(std::move(file));
}

void Linter::note_tasks(const Catalog& catalog, const SeveritySettings& settings) {
  if (settings.never_together().empty()) return;
  NamedTasks& named = named_tasks_[settings.never_together().front().file];
  named.settings = settings;
  named.has_all = named.has_all && !catalog.tasks.empty();
  for (const Task& task : catalog.tasks) named.tasks.insert(task.name);
}

/// Names of tasks in it are checked where catalogs are linted that it applies to.
void Linter::lint_settings(const InputFile& input) {
  LintedFile file;
  file.kind = LintedFile::Kind::settings;
  file.file = input.name;
  file.text = *input.text;
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
    std::erase_if(linted_,
                  [&settings](const LintedFile& linted) { return linted.file == settings.file; });
    settings.text = read_input(file).value_or("");
    diagnostics.sort();
    settings.findings = diagnostics.release();
    add(std::move(settings), named.settings);
  }
}

}  // namespace cbc::cli
