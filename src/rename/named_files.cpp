#include <algorithm>
#include <string_view>
#include <utility>

#include "core/files/output.h"
#include "core/files/read.h"
#include "core/support/system.h"
#include "core/support/wording.h"
#include "core/yaml/document.h"
#include "rename/rename.h"
#include "runtime/base/text.h"

namespace cbc::cli {
namespace {

/// "task", "behavior", "situation variable"
std::string kind_in_words(NameKind kind) {
  return kind == NameKind::variable ? "situation variable" : std::string(name_of(kind));
}

}  // namespace

std::optional<std::vector<NamedFile>> NamedFiles::load(const std::vector<std::string>& paths) {
  bool cannot_search = false;
  for (const FoundFile& found : find_files(paths, {".yaml", ".yml", ".json"}, cannot_search)) {
    take(found);
  }
  has_failed_ |= cannot_search;
  if (!has_failed_) keep_renamed();
  if (!has_failed_) {
    for (const auto& [about, folder] : others_) take_about_catalog(about, folder);
    for (const auto& catalog : catalogs_) take_settings(*catalog, paths);
  }
  if (!has_failed_) return std::move(result_);
  // Warnings are no reason, and would hide it.
  const std::vector<Diagnostic>& findings = files_.findings();
  const bool has_errors =
      std::any_of(findings.begin(), findings.end(),
                  [](const Diagnostic& finding) { return finding.severity == Severity::error; });
  if (has_errors) files_.print_findings();
  return std::nullopt;
}

void NamedFiles::take(const FoundFile& found) {
  if (found.path == "-") {
    complain("standard input cannot be changed in place; give the names of files");
    return fail();
  }
  if (!taken_.insert(target_of(found.path)).second) return;
  const bool is_link = !found.is_named && leads_out_of(found.folder, found.path);
  const NamedBy named_by = is_link ? NamedBy::link : NamedBy::command_line;
  const auto file = files_.open(found.path, named_by);
  if (file == nullptr) return fail();
  const FileKind kind = file->what.kind;
  if (!found.is_named) {
    const bool is_unclear = !file->what.is_sure && file->document == nullptr;
    if (is_unclear && file->text->find(renaming_.old_name) != std::string::npos) {
      complain("{} is not valid YAML, and may have the name {}", quote(file->name),
               quote(renaming_.old_name));
      return fail();
    }
    const bool is_for_cbc =
        kind == FileKind::catalog || kind == FileKind::script || kind == FileKind::properties;
    if (!file->what.is_sure || !is_for_cbc) return;
  }
  switch (kind) {
    case FileKind::settings:
      return;  // they are changed with the catalogs that they apply to
    case FileKind::compiled:
      complain("{} is a compiled catalog; rename in its YAML, and compile that anew",
               quote(file->name));
      return fail();
    case FileKind::log:
      complain("{} is the log of a stream, which says what happened under the old name",
               quote(file->name));
      return fail();
    case FileKind::script:
    case FileKind::properties: {
      NamedFile about;
      about.kind = kind == FileKind::script ? NamedFile::Kind::script : NamedFile::Kind::properties;
      about.file = files_.read(found.path, named_by);
      if (about.file == nullptr) return fail();
      others_.emplace_back(std::move(about), found.folder);
      return;
    }
    case FileKind::catalog:
    case FileKind::other:
      return take_catalog(found, named_by);
  }
}

void NamedFiles::take_catalog(const FoundFile& found, NamedBy named_by) {
  auto catalog = std::make_unique<NamedFile>();
  catalog->file = files_.read_catalog(found.path, named_by);
  if (catalog->file != nullptr) catalog->catalog = files_.load(*catalog->file);
  if (catalog->catalog == nullptr || catalog->catalog->compiled == nullptr) return fail();
  catalog->names = catalog->catalog->reading.names;
  folders_.add(found.path);
  catalogs_.push_back(std::move(catalog));
}

/// The catalog among the files that another one is about. Null if there is none; a message says
/// why.
const NamedFile* NamedFiles::catalog_of(const InputFile& file, const std::string& folder) {
  const auto find = [this](const std::string& path) -> const NamedFile* {
    const std::string target = target_of(path);
    const auto found = std::find_if(catalogs_.begin(), catalogs_.end(), [&](const auto& catalog) {
      return target_of(catalog->file->path) == target;
    });
    return found == catalogs_.end() ? nullptr : found->get();
  };
  if (const auto named = catalog_named_by(file)) {
    const NamedFile* const catalog = find(named->path);
    if (catalog == nullptr) {
      complain("{}: its catalog {} is not among the files, so this file stays as it is",
               named->place, quote(named->path));
    }
    return catalog;
  }
  if (catalogs_.size() == 1) return catalogs_.front().get();
  const std::string beside = folders_.beside(file.path, folder);
  if (!beside.empty()) return find(beside);
  complain(
      "{} names no catalog, and there is not exactly one beside it; write 'catalog: FILE' "
      "into it",
      quote(file.name));
  fail();
  return nullptr;
}

void NamedFiles::take_about_catalog(const NamedFile& about, const std::string& folder) {
  const NamedFile* const catalog = catalog_of(*about.file, folder);
  if (catalog == nullptr || !has_name(*catalog, renaming_.old_name)) return;
  NamedFile taken = about;
  taken.catalog = catalog->catalog;
  const CompiledCatalog& compiled = *taken.catalog->compiled;
  const bool is_understood =
      taken.kind == NamedFile::Kind::script
          ? files_.read_script(*taken.file, compiled, nullptr, &taken.names).has_value()
          : files_.read_properties(*taken.file, compiled, &taken.names).has_value();
  if (!is_understood) return fail();
  result_.push_back(std::move(taken));
}

bool NamedFiles::has_name(const NamedFile& catalog, const std::string& name) const {
  return place_of_name(catalog.catalog->reading.catalog, renaming_.kind, name).has_value();
}

/// Takes the catalogs that have the old name. None of them may have the new one.
void NamedFiles::keep_renamed() {
  for (const auto& catalog : catalogs_) {
    if (!has_name(*catalog, renaming_.old_name)) continue;
    report_taken(*catalog);
    result_.push_back(*catalog);
  }
  if (result_.empty()) report_missing();
}

void NamedFiles::report_missing() {
  fail();
  if (catalogs_.empty()) {
    complain("there is no catalog among the files; give the one that has the name, too");
    return;
  }
  std::vector<std::string_view> known;
  std::string other;
  for (const auto& catalog : catalogs_) {
    const Catalog& read = catalog->catalog->reading.catalog;
    visit_named(read, renaming_.kind, [&known](const auto& things) {
      for (const auto& thing : things) known.push_back(thing.name);
    });
    for (const NameKind kind : {NameKind::task, NameKind::behavior, NameKind::variable}) {
      if (kind == renaming_.kind || !place_of_name(read, kind, renaming_.old_name)) continue;
      other = ": it is a " + kind_in_words(kind);
    }
  }
  complain("{} {} {}{}",
           catalogs_.size() == 1 ? "catalog " + quote(catalogs_.front()->file->name) + " has no"
                                 : "none of the catalogs among the files has a",
           kind_in_words(renaming_.kind), quote(renaming_.old_name),
           other.empty() ? did_you_mean(nearest(renaming_.old_name, known)) : other);
}

/// The situation names behaviors and variables alike.
void NamedFiles::report_taken(const NamedFile& catalog) {
  std::vector<NameKind> kinds{renaming_.kind};
  if (renaming_.kind == NameKind::behavior) kinds.push_back(NameKind::variable);
  if (renaming_.kind == NameKind::variable) kinds.push_back(NameKind::behavior);
  for (const NameKind kind : kinds) {
    const auto range = place_of_name(catalog.catalog->reading.catalog, kind, renaming_.new_name);
    if (!range) continue;
    complain("{}: there is a {} {} already",
             format_place(printable(catalog.file->name), range->begin), kind_in_words(kind),
             quote(renaming_.new_name));
    fail();
  }
}

bool NamedFiles::is_among(const std::string& settings,
                          const std::vector<std::string>& paths) const {
  return std::any_of(paths.begin(), paths.end(), [&settings](const std::string& path) {
    return is_folder(path) ? !leads_out_of(path, settings) : target_of(path) == target_of(settings);
  });
}

/// The settings that apply to a catalog, if they have the name.
void NamedFiles::take_settings(const NamedFile& catalog, const std::vector<std::string>& paths) {
  if (renaming_.kind != NameKind::task || !has_name(catalog, renaming_.old_name)) return;
  const auto settings = files_.settings_of(*catalog.file);
  if (!settings) return fail();
  NamedFile taken;
  taken.kind = NamedFile::Kind::settings;
  const Range* first = nullptr;
  for (const NeverTogether& list : settings->never_together()) {
    for (std::size_t place = 0; place < list.tasks.size(); ++place) {
      taken.names.push_back({NameKind::task, list.ranges[place]});
      if (list.tasks[place] == renaming_.old_name && first == nullptr) first = &list.ranges[place];
    }
  }
  if (first == nullptr) return;
  const std::string& path = settings->never_together().front().file;
  if (!taken_.insert(concat("settings ", target_of(path))).second) return;
  if (!is_among(path, paths)) {
    complain("{}: these settings have the name, too, and are not among the files; give them, too",
             format_place(printable(path), first->begin));
    return fail();
  }
  taken.file = files_.open(path);
  if (taken.file == nullptr) return fail();
  result_.push_back(std::move(taken));
}

}  // namespace cbc::cli
