// An editor asks at any place of any text. Where names stand is compared with the readers of the
// language.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "core/diagnostic/diagnostic.h"
#include "core/files/recognition.h"
#include "core/property/property_reader.h"
#include "core/script/reader.h"
#include "core/yaml/document.h"
#include "core/yaml/source.h"
#include "lsp/language/completion.h"
#include "lsp/language/context.h"
#include "lsp/language/hover.h"
#include "lsp/language/places.h"
#include "support/edited_files.h"
#include "support/read_file.h"
#include "support/rounds.h"

namespace cbc::lsp_language_test {
namespace {

using cli::FileKind;
using lsp::Completion;
using lsp::Context;
using test::context_at_mark;

/// All that an editor asks for.
void ask(const std::string& text, std::size_t cursor, FileKind kind, const Catalog* catalog) {
  const Context context = lsp::context_at(text, cursor);
  ASSERT_LE(context.begin, context.end);
  ASSERT_LE(context.end, text.size());
  const bool is_empty =
      !context.is_key && !context.is_item && context.key.empty() && context.text.empty();
  if (!is_empty) {
    ASSERT_LE(context.begin, std::max<std::size_t>(cursor, 3));
    ASSERT_GE(context.end, cursor);
  }
  const std::vector<Completion> completions = lsp::complete(context, kind, catalog);
  EXPECT_TRUE(!is_empty || completions.empty());
  for (const Completion& completion : completions) EXPECT_FALSE(completion.insert.empty());
  (void)lsp::describe(context, kind, catalog);
  (void)lsp::name_kind_at(context, kind, catalog);
}

std::string folder_of(const std::string& path) { return path.substr(0, path.rfind('/')); }

/// Small files of each kind, for tests that ask at each byte.
std::vector<const test::EditedFile*> small_files(std::size_t most) {
  std::vector<const test::EditedFile*> files;
  for (const test::EditedFile& file : test::edited_files()) {
    if (file.text.size() <= most && file.kind != FileKind::other) files.push_back(&file);
  }
  return files;
}

constexpr std::string_view quadrotor_path = CBC_SOURCE_DIR "/catalogs/quadrotor.yaml";

Catalog catalog_at(const std::string& path) {
  Diagnostics ignored;
  return *read_catalog(test::read_file(path), path, ignored);
}

TEST(LspLanguage, TakesEachPrefixOfOurFiles) {
  for (const test::EditedFile& file : test::edited_files()) {
    // Of long files every few bytes.
    const std::size_t step = file.text.size() / 3000 + 1;
    for (std::size_t size = 0; size <= file.text.size(); size += step) {
      const Context context = lsp::context_at(std::string_view(file.text).substr(0, size), size);
      ASSERT_LE(context.begin, context.end);
      ASSERT_LE(context.end, size);
    }
  }
  const Catalog catalog = catalog_at(std::string(quadrotor_path));
  for (const test::EditedFile* const file : small_files(700)) {
    for (std::size_t size = 0; size <= file->text.size(); size += 3) {
      ask(file->text.substr(0, size), size, file->kind, &catalog);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(LspLanguage, TakesRandomEdits) {
  const Catalog catalog = catalog_at(std::string(quadrotor_path));
  const std::vector<const test::EditedFile*> files = small_files(2000);
  constexpr std::string_view pieces[] = {"{",           "}",
                                         "[",           "]",
                                         ",",           ": ",
                                         ":",           "- ",
                                         "\n",          "\"",
                                         "'",           "#",
                                         "\r",          "\t",
                                         "|",           ">",
                                         "  ",          "*",
                                         "&a ",         "!t ",
                                         "\\",          std::string_view("\0", 1),
                                         "\xFF",        "---\n",
                                         "? ",          "task: ",
                                         "\xEF\xBB\xBF"};
  std::mt19937 random(42);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same in each run
  const auto below = [&random](std::size_t end) { return end == 0 ? 0 : random() % end; };
  for (int round = 0; round < test::rounds(20'000); ++round) {
    const test::EditedFile& file = *files[below(files.size())];
    std::string text = file.text;
    for (std::size_t edit = 0; edit <= below(4); ++edit) {
      const std::size_t place = below(text.size() + 1);
      if (below(2) == 0) {
        text.erase(place, below(20));
      } else {
        text.insert(place, pieces[below(std::size(pieces))]);
      }
    }
    ask(text, below(text.size() + 1), file.kind, round % 3 == 0 ? nullptr : &catalog);
    ASSERT_FALSE(HasFailure()) << text;
  }
}

// Names -------------------------------------------------------------------------------------------

using NameMap = std::map<std::size_t, NameKind>;

NameMap offsets_of(const std::vector<NamePlace>& names, const std::string& text) {
  const PositionMap positions(text);
  NameMap offsets;
  for (const NamePlace& name : names) {
    const std::size_t begin = yaml::skip_properties(text, positions.offset(name.range.begin));
    offsets.emplace(begin, name.kind);
  }
  return offsets;
}

/// The names that the readers find; nothing if the file is not to be understood.
std::optional<std::vector<NamePlace>> names_by_readers(const test::EditedFile& file,
                                                       const Catalog*& catalog) {
  static std::map<std::string, CatalogReading> readings;
  Diagnostics ignored;
  std::string path = file.path;
  if (file.kind != FileKind::catalog) {
    const yaml::Node* const named = catalog_of_script(*file.document);
    if (named == nullptr) return std::nullopt;
    path = std::filesystem::path(folder_of(path) + "/" + named->text).lexically_normal();
  }
  if (!std::filesystem::exists(path)) return std::nullopt;
  if (!readings.contains(path)) {
    const auto document = yaml::parse(test::read_file(path), path, ignored);
    if (document == nullptr) return std::nullopt;
    readings.emplace(path, understand_catalog(*document, ignored));
  }
  const CatalogReading& reading = readings.at(path);
  catalog = &reading.catalog;
  if (!reading.is_complete) return std::nullopt;
  if (file.kind == FileKind::catalog) return reading.names;
  const CompiledCatalog compiled = compile(reading.catalog);
  std::vector<NamePlace> names;
  const bool is_read =
      file.kind == FileKind::script
          ? read_script(*file.document, compiled, Severity::warning, ignored, nullptr, &names)
                .has_value()
          : read_properties(*file.document, compiled, ignored, &names).has_value();
  if (!is_read) return std::nullopt;
  return names;
}

/// Compares the places of names with those that the readers note.
void expect_names(const test::EditedFile& file, const std::vector<NamePlace>& names,
                  const Catalog& catalog) {
  const PositionMap positions(file.text);
  NameMap found;
  for (const yaml::Node& node : file.document->nodes()) {
    if (node.kind != yaml::Kind::scalar || node.shared) continue;
    const std::size_t begin = yaml::skip_properties(file.text, positions.offset(node.range.begin));
    const Context context = lsp::context_at(file.text, begin);
    const auto kind = lsp::name_kind_at(context, file.kind, &catalog);
    if (kind) found.emplace(begin, *kind);
  }
  EXPECT_EQ(found, offsets_of(names, file.text)) << file.path;
  NameMap visited;
  lsp::visit_scalars(file.text, [&](const Context& context) {
    const auto kind = lsp::name_kind_at(context, file.kind, &catalog);
    if (kind) visited.emplace(context.begin, *kind);
  });
  EXPECT_EQ(visited, found) << file.path;
}

TEST(LspNames, OfOurFilesAreThoseOfTheReaders) {
  std::map<FileKind, std::size_t> files;
  for (const test::EditedFile& file : test::edited_files()) {
    const bool has_names = file.kind == FileKind::catalog || file.kind == FileKind::script ||
                           file.kind == FileKind::properties;
    if (!has_names || file.document == nullptr) continue;
    const Catalog* catalog = nullptr;
    const auto names = names_by_readers(file, catalog);
    if (!names) continue;
    ++files[file.kind];
    expect_names(file, *names, *catalog);
  }
  EXPECT_GT(files[FileKind::catalog], 15U);
  EXPECT_GT(files[FileKind::script], 50U);
  EXPECT_GT(files[FileKind::properties], 10U);
}

// The files of the project do not have all of them.
TEST(LspNames, OfEachPlaceAreThoseOfTheReaders) {
  const std::string script =
      "situation: {LIGHT: day, LOOK: true}\n"
      "events:\n"
      "- {start: FLY, parameters: {side: left}}\n"
      "- expect: {running: {FLY: any, SEE: LOOK}, stopped: [LAND], active: [FLY_SLOWLY, LOOK]}\n"
      "- expect: {running: {FLY: [FLY_FAST, FLY_SLOWLY]}, active_includes: [LOOK]}\n"
      "- finish: {task: FLY}\n"
      "- {finish: LOOK, cause: time_out}\n"
      "- fault: LOOK\n"
      "- repair: LOOK\n"
      "- situation: {LIGHT: night, FLY_FAST: false}\n"
      "- stop: FLY\n";
  const std::string properties =
      "properties:\n"
      "- {can_start: FLY, when: {stopped: [SEE]}}\n"
      "- {keeps_running: FLY, by: [stop, {start: [FLY]}]}\n"
      "- never: {running: [FLY, LAND]}\n"
      "- always:\n"
      "    any:\n"
      "    - running: {FLY: [FLY_FAST, FLY_SLOWLY]}\n"
      "    - not: {all: [{running: {SEE: any}}, {running: {FLY: FLY_FAST}}, {active: [LOOK]}]}\n"
      "  after: {active_includes: [LOOK]}\n"
      "  until: {available: [LOOK], faulty: [FLY_SLOWLY]}\n"
      "- reachable: {requested: {FLY: 1}, situation: {LIGHT: [day, dusk], LOOK: true}}\n"
      "- {always_possible: {faulty: none}, by: [{stop: [FLY]}, start]}\n";
  const std::string some =
      "  situation: [LIGHT, WIND, LOOK, FLY_FAST]\n  never: [{LIGHT: night, LOOK: false}]\n";
  const std::vector<std::pair<FileKind, std::string>> texts = {
      {FileKind::script, script},
      {FileKind::properties,
       "assume:\n  start: {FLY: [1, 2], SEE: 3}\n  stop: [FLY]\n  faults: {most: 1, of: "
       "[FLY_SLOWLY]}\n"
       "  together: [[LIGHT, WIND]]\n" +
           some + "initially: {LIGHT: day, FLY_FAST: false}\n" + properties},
      {FileKind::properties,
       "assume:\n  start: [FLY]\n  faults: {most: 1, except: [LOOK]}\n" + some + properties},
      {FileKind::properties, "assume:\n  start: all\n  faults: 1\n" + some + properties}};
  const CompiledCatalog compiled = compile(test::robot());
  for (const auto& [kind, text] : texts) {
    Diagnostics diagnostics;
    const test::EditedFile file{"", text, kind, yaml::parse(text, "", diagnostics)};
    ASSERT_NE(file.document, nullptr);
    std::vector<NamePlace> names;
    const bool is_read =
        kind == FileKind::script
            ? read_script(*file.document, compiled, Severity::warning, diagnostics, nullptr, &names)
                  .has_value()
            : read_properties(*file.document, compiled, diagnostics, &names).has_value();
    for (const Diagnostic& finding : diagnostics.all()) {
      if (finding.severity == Severity::error) ADD_FAILURE() << text << finding.message;
    }
    EXPECT_TRUE(is_read);
    EXPECT_GT(names.size(), 15U);
    expect_names(file, names, test::robot());
  }
  Diagnostics ignored;
  const test::EditedFile catalog{"", test::robot_text, FileKind::catalog,
                                 yaml::parse(test::robot_text, "", ignored)};
  expect_names(catalog, understand_catalog(*catalog.document, ignored).names, test::robot());
  EXPECT_EQ(
      lsp::name_kind_at(context_at_mark("never_together: [[A, |B]]"), FileKind::settings, nullptr),
      NameKind::task);
}

}  // namespace
}  // namespace cbc::lsp_language_test
