#include "cli/mission.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "cli/file_kind.h"
#include "cli/input.h"
#include "cli/named_catalog.h"
#include "script/reader.h"
#include "text/quote.h"

namespace cbc::cli {
std::optional<std::vector<Mission>> MissionLoader::load(const std::vector<std::string>& paths) {
  std::size_t first_script = 0;
  const auto from_stdin = std::count(paths.begin(), paths.end(), "-");
  if (from_stdin > 1) {
    complain(stdin_only_once);
    return std::nullopt;
  }
  if (!is_folder(paths.front())) {
    const std::optional<InputFile> first = files_.read(paths.front());
    if (first && first->document != nullptr && is_script(*first->document)) {
      add_script(paths.front(), *first->document);
    } else {
      if (first) given_catalog_ = catalogs_.load(*first);
      is_given_catalog_bad_ = given_catalog_ == nullptr;
      has_failed_ = is_given_catalog_bad_;
    }
    first_script = 1;
  }
  for (std::size_t place = first_script; place < paths.size(); ++place) add_path(paths[place]);
  files_.print_findings();
  if (has_failed_) return std::nullopt;
  if (missions_.empty()) {
    complain(given_catalog_ != nullptr && paths.size() == 1
                 ? fmt::format("no event script given to solve on catalog {}",
                               quote(display_name(paths.front())))
                 : fmt::format("found no event script in {}", quote(paths.back())));
    return std::nullopt;
  }
  return std::move(missions_);
}

void MissionLoader::add_path(const std::string& path) {
  if (is_folder(path)) {
    add_folder(path);
    return;
  }
  const std::optional<InputFile> file = files_.read(path);
  if (!file) {
    has_failed_ = true;
  } else if (file->document == nullptr) {
    complain_of_catalog(path);
  } else {
    add_script(path, *file->document);
  }
}

/// The scripts of a folder; other files may lie among them, but none that is meant as a script is
/// left out for a slip of the pen.
void MissionLoader::add_folder(const std::string& path) {
  for (const std::string& name : list_folder(path, {".yaml", ".yml", ".json"}, has_failed_)) {
    const std::optional<InputFile> file = files_.read(name);
    if (!file) {
      has_failed_ = true;
    } else if (file->document != nullptr && looks_like_script(*file->document)) {
      add_script(name, *file->document);
    }
  }
}

void MissionLoader::complain_of_catalog(const std::string& path) {
  complain(fmt::format("{} is a catalog; expected a script here (a catalog goes first)",
                       quote(display_name(path))));
  has_failed_ = true;
}

void MissionLoader::add_script(const std::string& path, const yaml::Document& document) {
  if (is_catalog(document)) {
    complain_of_catalog(path);
    return;
  }
  std::shared_ptr<const CompiledCatalog> catalog = catalog_of(path, document);
  if (catalog == nullptr) {
    has_failed_ = true;
    return;
  }
  Diagnostics diagnostics;
  std::optional<Script> script = read_script(document, *catalog, Severity::warning, diagnostics);
  if (files_.take_findings(path, document, std::move(diagnostics)) && script) {
    missions_.push_back({std::move(catalog), path_of_catalog(path, document), std::move(*script)});
  } else {
    has_failed_ = true;
  }
}

std::shared_ptr<const CompiledCatalog> MissionLoader::catalog_of(const std::string& script_path,
                                                                 const yaml::Document& script) {
  if (given_catalog_ != nullptr || is_given_catalog_bad_) return given_catalog_;
  const std::optional<std::string> named = path_of_catalog(script_path, script);
  if (!named) {
    complain(fmt::format("script {} names no catalog, and none is given",
                         quote(display_name(script_path))));
    return nullptr;
  }
  return catalogs_.load(*named);
}

}  // namespace cbc::cli
