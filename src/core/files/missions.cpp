#include "core/files/missions.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <utility>

#include "core/files/output.h"
#include "core/files/read_files.h"
#include "core/script/reader.h"
#include "runtime/base/text.h"

namespace cbc::cli {

std::optional<std::vector<Mission>> MissionLoader::load(const std::vector<std::string>& paths) {
  std::size_t first_script = 0;
  if (!is_folder(paths.front())) {
    std::optional<InputFile> first = files_.read(paths.front());
    if (first && first->document != nullptr &&
        (is_script(*first->document) || is_property_file(*first->document))) {
      add_script(paths.front(), *first->document);
    } else {
      if (first) given_catalog_ = catalogs_.load(*first);
      is_given_catalog_bad_ = given_catalog_ == nullptr;
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
  if (has_failed_) return std::nullopt;
  if (missions_.empty() && !needs_none_) {
    complain("no event script given to solve on catalog {}", quote(display_name(paths.front())));
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
  std::optional<InputFile> file = files_.read(path);
  if (!file) {
    has_failed_ = true;
  } else if (file->document == nullptr) {
    complain_of_catalog(path);
  } else {
    add_script(path, *file->document);
  }
}

/// Adds the scripts of a folder. It may contain other files, but a script is not skipped because of
/// a mistake in it.
void MissionLoader::add_folder(const std::string& path) {
  for (const std::string& name : list_folder(path, {".yaml", ".yml", ".json"}, has_failed_)) {
    if (is_left_out(name)) continue;
    const NamedBy named_by = leads_out_of(path, name) ? NamedBy::link : NamedBy::command_line;
    std::optional<InputFile> file = files_.read(name, named_by);
    if (!file) {
      has_failed_ = true;
    } else if (file->document != nullptr && looks_like_script(*file->document)) {
      add_script(name, *file->document);
    }
  }
}

bool MissionLoader::is_left_out(const std::string& path) const {
  if (!left_out_) return false;
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return is_same_file(folder.empty() ? "." : folder.string(), *left_out_);
}

void MissionLoader::complain_of_catalog(const std::string& path) {
  complain("{} is a catalog; expected a script here (a catalog goes first)",
           quote(display_name(path)));
  has_failed_ = true;
}

void MissionLoader::add_script(const std::string& path, const yaml::Document& document) {
  if (is_catalog(document)) {
    complain_of_catalog(path);
    return;
  }
  if (is_property_file(document)) {
    complain("{} is a property file; expected a script here", quote(display_name(path)));
    has_failed_ = true;
    return;
  }
  std::shared_ptr<const CompiledCatalog> catalog = catalog_of(path, document);
  if (catalog == nullptr) {
    has_failed_ = true;
    return;
  }
  Diagnostics diagnostics;
  std::optional<Script> script = read_script(document, *catalog, Severity::warning, diagnostics);
  if (files_.take_findings(path, document, std::move(diagnostics), script.has_value()) && script) {
    std::shared_ptr<const CatalogSource> source = catalogs_.source_of(*catalog);
    missions_.push_back({std::move(catalog), std::move(*script), std::move(source)});
  } else {
    has_failed_ = true;
  }
}

std::shared_ptr<const CompiledCatalog> MissionLoader::catalog_of(const std::string& script_path,
                                                                 const yaml::Document& script) {
  if (given_catalog_ != nullptr || is_given_catalog_bad_) return given_catalog_;
  const std::optional<NamedCatalog> named = catalog_named_by(script_path, script);
  if (!named) {
    complain(
        "script {} names no catalog, and none is given; give one on the command line, or write "
        "'catalog: FILE' into it",
        quote(display_name(script_path)));
    return nullptr;
  }
  return catalogs_.load(*named);
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
