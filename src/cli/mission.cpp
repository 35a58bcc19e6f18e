#include "cli/mission.h"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "catalog/reader.h"
#include "cli/file_kind.h"
#include "cli/findings.h"
#include "cli/input.h"
#include "compiled/compile.h"
#include "lint/controls.h"
#include "script/reader.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

namespace fs = std::filesystem;

}  // namespace

std::optional<std::vector<Mission>> MissionLoader::load(const std::vector<std::string>& paths) {
  std::size_t first_script = 0;
  const auto from_stdin = std::count(paths.begin(), paths.end(), "-");
  if (from_stdin > 1) {
    complain("standard input can be read only once, but is given several times");
    return std::nullopt;
  }
  if (!is_folder(paths.front())) {
    const DocumentPointer first = read(paths.front());
    if (first != nullptr && is_script(*first)) {
      add_script(paths.front(), *first);
    } else if (first != nullptr) {
      given_catalog_ = compile(paths.front(), *first);
    }
    first_script = 1;
  }
  for (std::size_t place = first_script; place < paths.size(); ++place) add_path(paths[place]);
  std::stable_sort(findings_.begin(), findings_.end(),
                   [](const Diagnostic& a, const Diagnostic& b) { return a.file < b.file; });
  print_findings(findings_, texts_);
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

MissionLoader::DocumentPointer MissionLoader::read(const std::string& path) {
  std::optional<std::string> text = read_input(path);
  DocumentPointer document;
  if (text) {
    const std::string name = display_name(path);
    const auto entry = texts_.insert_or_assign(name, std::move(*text)).first;
    Diagnostics diagnostics;
    document = yaml::parse(entry->second, name, diagnostics);
    for (Diagnostic& finding : diagnostics.release()) findings_.push_back(std::move(finding));
  }
  if (document == nullptr) has_failed_ = true;
  return document;
}

/// Takes over the findings about a file, but for those that its comments and settings allow. False
/// if there are errors.
bool MissionLoader::take_findings(const std::string& path, const yaml::Document& document,
                                  Diagnostics diagnostics) {
  const std::optional<SeveritySettings> settings = settings_.find(path);
  if (!settings) return false;
  // Not all rules are looked at here, so that none of the comments can be called unused.
  const CommentedFile file{document.file(), texts_.at(document.file()), &document, false};
  bool has_errors = false;
  for (Diagnostic& finding : control_findings(diagnostics.release(), file, *settings)) {
    has_errors |= finding.severity == Severity::error;
    findings_.push_back(std::move(finding));
  }
  return !has_errors;
}

std::shared_ptr<const CompiledCatalog> MissionLoader::compile(const std::string& path,
                                                              const yaml::Document& document) {
  Diagnostics diagnostics;
  const CatalogReading reading = understand_catalog(document, diagnostics);
  if (!take_findings(path, document, std::move(diagnostics))) {
    has_failed_ = true;
    return nullptr;
  }
  return std::make_shared<const CompiledCatalog>(cbc::compile(reading.catalog));
}

void MissionLoader::add_path(const std::string& path) {
  if (is_folder(path)) {
    add_folder(path);
  } else if (const DocumentPointer document = read(path)) {
    add_script(path, *document);
  }
}

/// The scripts of a folder; catalogs may lie among them.
void MissionLoader::add_folder(const std::string& path) {
  for (const std::string& file : list_folder(path, {".yaml", ".yml", ".json"}, has_failed_)) {
    const DocumentPointer document = read(file);
    if (document != nullptr && is_script(*document)) add_script(file, *document);
  }
}

void MissionLoader::add_script(const std::string& path, const yaml::Document& document) {
  if (is_catalog(document)) {
    complain(fmt::format("{} is a catalog; expected a script here (a catalog goes first)",
                         quote(display_name(path))));
    has_failed_ = true;
    return;
  }
  std::shared_ptr<const CompiledCatalog> catalog = catalog_of(path, document);
  if (catalog == nullptr) {
    has_failed_ = true;
    return;
  }
  Diagnostics diagnostics;
  std::optional<Script> script =
      read_script(document, names_of(*catalog), Severity::warning, diagnostics);
  if (take_findings(path, document, std::move(diagnostics)) && script) {
    missions_.push_back({std::move(catalog), std::move(*script)});
  } else {
    has_failed_ = true;
  }
}

std::shared_ptr<const CompiledCatalog> MissionLoader::catalog_of(const std::string& script_path,
                                                                 const yaml::Document& script) {
  if (given_catalog_ != nullptr) return given_catalog_;
  const std::optional<std::string> named = catalog_of_script(script);
  if (!named) {
    // A catalog that was given, but has errors, is complaint enough.
    if (!has_failed_) {
      complain(fmt::format("script {} names no catalog, and none is given",
                           quote(display_name(script_path))));
    }
    return nullptr;
  }
  return catalog_at((fs::path(script_path).parent_path() / *named).lexically_normal().string());
}

std::shared_ptr<const CompiledCatalog> MissionLoader::catalog_at(const std::string& path) {
  const auto [entry, is_new] = catalogs_.try_emplace(path, nullptr);
  if (is_new) {
    if (const DocumentPointer document = read(path)) entry->second = compile(path, *document);
  }
  return entry->second;
}

}  // namespace cbc::cli
