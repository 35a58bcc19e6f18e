#include "core/files/missions.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <system_error>
#include <utility>

#include "core/files/output.h"
#include "core/files/read.h"
#include "runtime/base/text.h"

namespace cbc::cli {

std::optional<std::vector<Mission>> MissionLoader::load(const std::vector<std::string>& paths) {
  std::size_t first_script = 0;
  if (given_catalog_ == nullptr && !is_folder(paths.front())) {
    const auto first = files_.read(paths.front());
    if (first && (first->is(FileKind::script) || first->is(FileKind::properties))) {
      add_script(*first);
    } else {
      if (first) given_catalog_ = files_.load(*first);
      is_given_catalog_bad_ = given_catalog_ == nullptr || given_catalog_->compiled == nullptr;
      has_failed_ = is_given_catalog_bad_;
    }
    first_script = 1;
  }
  for (std::size_t place = first_script; place < paths.size(); ++place) {
    const std::size_t known = missions_.size();
    add_path(paths[place]);
    if (has_failed_ || missions_.size() > known || needs_none_) continue;
    complain("found no event script in {}", quote(paths[place]));
    has_failed_ = true;
  }
  files_.print_findings();
  const bool has_others = missions_.size() > outdated_ || outdated_ == 0;
  if (has_failed_ || !has_others) return std::nullopt;
  if (missions_.empty() && !needs_none_) {
    complain("no event script given for catalog {}", quote(display_name(paths.front())));
    return std::nullopt;
  }
  return std::move(missions_);
}

void MissionLoader::add_path(const std::string& path) {
  if (is_folder(path)) {
    add_folder(path);
    return;
  }
  if (is_left_out(path)) return;
  if (const auto file = files_.read(path, NamedBy::command_line, FileSet::Logs::accepted)) {
    add_script(*file);
  } else {
    has_failed_ = true;
  }
}

/// Adds the scripts of a folder. It may contain other files, but a script is not skipped because of
/// a mistake in it.
void MissionLoader::add_folder(const std::string& path) {
  for (const std::string& name : list_folder(path, {".yaml", ".yml", ".json"}, has_failed_)) {
    if (is_left_out(name)) continue;
    const NamedBy named_by = leads_out_of(path, name) ? NamedBy::link : NamedBy::command_line;
    const auto file = files_.read(name, named_by);
    if (!file) {
      has_failed_ = true;
    } else if (file->what.kind == FileKind::script) {
      add_script(*file);
    }
  }
}

bool MissionLoader::is_left_out(const std::string& path) const {
  if (!left_out_) return false;
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return is_same_file(folder.empty() ? "." : folder.string(), *left_out_);
}

void MissionLoader::refuse(const InputFile& file, const char* what) {
  complain("{} {}", quote(file.name), what);
  has_failed_ = true;
}

void MissionLoader::add_script(const InputFile& file) {
  if (file.is(FileKind::catalog) || file.is(FileKind::compiled)) {
    return refuse(file, "is a catalog; expected a script here (a catalog goes first)");
  }
  if (file.is(FileKind::properties)) {
    return refuse(file, "is a property file; expected a script here");
  }
  std::shared_ptr<const CheckedCatalog> catalog = catalog_of(file);
  if (catalog == nullptr) {
    has_failed_ = true;
    return;
  }
  const std::size_t known = files_.findings().size();
  std::optional<Script> script = files_.read_script(file, *catalog->compiled);
  std::string outdated;
  if (!script && keeps_outdated_) outdated = find_outdated(known);
  if (!outdated.empty()) {
    ++outdated_;
    script.emplace().file = file.name;
  }
  if (script) {
    missions_.push_back(
        {catalog->compiled, std::move(*script), std::move(catalog), std::move(outdated)});
  } else {
    has_failed_ = true;
  }
}

/// What a script names that its catalog does not have, from its findings. Empty if something else
/// is wrong.
std::string MissionLoader::find_outdated(std::size_t first_finding) const {
  const std::array rules = {rule::undefined_task.name, rule::undefined_behavior.name,
                            rule::undeclared_situation.name};
  std::string first;
  std::size_t count = 0;
  for (std::size_t place = first_finding; place < files_.findings().size(); ++place) {
    const Diagnostic& finding = files_.findings()[place];
    if (finding.severity != Severity::error) continue;
    if (std::find(rules.begin(), rules.end(), finding.rule) == rules.end()) return {};
    if (count++ == 0) first = concat("line ", finding.range.begin.line, ": ", finding.message);
  }
  if (count == 0) return {};
  return concat("not run: ", first, count > 1 ? concat("; and ", count - 1, " more") : "");
}

std::shared_ptr<const CheckedCatalog> MissionLoader::catalog_of(const InputFile& script) {
  if (is_given_catalog_bad_) return nullptr;
  if (given_catalog_ != nullptr) return given_catalog_;
  if (script.is(FileKind::log)) {
    complain("{} is a log: give the catalog before it", quote(script.name));
    return nullptr;
  }
  const std::optional<NamedCatalog> named = files_.expect_catalog(script);
  return named ? files_.load(*named) : nullptr;
}

std::string path_in_script(const std::string& catalog, const std::string& folder) {
  if (catalog == "-") return {};
  // Of a folder that does not exist yet, a relative path would stay one.
  std::error_code error;
  const std::filesystem::path path = std::filesystem::proximate(
      std::filesystem::absolute(catalog), std::filesystem::absolute(folder), error);
  return error ? std::string{} : path.generic_string();
}

void complain_of_run(const Mission& mission, const RunResult& result, const std::string& reason) {
  complain("{}: {}", quote(mission.script.file), reason);
  if (result.status == Coordinator::Status::refused_answer) {
    complain(
        "this is a bug in cbc, not in the catalog {}; please report it with the catalog and the "
        "script",
        quote(mission.catalog->file));
  }
}

}  // namespace cbc::cli
