#include "lsp/workspace/workspace.h"

#include <algorithm>
#include <filesystem>
#include <tuple>
#include <utility>

#include "core/compile/compile.h"
#include "core/diagnostic/rules.h"
#include "core/files/check_file.h"
#include "core/files/file_search.h"
#include "core/files/read.h"
#include "core/script/reader.h"
#include "core/support/wording.h"
#include "lsp/protocol/uri.h"
#include "runtime/base/text.h"

namespace cbc::lsp {

namespace fs = std::filesystem;
using cli::FileKind;

namespace {

std::string folder_of(const std::string& path) { return fs::path(path).parent_path().string(); }

bool is_below(const std::string& path, const std::string& folder) {
  return folder == "/" ||
         (path.starts_with(folder) && path.size() > folder.size() && path[folder.size()] == '/');
}

bool is_settings_file(const std::string& path) {
  return fs::path(path).filename() == settings_file_name;
}

/// What a file is, if its content says so.
std::optional<FileKind> kind_of(const cli::InputFile& input) {
  if (input.what.kind == FileKind::settings) return FileKind::settings;
  if (!input.what.is_sure) return std::nullopt;
  return input.what.kind;
}

/// Whether a client tells of changes of a file, as it was asked to.
bool is_watched(const std::string& path, const std::string& folder) {
  const std::string extension = fs::path(path).extension().string();
  return !folder.empty() && (extension == ".yaml" || extension == ".yml");
}

/// Whether it is in a folder that is passed over. Settings are hidden themselves.
bool is_hidden(const std::string& path, const std::string& folder) {
  if (folder.empty()) return false;
  const fs::path below = fs::path(path).lexically_relative(folder);
  return std::any_of(below.begin(), below.end(), [](const fs::path& part) {
    return part.string().starts_with('.') && part != settings_file_name;
  });
}

std::string_view name_of(const File& file) {
  return file.kind == FileKind::properties ? "property file" : "script";
}

/// ": " and the reason, if there is one that the system gives.
std::string why_unreadable(const std::string& path) {
  if (const auto refusal = cli::find_refusal(path)) return concat(": ", *refusal);
  std::error_code fault;
  (void)fs::file_size(path, fault);
  return fault ? concat(": ", fault.message()) : "";
}

bool has_text(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) && !cli::can_be_mapped(path);
}

}  // namespace

void Workspace::add_folder(const std::string& folder) {
  if (!folders_.insert(folder).second) return;
  bool has_failed = false;
  std::vector<std::string> paths = cli::list_folder(folder, {".yaml", ".yml"}, has_failed);
  for (const std::string& path : paths) reread(path);
  for (const std::string& path : paths) (void)settings_of(path);
  for (auto& [path, file] : files_) {
    if (is_below(path, folder)) file.folder = find_folder(path);
  }
  mark_all_below(folder);
  has_other_catalogs_ = true;
}

void Workspace::remove_folder(const std::string& folder) {
  folders_.erase(folder);
  for (auto& [path, file] : files_) {
    if (file.folder != folder) continue;
    file.folder = find_folder(path);
    mark(path);
  }
  has_other_catalogs_ = true;
}

std::string Workspace::find_folder(const std::string& path) const {
  std::string found;
  for (const std::string& folder : folders_) {
    if (is_below(path, folder) && folder.size() > found.size()) found = folder;
  }
  return found;
}

/// A file that is known is parsed when somebody needs that: while text is typed, nobody does.
void Workspace::load(File& file, std::string text) {
  if (file.text == nullptr) changed_catalogs_.insert(file.path);  // others may name it
  file.text = std::make_shared<const Text>(std::move(text), encoding_);
  file.is_parsed = false;
  checked_.erase(file.path);  // its findings are about another text
  if (file.input == nullptr) {
    parse(file);
  } else {
    mark(file.path);
  }
}

void Workspace::parse(File& file) {
  const FileKind before = file.kind;
  file.is_parsed = true;
  file.input = reader_.parse(file.path, file.text->content());
  const std::optional<FileKind> kind = kind_of(*file.input);
  // A text that is being written does not always parse, and is what it was.
  if (kind || file.input->document != nullptr) file.kind = kind.value_or(FileKind::other);
  note_change(file, before);
}

File& Workspace::entry(const std::string& path) {
  const auto [found, is_new] = files_.try_emplace(path);
  File& file = found->second;
  if (is_new) {
    file.path = path;
    file.uri = uri_of_path(path);
    file.folder = find_folder(path);
  }
  return file;
}

void Workspace::set_text(const std::string& path, const std::string& uri, std::int64_t version,
                         std::string text) {
  File& file = entry(path);
  file.uri = uri;
  file.version = version;
  load(file, std::move(text));
}

void Workspace::close(const std::string& path) {
  const auto found = files_.find(path);
  if (found == files_.end()) return;
  found->second.version.reset();
  forget(path);  // also what kind of file it once was
  reread(path);
}

void Workspace::reread(const std::string& path) {
  const auto found = files_.find(path);
  if (found != files_.end() && found->second.version) return;  // the client has another text
  std::optional<std::string> text;
  if (has_text(path)) text = cli::read_input(path);
  if (!text) {
    // Of a folder that is gone, all files are.
    for (const auto& [other, file] : files_) {
      if (is_below(other, path) && !file.version && !has_text(other)) forget(other);
    }
    return forget(path);
  }
  if (found == files_.end() && is_hidden(path, find_folder(path))) return;
  File& file = entry(path);
  if (file.text == nullptr || file.text->content() != *text) load(file, std::move(*text));
}

void Workspace::look_at_disk(bool at_all) {
  std::set<std::string> paths;
  for (const auto& [path, file] : files_) {
    if (!file.version && (at_all || !is_watched(path, file.folder))) paths.insert(path);
    const std::string& named = file.catalog;
    const bool is_new = !named.empty() && !files_.contains(named);
    if (is_new && (at_all || !is_watched(named, find_folder(named)))) paths.insert(named);
  }
  for (const std::string& path : paths) {
    std::error_code fault;
    std::optional<fs::file_time_type> time = fs::last_write_time(path, fault);
    if (fault) time.reset();
    const auto [known, is_new] = times_on_disk_.try_emplace(path, time);
    if (!is_new && known->second == time) continue;
    known->second = time;
    reread(path);
  }
}

/// It stays among the files until it is checked, so that its findings go.
void Workspace::forget(const std::string& path) {
  const auto found = files_.find(path);
  if (found == files_.end()) return;
  File& file = found->second;
  const FileKind before = file.kind;
  changed_catalogs_.insert(path);
  file.text.reset();
  file.input.reset();
  file.kind = FileKind::other;
  note_change(file, before);
}

const File* Workspace::find(const std::string& path) const {
  const auto found = files_.find(path);
  return found == files_.end() ? nullptr : &found->second;
}

const File* Workspace::catalog_of(const File& file) const {
  if (file.kind == FileKind::catalog) return &file;
  const File* const catalog = file.catalog.empty() ? nullptr : find(file.catalog);
  return catalog != nullptr && catalog->kind == FileKind::catalog ? catalog : nullptr;
}

const Catalog* Workspace::known_catalog(const File& file) const {
  const File* const catalog = catalog_of(file);
  if (catalog == nullptr || catalog->last_names == nullptr) return nullptr;
  return &catalog->last_names->catalog;
}

void Workspace::mark(const std::string& path) { to_check_.insert(path); }

void Workspace::mark_all_below(const std::string& folder) {
  for (const auto& [path, file] : files_) {
    if (is_below(path, folder)) mark(path);
  }
}

/// Marks what a change of a file bears on.
void Workspace::note_change(const File& file, FileKind before) {
  mark(file.path);
  if (is_settings_file(file.path)) {
    settings_.clear();
    mark_all_below(folder_of(file.path));
  }
  const bool was_catalog = before == FileKind::catalog;
  const bool is_catalog = file.kind == FileKind::catalog;
  if (is_catalog || before != file.kind) changed_catalogs_.insert(file.path);
  // Files that name no catalog are about the one beside them, and others may name this one.
  has_other_catalogs_ = has_other_catalogs_ || was_catalog != is_catalog;
}

/// Marks what is about catalogs that have changed.
void Workspace::mark_about() {
  if (has_other_catalogs_) catalogs_.clear();
  for (const auto& [path, file] : files_) {
    const bool is_touched = has_other_catalogs_ || changed_catalogs_.contains(file.catalog);
    if (is_touched && file.is_about_catalog()) mark(path);
  }
  for (const std::string& catalog : changed_catalogs_) {
    const std::optional<std::string> settings = settings_file_of(catalog);
    if (settings && files_.contains(*settings)) mark(*settings);
  }
  has_other_catalogs_ = false;
  changed_catalogs_.clear();
}

std::string Workspace::next() const {
  const auto rank = [this](const std::string& path) {
    const File& file = files_.at(path);
    return std::tuple(!file.version, file.is_about_catalog(), file.kind == FileKind::settings);
  };
  return *std::min_element(
      to_check_.begin(), to_check_.end(),
      [&](const std::string& a, const std::string& b) { return rank(a) < rank(b); });
}

const File& Workspace::next_checked() {
  if (checked_.empty()) check_now(next());
  const std::string path = *checked_.begin();
  checked_.erase(checked_.begin());
  return files_.at(path);
}

void Workspace::check_now(const std::string& path) {
  for (auto& [other, file] : files_) {
    if (file.text != nullptr && !file.is_parsed) parse(file);
  }
  mark_about();
  if (!to_check_.contains(path)) return;
  File& file = files_.at(path);
  if (file.input != nullptr && file.is_about_catalog()) {
    file.catalog = find_catalog_of(file);
    if (to_check_.contains(file.catalog)) check(files_.at(file.catalog));
  }
  check(file);
}

void Workspace::check_all() {
  while (!to_check_.empty()) check_now(next());
}

void Workspace::check(File& file) {
  to_check_.erase(file.path);
  checked_.insert(file.path);
  file.check = ++checks_;
  file.findings.clear();
  file.names.clear();
  file.has_all_findings = true;
  if (file.kind != FileKind::catalog) {
    file.checked = nullptr;
    file.last_names = nullptr;
  }
  if (file.input == nullptr) return;
  if (file.kind == FileKind::catalog) {
    check_catalog(file);
  } else if (file.is_about_catalog()) {
    check_about(file);
  } else if (file.kind == FileKind::settings) {
    check_settings(file);
  }
}

void Workspace::check_catalog(File& file) {
  const auto settings = settings_of(file.path);
  if (!settings) return;
  LintOptions options;
  options.depth = CheckDepth::rules;
  auto checked =
      std::make_shared<CheckedCatalog>(cli::check_catalog_file(*file.input, *settings, options));
  const CatalogReading& reading = checked->reading;
  if (reading.has_all_names && reading.is_acyclic && reading.is_complete) {
    checked->compiled = std::make_shared<const CompiledCatalog>(compile(reading.catalog));
  }
  file.findings = std::move(checked->findings);
  file.names = reading.names;
  file.has_all_findings = file.input->document == nullptr;
  if (!reading.catalog.tasks.empty()) {
    file.last_names = std::shared_ptr<const CatalogReading>(checked, &checked->reading);
  }
  file.checked = std::move(checked);
}

/// As `cbc lint` finds it. Empty if there is none.
std::string Workspace::find_catalog_of(const File& file) {
  if (file.input->document == nullptr) return file.catalog;
  if (const auto named = cli::catalog_named_by(*file.input)) {
    if (!files_.contains(named->path)) reread(named->path);
    return named->path;
  }
  if (file.folder.empty()) return {};
  const auto [catalogs, is_new] = catalogs_.try_emplace(file.folder);
  if (is_new) {
    for (const auto& [path, other] : files_) {
      // Of other names, a file is only what another one names.
      const bool is_in_folder = other.folder == file.folder && is_watched(path, other.folder);
      if (is_in_folder && other.kind == FileKind::catalog) catalogs->second.add(path);
    }
  }
  return catalogs->second.beside(file.path, file.folder);
}

void Workspace::check_about(File& file) {
  const auto settings = settings_of(file.path);
  if (!settings) return;
  if (file.input->document == nullptr) {
    file.findings = cli::check_catalog_file(*file.input, *settings, {}).findings;
    return;
  }
  const File* const catalog = catalog_of(file);
  if (catalog == nullptr || catalog->checked == nullptr || catalog->checked->compiled == nullptr) {
    return note_missing_catalog(file);
  }
  file.findings =
      cli::check_about_catalog(*file.input, *catalog->checked->compiled, *settings, &file.names);
}

/// If the errors of the catalog are shown, they say enough, as somebody may be writing it.
void Workspace::note_missing_catalog(File& file) const {
  const yaml::Node* const named = catalog_of_script(*file.input->document);
  if (named == nullptr || cli::can_be_mapped(file.catalog)) return;
  const File* const other = find(file.catalog);
  const bool is_there = other != nullptr && other->text != nullptr;
  std::string why = concat(quote(named->text), " is not a catalog");
  if (!is_there) {
    why = concat("cannot read ", quote(named->text), why_unreadable(file.catalog));
  } else if (other->is_about_catalog()) {
    why = concat(quote(named->text), " is a ", name_of(*other), "; expected a catalog here");
  } else if (other->kind == FileKind::catalog) {
    if (other->is_shown()) return;
    why = concat("the catalog ", quote(named->text), " cannot be used; 'cbc lint' says why");
  }
  file.findings.push_back({rule::invalid_value,
                           Severity::error,
                           file.path,
                           named->range,
                           concat("this ", name_of(file), " is not checked: ", why),
                           {},
                           {},
                           true});
}

void Workspace::check_settings(File& file) {
  Diagnostics diagnostics;
  const auto settings = read_settings(file.text->content(), file.path, diagnostics);
  if (settings && !settings->never_together().empty()) {
    std::set<std::string> tasks;
    bool has_all = true;
    for (const auto& [path, other] : files_) {
      if (other.kind != FileKind::catalog || settings_file_of(path) != file.path) continue;
      const bool has_tasks =
          other.checked != nullptr && !other.checked->reading.catalog.tasks.empty();
      has_all = has_all && has_tasks;
      if (!has_tasks) continue;
      for (const Task& task : other.checked->reading.catalog.tasks) tasks.insert(task.name);
    }
    if (has_all && !tasks.empty()) {
      check_never_together_names(settings->never_together(), {tasks.begin(), tasks.end()},
                                 diagnostics);
    }
    for (const NeverTogether& list : settings->never_together()) {
      for (const Range& range : list.ranges) file.names.push_back({NameKind::task, range});
    }
  }
  diagnostics.sort();
  file.findings = diagnostics.release();
}

std::optional<std::string> Workspace::settings_file_of(const std::string& path) const {
  std::optional<std::string> nearest = find_settings_file(path);
  for (const auto& [other, file] : files_) {
    const bool is_meant = file.version && file.text != nullptr && is_settings_file(other) &&
                          is_below(path, folder_of(other));
    if (is_meant && (!nearest || other.size() > nearest->size())) nearest = other;
  }
  return nearest;
}

std::optional<SeveritySettings> Workspace::settings_of(const std::string& path) {
  const std::optional<std::string> settings = settings_file_of(path);
  if (!settings || cli::find_refusal(*settings)) return SeveritySettings();
  const auto [entry, is_new] = settings_.try_emplace(*settings);
  if (!is_new) return entry->second;
  if (!files_.contains(*settings)) reread(*settings);
  const File* const file = find(*settings);
  if (file == nullptr || file->text == nullptr) return SeveritySettings();
  Diagnostics ignored;  // they are findings of that file
  std::optional<SeveritySettings> read = read_settings(file->text->content(), *settings, ignored);
  if (read) {
    usable_settings_.insert_or_assign(*settings, *read);
  } else if (const auto last = usable_settings_.find(*settings); last != usable_settings_.end()) {
    read = last->second;  // somebody is writing it
  }
  settings_.insert_or_assign(*settings, read);  // reading may have cleared them
  return read;
}

const File* Workspace::next_to_prove() const {
  const File* best = nullptr;
  for (const auto& [path, file] : files_) {
    if (file.has_all_findings || to_check_.contains(path) || file.kind != FileKind::catalog)
      continue;
    if (best == nullptr || (file.version && !best->version)) best = &file;
  }
  return best;
}

const File* Workspace::add_proofs(const std::string& path, std::uint64_t check,
                                  CheckedCatalog proved) {
  const auto found = files_.find(path);
  if (found == files_.end() || found->second.check != check || to_check_.contains(path)) {
    return nullptr;
  }
  File& file = found->second;
  file.findings = std::move(proved.findings);
  file.has_all_findings = true;
  return &file;
}

}  // namespace cbc::lsp
