#include "core/files/file_set.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "core/catalog/foreign_file.h"
#include "core/check/allow_comments.h"
#include "core/compile/compile.h"
#include "core/diagnostic/rules.h"
#include "core/files/output.h"
#include "core/files/read.h"
#include "core/property/property_reader.h"
#include "core/script/log_script.h"
#include "core/script/reader.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_file.h"

namespace cbc::cli {

namespace {

bool is_for_cbc(const Recognition& what) {
  return (what.kind == FileKind::catalog && what.is_sure) || what.is(FileKind::script) ||
         what.is(FileKind::properties);
}

/// Says what the file of another program seems to be, in place of why it is not valid YAML.
void describe_foreign(InputFile& file) {
  const std::string_view found = find_foreign_file(*file.text);
  if (found.empty()) return;
  std::vector<Diagnostic> faults = file.diagnostics.release();
  for (Diagnostic& fault : faults) {
    fault.range = {};
    fault.message = describe_foreign_file("behavior catalog", found);
    fault.notes.clear();
    file.diagnostics.add(std::move(fault));
  }
}

}  // namespace

std::optional<NamedCatalog> catalog_named_by(const InputFile& file) {
  const yaml::Node* const named = catalog_of_script(*file.document);
  if (named == nullptr) return std::nullopt;
  const std::filesystem::path folder = std::filesystem::path(file.name).parent_path();
  std::string found = (folder / named->text).lexically_normal().string();
  // In a file this is a name as any other: standard input is only what the command line names.
  if (found == "-") found = "./-";
  return NamedCatalog{std::move(found), format_place(printable(file.name), named->range.begin)};
}

std::optional<CompiledFile> load_compiled(const InputFile& file) {
  CompiledFileResult result =
      file.text->empty() ? cbc::load_compiled(file.path) : read_compiled(*file.text);
  if (!result.file) cannot_read(file.path, result.error);
  return std::move(result.file);
}

void complain_of_log(const InputFile& file) {
  complain("{} is the log of a stream; 'cbc solve CATALOG {}' runs its events", quote(file.name),
           printable(file.name));
}

void print_findings(const std::vector<Diagnostic>& findings, const Texts& texts) {
  constexpr std::size_t most_warnings = 3;
  SourceTexts sources;
  for (const auto& [file, text] : texts) sources.add(file, *text);
  const Style style = style_for(stderr);
  std::map<std::pair<std::string_view, std::string_view>, std::size_t> warnings;
  for (const Diagnostic& finding : findings) {
    if (finding.severity == Severity::note) continue;
    if (finding.severity == Severity::error ||
        (++warnings[{finding.file, finding.rule}] <= most_warnings &&
         finding.rule != rule::deprecated_key.name)) {
      fmt::print(stderr, "{}", render(finding, sources, style));
    }
  }
  for (const auto& [kind, count] : warnings) {
    if (kind.second == rule::deprecated_key.name) {
      fmt::print(stderr, "{}: {}: {} {}; see 'cbc lint', or 'cbc lint --fix' [{}]\n",
                 printable(kind.first), style.paint(style.warning, "warning"),
                 quantity(count, "key"), count == 1 ? "has an older name" : "have older names",
                 kind.second);
      continue;
    }
    if (count <= most_warnings) continue;
    fmt::print(stderr, "{}: {} more like these [{}]\n", printable(kind.first),
               count - most_warnings, kind.second);
  }
}

namespace {

std::string folder_of(const std::string& file) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  return folder.empty() ? "." : folder.string();
}

}  // namespace

SettingsFinder::SettingsFinder(SeveritySettings command_line)
    : command_line_(std::move(command_line)) {}

std::optional<SeveritySettings> SettingsFinder::find(const std::string& path) {
  const std::optional<std::string> file = find_settings_file(path);
  // One above the folder of --confine belongs to others.
  if (!file || find_refusal(folder_of(*file))) return command_line_;
  const auto [entry, is_new] = known_.try_emplace(*file);
  if (!is_new) return entry->second;
  if (const std::optional<std::string> text = read_input(*file)) {
    Diagnostics diagnostics;
    entry->second = read_settings(*text, *file, diagnostics);
    diagnostics.sort();
    if (!entry->second && leads_out_of(folder_of(*file), *file)) {
      complain("{} is a link to a file elsewhere that has no valid settings", quote(*file));
    } else {
      print_findings(diagnostics.all(), {{*file, std::make_shared<const std::string>(*text)}});
    }
  }
  if (entry->second) entry->second->override_with(command_line_);
  return entry->second;
}

std::shared_ptr<const InputFile> FileSet::open(const std::string& path, NamedBy named_by) {
  if (named_by != NamedBy::command_line && is_special(path)) {
    cannot_read(path, "it is no regular file");
    return nullptr;
  }
  if (can_be_mapped(path)) {
    note_read(path);
    return std::make_shared<const InputFile>(InputFile{
        path, path, std::make_shared<const std::string>(), {FileKind::compiled}, nullptr, {}});
  }
  std::optional<std::string> text = read_input(path);
  return text ? parse(path, std::move(*text)) : nullptr;
}

std::shared_ptr<const InputFile> FileSet::parse(const std::string& path, std::string text) {
  auto file = std::make_shared<InputFile>();
  file->path = path;
  file->name = name_of(path);
  file->text = std::make_shared<const std::string>(std::move(text));
  if (!is_compiled(*file->text)) {
    file->document = yaml::parse(*file->text, file->name, file->diagnostics);
  }
  file->what = recognize(file->name, *file->text, file->document.get());
  const bool is_unknown = file->what.kind == FileKind::other || !file->what.is_sure;
  if (file->document == nullptr && is_unknown) describe_foreign(*file);
  return file;
}

std::shared_ptr<const InputFile> FileSet::read(const std::string& path, NamedBy named_by,
                                               Logs logs) {
  std::shared_ptr<const InputFile> file = open(path, named_by);
  if (file == nullptr || file->is(FileKind::compiled)) return file;
  if (named_by == NamedBy::file && !is_for_cbc(file->what)) {
    complain("{} is not a catalog", quote(file->name));
    return nullptr;
  }
  if (named_by == NamedBy::link && file->document == nullptr) {
    complain("{} is a link to a file elsewhere that is not valid YAML", quote(file->name));
    return nullptr;
  }
  if (file->is(FileKind::log)) {
    if (logs == Logs::accepted) return file;
    complain_of_log(*file);
    return nullptr;
  }
  texts_.insert_or_assign(file->name, file->text);
  if (keeps_findings_) {
    const std::vector<Diagnostic>& found = file->diagnostics.all();
    findings_.insert(findings_.end(), found.begin(), found.end());
  }
  if (file->document != nullptr) return file;
  ++faulty_;
  return nullptr;
}

std::shared_ptr<const InputFile> FileSet::read_catalog(const std::string& path, NamedBy named_by) {
  std::shared_ptr<const InputFile> file = read(path, named_by);
  if (file == nullptr) return nullptr;
  const bool is_of_properties = file->is(FileKind::properties);
  if (!is_of_properties && !file->is(FileKind::script)) return file;
  complain("{} is a {}; expected a catalog here", quote(file->name),
           is_of_properties ? "property file" : "script");
  return nullptr;
}

FileSet::Check FileSet::check(const InputFile& file, Purpose purpose) {
  const std::optional<SeveritySettings> settings = settings_of(file);
  if (!settings) return {};
  LintOptions options;
  options.depth = depth_for(purpose, *settings);
  Check checked{check_catalog(*file.document, *file.text, *settings, options, {})};
  checked.catalog.text = file.text;
  checked.is_usable = keep_findings(std::move(checked.catalog.findings), *settings);
  const bool are_settings_good = check_settings(*settings, checked.catalog.reading.catalog);
  if (purpose != Purpose::drawing) checked.is_usable &= are_settings_good;
  return checked;
}

CheckDepth FileSet::depth_for(Purpose purpose, const SeveritySettings& settings) const {
  if (purpose == Purpose::drawing ||
      (purpose == Purpose::use && (!keeps_findings_ || !settings.add_failures()))) {
    return CheckDepth::reading;
  }
  return settings.need_search() ? CheckDepth::searches : CheckDepth::rules;
}

/// Adds the errors about names of tasks in the settings, each once. Returns whether there are none.
/// A name that resembles no other may be that of a task of another catalog; only lint, which may
/// see all of them, warns of it.
bool FileSet::check_settings(const SeveritySettings& settings, const Catalog& catalog) {
  if (settings.never_together().empty() || catalog.tasks.empty()) return true;
  std::vector<std::string_view> tasks;
  for (const Task& task : catalog.tasks) tasks.emplace_back(task.name);
  Diagnostics diagnostics;
  check_never_together_names(settings.never_together(), tasks, diagnostics);
  diagnostics.sort();
  std::vector<Diagnostic> errors = diagnostics.release();
  std::erase_if(errors,
                [](const Diagnostic& finding) { return finding.severity != Severity::error; });
  if (errors.empty()) return true;
  const std::string& file = settings.never_together().front().file;
  if (!texts_.contains(file)) {
    texts_.emplace(file, std::make_shared<const std::string>(read_input(file).value_or("")));
  }
  std::set<Range> known;
  for (const Diagnostic& finding : findings_) {
    if (finding.file == file) known.insert(finding.range);
  }
  std::erase_if(errors,
                [&known](const Diagnostic& finding) { return known.contains(finding.range); });
  (void)keep_findings(std::move(errors), settings);
  return false;
}

/// Takes the findings about a file, except those that its comments and settings allow. Returns
/// whether there are no errors. `is_complete`: there are all findings that lint would have.
bool FileSet::take_findings(const InputFile& file, Diagnostics diagnostics, bool is_complete) {
  const std::optional<SeveritySettings> settings = settings_of(file);
  if (!settings) return false;
  const CommentedFile commented{file.name, *file.text, file.document.get(), is_complete};
  return keep_findings(control_findings(diagnostics.release(), commented, *settings), *settings);
}

/// Returns whether there are no errors. Warnings that are dropped are none, however strict the
/// settings.
bool FileSet::keep_findings(std::vector<Diagnostic> findings, const SeveritySettings& settings) {
  bool has_errors = false;
  for (Diagnostic& finding : findings) {
    const bool is_warning = finding.severity != Severity::error;
    if (!is_warning || (keeps_findings_ && settings.is_failure(finding.severity))) {
      if (is_warning) ++strict_[settings.strict_file()];
      finding.severity = Severity::error;
      has_errors = true;
    }
    if (keeps_findings_) findings_.push_back(std::move(finding));
  }
  if (has_errors) ++faulty_;
  return !has_errors;
}

void FileSet::print_findings() {
  std::stable_sort(findings_.begin(), findings_.end(),
                   [](const Diagnostic& a, const Diagnostic& b) { return a.file < b.file; });
  cli::print_findings(findings_, texts_);
  for (const auto& [file, count] : strict_) {
    complain("{} above would be {} without 'strict: true' in {}", quantity(count, "error"),
             count == 1 ? "a warning" : "warnings", quote(file));
  }
}

std::string FileSet::key_of(const std::string& path) {
  return std::filesystem::path(path).lexically_normal().string();
}

std::shared_ptr<const CheckedCatalog> FileSet::load(const InputFile& file, Purpose purpose) {
  auto catalog = std::make_shared<CheckedCatalog>();
  if (file.is(FileKind::compiled)) {
    std::optional<CompiledFile> compiled = load_compiled(file);
    if (!compiled) return nullptr;
    catalog->compiled = std::make_shared<const CompiledCatalog>(std::move(compiled->catalog));
    return catalog;
  }
  Check checked = check(file, purpose);
  *catalog = std::move(checked.catalog);
  if (!checked.is_usable) {
    catalog->compiled = nullptr;
  } else if (catalog->compiled == nullptr) {
    catalog->compiled = std::make_shared<const CompiledCatalog>(compile(catalog->reading.catalog));
  }
  return catalog;
}

std::shared_ptr<const CheckedCatalog> FileSet::load(const std::string& path, NamedBy named_by) {
  const auto [entry, is_new] = known_.try_emplace(key_of(path));
  Known& known = entry->second;
  if (is_new) {
    const std::size_t faulty = faulty_;
    if (const auto file = read_catalog(path, named_by)) known.catalog = load(*file);
    if (known.catalog != nullptr && known.catalog->compiled == nullptr) known.catalog = nullptr;
    known.fault = faulty_ > faulty ? Fault::in_findings : Fault::printed;
  }
  return known.catalog;
}

std::shared_ptr<const CheckedCatalog> FileSet::load(const NamedCatalog& named) {
  auto catalog = load(named.path, NamedBy::file);
  if (catalog == nullptr && fault_of(named.path) == Fault::printed) {
    complain("{}: the catalog {} cannot be used", named.place, quote(named.path));
  }
  return catalog;
}

std::optional<NamedCatalog> FileSet::expect_catalog(const InputFile& file) {
  std::optional<NamedCatalog> named = catalog_named_by(file);
  if (!named) {
    complain(
        "{} {} names no catalog, and none is given; give one on the command line, or write "
        "'catalog: FILE' into it",
        file.is(FileKind::properties) ? "property file" : "script", quote(file.name));
  }
  return named;
}

std::optional<Script> FileSet::read_script(const InputFile& file, const CompiledCatalog& catalog,
                                           const Snapshot* state, std::vector<NamePlace>* names) {
  if (file.is(FileKind::log)) {
    std::string error;
    auto script = read_log(*file.text, catalog, error);
    if (script) {
      script->file = file.name;
    } else {
      cannot_read(file.name, error);
    }
    return script;
  }
  Diagnostics diagnostics;
  auto script =
      cbc::read_script(*file.document, catalog, Severity::warning, diagnostics, state, names);
  // With another situation there may be other findings.
  const bool is_complete = script && state == nullptr;
  if (!take_findings(file, std::move(diagnostics), is_complete)) return std::nullopt;
  return script;
}

std::optional<PropertyFile> FileSet::read_properties(const InputFile& file,
                                                     const CompiledCatalog& catalog,
                                                     std::vector<NamePlace>* names) {
  Diagnostics diagnostics;
  auto properties = cbc::read_properties(*file.document, catalog, diagnostics, names);
  if (!take_findings(file, std::move(diagnostics), properties.has_value())) return std::nullopt;
  return properties;
}

std::shared_ptr<const CompiledCatalog> load_catalog(const std::string& path) {
  FileSet files;
  const auto catalog = files.load(path);
  files.print_findings();
  return catalog == nullptr ? nullptr : catalog->compiled;
}

}  // namespace cbc::cli
