#include "fuzz/catalogs.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <string_view>
#include <tuple>

#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/script/reader.h"
#include "core/yaml/document.h"
#include "fuzz/tree.h"
#include "support/catalog_files.h"
#include "support/read_file.h"
#include "support/rich_catalog.h"
#include "support/sessions.h"

namespace cbc::fuzz {
namespace {

namespace fs = std::filesystem;

const fs::path source = CBC_SOURCE_DIR;

/// The files that stand in a golden case, by their paths.
std::map<std::string, std::string> files_of(const test::Case& one) {
  std::map<std::string, std::string> files;
  for (const test::CaseFile& file : one.files) {
    if (file.is_in_session) files[file.path] = file.content;
  }
  return files;
}

/// The catalogs in catalogs/, each with the file beside it that has this suffix.
std::vector<Pair> published(std::string_view suffix) {
  std::vector<Pair> pairs;
  for (const fs::path& catalog : test::catalog_files(source / "catalogs")) {
    fs::path other = catalog;
    other.replace_extension(suffix);
    if (fs::exists(other)) pairs.push_back({test::read_file(catalog), test::read_file(other)});
  }
  return pairs;
}

}  // namespace

std::shared_ptr<const CompiledCatalog> catalog_of(const std::string& yaml) {
  constexpr std::size_t most_kept = 256;
  static std::map<std::string, std::shared_ptr<const CompiledCatalog>> known;
  if (known.size() > most_kept) known.clear();
  const auto [entry, is_new] = known.try_emplace(yaml);
  if (is_new) {
    Diagnostics diagnostics;
    if (const auto catalog = read_catalog(yaml, "robot.yaml", diagnostics)) {
      entry->second = std::make_shared<const CompiledCatalog>(compile(*catalog));
    }
  }
  return entry->second;
}

std::optional<Script> script_of(const std::string& yaml, const CompiledCatalog& catalog) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(yaml, "mission.yaml", diagnostics);
  if (document == nullptr) return std::nullopt;
  return read_script(*document, catalog, Severity::warning, diagnostics);
}

std::vector<std::string> catalog_texts() {
  std::vector<std::string> texts{std::string(test::rich_catalog)};
  for (const Rule& rule : all_rules()) {
    if (rule.is_of_scripts) continue;
    texts.emplace_back(rule.example);
    texts.emplace_back(rule.mended);
  }
  for (const fs::path& file : test::catalog_files(source / "catalogs")) {
    texts.push_back(test::read_file(file));
  }
  return texts;
}

std::vector<Pair> catalogs_with_scripts() {
  std::vector<Pair> pairs = published(".mission.yaml");
  for (const test::Case& one : test::read_cases()) {
    const auto files = files_of(one);
    for (const char* const script : {"script.yaml", "mission.yaml"}) {
      if (!files.contains("catalog.yaml") || !files.contains(script)) continue;
      pairs.push_back({files.at("catalog.yaml"), files.at(script)});
    }
  }
  for (const Rule& rule : all_rules()) {
    if (!rule.is_of_scripts) continue;
    for (const std::string_view script : {rule.example, rule.mended}) {
      pairs.push_back({std::string(example_catalog()), std::string(script)});
    }
  }
  std::erase_if(pairs, [](const Pair& pair) { return catalog_of(pair.catalog) == nullptr; });
  return pairs;
}

std::vector<Pair> catalogs_with_properties() {
  std::vector<Pair> pairs = published(".properties.yaml");
  for (const fs::path& file : fs::directory_iterator(source / "tests/fuzz/seeds/properties")) {
    pairs.push_back({std::string(test::rich_catalog), test::read_file(file)});
  }
  return pairs;
}

std::vector<Pair> settings_with_catalogs() {
  std::vector<Pair> pairs;
  for (const test::Case& one : test::read_cases()) {
    const auto files = files_of(one);
    for (const auto& [path, settings] : files) {
      if (fs::path(path).filename() != ".cbc.yaml") continue;
      const auto catalog = files.find((fs::path(path).parent_path() / "catalog.yaml").string());
      pairs.push_back({settings, catalog != files.end()
                                     ? catalog->second
                                     : test::read_file(source / "catalogs/suave.yaml")});
    }
    if (one.name.starts_with("lint_allow_comments")) {
      pairs.push_back({"strict: true\n", files.at("catalog.yaml")});
    }
  }
  for (const Rule& rule : all_rules()) {
    if (rule.settings.empty()) continue;
    pairs.push_back({std::string(rule.settings), std::string(rule.example)});
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& left, const Pair& right) {
    return std::tie(left.catalog, left.text) < std::tie(right.catalog, right.text);
  });
  return pairs;
}

std::string stream_of(const std::string& script_yaml) {
  std::string lines;
  const std::optional<Tree> script = read_tree(script_yaml);
  if (!script || script->kind != yaml::Kind::mapping) return lines;
  for (std::size_t place = 0; place + 1 < script->items.size(); place += 2) {
    if (script->items[place].text != "events") continue;
    for (const Tree& event : script->items[place + 1].items) {
      lines += write_tree(event, Language::json);
    }
  }
  return lines;
}

}  // namespace cbc::fuzz
