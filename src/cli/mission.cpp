#include "cli/mission.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "catalog/reader.h"
#include "cli/input.h"
#include "cli/terminal.h"
#include "compiled/compile.h"
#include "diagnostic/text.h"
#include "script/reader.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

namespace fs = std::filesystem;

// What a file is, is told by its content.

bool has_any(const yaml::Document& document, std::initializer_list<std::string_view> keys) {
  return std::any_of(keys.begin(), keys.end(),
                     [&](std::string_view key) { return document.root().find(key) != nullptr; });
}

bool is_catalog(const yaml::Document& document) {
  return has_any(document, {"behaviors", "tasks", "exclusivity_constraints", "default_values"});
}

bool is_script(const yaml::Document& document) {
  return document.root().kind == yaml::Kind::sequence ||
         (!is_catalog(document) &&
          has_any(document, {"events", "catalog", "reactive_delay", "situation"}));
}

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return path != "-" && fs::is_directory(path, ignored);
}

void complain(const std::string& message) { fmt::print(stderr, "cbc: {}\n", message); }

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
      given_catalog_ = compile(*first);
    }
    first_script = 1;
  }
  for (std::size_t place = first_script; place < paths.size(); ++place) add_path(paths[place]);
  report();
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
    document = yaml::parse(entry->second, name, diagnostics_);
  }
  if (document == nullptr) has_failed_ = true;
  return document;
}

std::shared_ptr<const CompiledCatalog> MissionLoader::compile(const yaml::Document& document) {
  const std::optional<Catalog> catalog = read_catalog(document, diagnostics_);
  if (!catalog) {
    has_failed_ = true;
    return nullptr;
  }
  return std::make_shared<const CompiledCatalog>(cbc::compile(*catalog));
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
  const auto files = list_folder(path);
  if (!files) {
    has_failed_ = true;
    return;
  }
  for (const std::string& file : *files) {
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
  const ScriptNames names{{catalog->task_names.begin(), catalog->task_names.end()},
                          {catalog->behavior_names.begin(), catalog->behavior_names.end()}};
  std::optional<Script> script = read_script(document, names, diagnostics_);
  if (script) {
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
    if (const DocumentPointer document = read(path)) entry->second = compile(*document);
  }
  return entry->second;
}

/// All errors; of warnings, the first few of each rule and file.
void MissionLoader::report() {
  constexpr std::size_t most_warnings = 3;
  SourceTexts sources;
  for (const auto& [file, text] : texts_) sources.add(file, text);
  const bool use_color = wants_color(stderr);
  diagnostics_.sort();
  std::map<std::pair<std::string_view, std::string_view>, std::size_t> warnings;
  for (const Diagnostic& diagnostic : diagnostics_.all()) {
    if (diagnostic.severity == Severity::error ||
        ++warnings[{diagnostic.file, diagnostic.rule}] <= most_warnings) {
      fmt::print(stderr, "{}", render(diagnostic, sources, use_color));
    }
  }
  for (const auto& [kind, count] : warnings) {
    if (count <= most_warnings) continue;
    fmt::print(stderr, "{}: {} more like these [{}]\n", printable(kind.first),
               count - most_warnings, kind.second);
  }
}

}  // namespace cbc::cli
