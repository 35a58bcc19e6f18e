// What an editor is told about a place in a text: where it is, what may be written there, what
// there is to say about it. The scanner is compared with the YAML parser, and the places of names
// with the readers of the language, on all catalogs, missions and property files of the project.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "cbc/event.h"
#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/files/recognition.h"
#include "core/property/property_reader.h"
#include "core/script/reader.h"
#include "core/yaml/document.h"
#include "core/yaml/source.h"
#include "lsp/language/completion.h"
#include "lsp/language/context.h"
#include "lsp/language/hover.h"
#include "lsp/language/places.h"
#include "lsp/language/schema.h"
#include "runtime/base/text.h"
#include "runtime/coordinator/record.h"
#include "support/read_file.h"

namespace cbc::lsp_language_test {
namespace {

using cli::FileKind;
using lsp::Completion;
using lsp::Context;
using Path = std::vector<std::string>;

/// The place of the character '|', which is no part of the text.
Context at(std::string text) {
  const std::size_t cursor = text.find('|');
  text.erase(cursor, 1);
  return lsp::context_at(text, cursor);
}

/// "behaviors/-/task: X" for a value, "behaviors/-? ta" for a key, "list/-. X" for an item; "!" if
/// it is none of them. The siblings follow in parentheses.
std::string place(const std::string& marked) {
  const Context context = at(marked);
  std::string text;
  for (const std::string& step : context.path) text += (step.empty() ? "-" : step) + "/";
  if (!context.is_key && !context.is_item && context.key.empty()) return text + "!";
  text += context.is_key ? "?" : context.is_item ? "." : context.key + ":";
  if (!context.text.empty()) text += " " + context.text;
  if (context.siblings.empty()) return text;
  text += " (";
  for (const std::string& sibling : context.siblings) {
    text += (text.ends_with('(') ? "" : " ") + sibling;
  }
  return text + ")";
}

TEST(LspContext, InBraces) {
  EXPECT_EQ(place("behaviors:\n- {behavior: X, task: |}"), "behaviors/-/task: (behavior)");
  EXPECT_EQ(place("behaviors:\n- {behavior: X, task: |"), "behaviors/-/task: (behavior)");
  EXPECT_EQ(place("behaviors:\n- {behavior: X|, task: Y}"), "behaviors/-/behavior: X (task)");
  EXPECT_EQ(place("behaviors:\n- {|behavior: X, task: Y}"), "behaviors/-/? behavior (task)");
  EXPECT_EQ(place("behaviors:\n- {behavior: X,| task: Y}"), "behaviors/-/? (behavior task)");
  EXPECT_EQ(place("behaviors:\n- {behavior: X, | task: Y}"), "behaviors/-/? (behavior task)");
  EXPECT_EQ(place("behaviors:\n- {behavior: X, ta|}"), "behaviors/-/? ta (behavior)");
  EXPECT_EQ(place("behaviors:\n- {behavior: X, requires: [{ta|"), "behaviors/-/requires/-/? ta");
  EXPECT_EQ(place("behaviors:\n- {behavior: X, requires: [{task: A}, {|}]}"),
            "behaviors/-/requires/-/?");
  EXPECT_EQ(place("a: {b: c |}"), "!");
  EXPECT_EQ(place("a: {b: c}|"), "!");
  EXPECT_EQ(place("a: {b:|}"), "!");
  EXPECT_EQ(place("a: [|]"), "a/.");
  EXPECT_EQ(place("a: [b, |]"), "a/.");
  EXPECT_EQ(place("a: [b, c|]"), "a/. c");
  EXPECT_EQ(place("a: [[b], [c|, d]]"), "a/-/. c");
  EXPECT_EQ(place("a: [b: |, c]"), "a/-/b:");
  EXPECT_EQ(place("a: [b: x, c|]"), "a/. c");
}

TEST(LspContext, InBracesOverSeveralLines) {
  EXPECT_EQ(place("a:\n- {b: c,\n   d|: e,\n   f: g}\n- {h: i}"), "a/-/? d (b f)");
  EXPECT_EQ(place("a:\n- {b: c,\n   |\n   f: g}\n- {h: i}"), "a/-/? (b f)");
  EXPECT_EQ(place("a: [\n  b,\n  c|\n]\nd: e"), "a/. c");
  EXPECT_EQ(place("a: {b: long\n  word|s, c: d}"), "a/b: long words (c)");
  // Brackets that are left open end with the block.
  EXPECT_EQ(place("a:\n- {b: c, d: \n- {e: |f}\n- {g: h}"), "a/-/e: f");
  EXPECT_EQ(place("a:\n- {b: c, d: |\n- {e: f}"), "a/-/d: (b)");
  EXPECT_EQ(place("a:\n- b: [{c\n  d: |e\n"), "a/-/d: e (b)");
  EXPECT_EQ(place("a: {b: [c\nd: |e\n"), "d: e (a)");
  // A comma may be missing.
  EXPECT_EQ(place("{\"a\": \"b\"\n \"c\": \"|d\"}"), "c: d (a)");
}

TEST(LspContext, InJson) {
  EXPECT_EQ(place("{\"a\": [{\"b\": \"c\", \"d\": |}]}"), "a/-/d: (b)");
  EXPECT_EQ(place("{\"a\":[{\"b\":\"c\",\"d\":\"|\"}]}"), "a/-/d: (b)");
  EXPECT_EQ(place("{\"a\":[{\"b\":\"c\",\"d|\":1}]}"), "a/-/? d (b)");
  EXPECT_EQ(place("{\"a\": [{\"b|\n  \"c\": 1}]}"), "a/-/? b (c)");
  EXPECT_EQ(place("[{\"start\": \"A|\"}]"), "-/start: A");
  EXPECT_TRUE(at("{\"a\": [{\"b\": |}]}").is_json);
  EXPECT_FALSE(at("{a: [{\"b\": |}]}").is_json);
  EXPECT_FALSE(at("a: [{\"b\": |}]").is_json);
}

TEST(LspContext, InBlocks) {
  EXPECT_EQ(place("|"), "?");
  EXPECT_EQ(place("beh|"), "? beh");
  EXPECT_EQ(place("beh|\n\ntasks:\n- task: A\n"), "? beh (tasks)");
  EXPECT_EQ(place("tasks:\n- task: A\nbeh|\n"), "? beh (tasks)");
  EXPECT_EQ(place("a|: b\nc: d\n"), "? a (c)");
  EXPECT_EQ(place("a: |\nc: d\n"), "a: (c)");
  EXPECT_EQ(place("a: b|\nc: d\n"), "a: b (c)");
  EXPECT_EQ(place("a: b c|\n"), "a: b c");
  EXPECT_EQ(place("a: b |\n"), "!");
  EXPECT_EQ(place("a:|\n"), "!");
  EXPECT_EQ(place("- |"), ".");
  EXPECT_EQ(place("- sta|"), ". sta");
  EXPECT_EQ(place("- start: DRI|"), "-/start: DRI");
  EXPECT_EQ(place("- start: DRI\n  |"), "-/? (start)");
  EXPECT_EQ(place("- start: DRI\n  pri|"), "-/? pri (start)");
  EXPECT_EQ(place("- start: DRI\n  pri|\n- stop: A\n"), "-/? pri (start)");
  EXPECT_EQ(place("- start: DRI\n  pri|ority: 1\n- stop: A\n"), "-/? priority (start)");
  EXPECT_EQ(place("- - a\n  - b|\n"), "-/. b");
  EXPECT_EQ(place("- - k: |a\n    l: b\n"), "-/-/k: a (l)");
  EXPECT_EQ(place("a:\n- b\n- |c\nd: e\n"), "a/. c");
  EXPECT_EQ(place("a:\n  - b\n  - |\nd: e\n"), "a/.");
  EXPECT_EQ(place("a:\n  b:\n    c: |\n  d: e\n"), "a/b/c:");
  EXPECT_EQ(place("a:\n  b|:\n    c: x\n  d: e\n"), "a/? b (d)");
  EXPECT_EQ(place("a:\n  |b\n"), "a: b");
  EXPECT_EQ(place("a:\n  b\n  c|\nd: e\n"), "a: b c (d)");
  EXPECT_EQ(place("- a: b\n    c: |d\n"), "-/c: d (a)");  // at a wrong column
}

TEST(LspContext, OnEmptyLines) {
  const std::string text = "behaviors:\n- behavior: A\n  requires:\n  - task: B\n";
  EXPECT_EQ(place(text + "|\ntasks:\n"), "? (behaviors tasks)");
  EXPECT_EQ(place(text + "  |\ntasks:\n"), "behaviors/-/? (behavior requires)");
  EXPECT_EQ(place(text + "    |\ntasks:\n"), "behaviors/-/requires/-/? (task)");
  EXPECT_EQ(place(text + "      |\ntasks:\n"), "behaviors/-/requires/-/? (task)");
  EXPECT_EQ(at(text + "|\n").list_key, "behaviors");
  EXPECT_EQ(at(text + "  |\n").list_key, "requires");
  EXPECT_EQ(at(text + "    |\n").list_key, "");
  EXPECT_EQ(place("a:\n  |\n"), "a/?");
  EXPECT_EQ(place("a:\n|\n"), "? (a)");
  EXPECT_EQ(at("a:\n|\n").list_key, "a");
  EXPECT_EQ(place("-\n  |\n"), "-/?");
  EXPECT_EQ(place("a:\n  - b\n  |\n"), "a/?");
  EXPECT_EQ(place("a: b\n\n|\nc: d"), "? (a c)");
}

TEST(LspContext, InQuotes) {
  EXPECT_EQ(place("- start: \"DRI|\n- stop: \"A\"\n"), "-/start: DRI");
  EXPECT_EQ(place("- start: \"DRI\n- stop: \"A|\"\n"), "-/stop: A");
  EXPECT_EQ(place("a: 'it''s|'\n"), "a: it's");
  EXPECT_EQ(place("a: \"\\x41|\"\n"), "a: A");
  EXPECT_EQ(place("'a b': c|\n"), "a b: c");
  EXPECT_EQ(place("a: \"b\n  c|\"\nd: e"), "a: b c (d)");
  EXPECT_EQ(place("a: \"b # c|\"\n"), "a: b # c");
  const Context context = at("a: 'b|'\n");
  EXPECT_EQ(context.begin, 3U);
  EXPECT_EQ(context.end, 6U);
}

TEST(LspContext, InComments) {
  EXPECT_EQ(place("# a|\nb: c\n"), "!");
  EXPECT_EQ(place("a: # b|\n"), "!");
  EXPECT_EQ(place("a: b # c|\n"), "!");
  EXPECT_EQ(place("a: {b: c, # d|\n  e: f}\n"), "!");
  EXPECT_EQ(place("a: [ # d|"), "!");
  EXPECT_EQ(place("a: {b: c, # d\n  e: |f}\n"), "a/e: f (b)");
  EXPECT_EQ(place("a:\n# b\n- c|\n"), "a/. c");
  EXPECT_EQ(place("a: b#c|\n"), "a: b#c");
}

TEST(LspContext, InBlockScalars) {
  const std::string text = "a: |\n  b: c\n\n  - d\ne: f\n";
  EXPECT_EQ(lsp::context_at(text, text.find("c")).key, "a");
  EXPECT_EQ(lsp::context_at(text, text.find("d")).text, "b: c\n\n- d\n");
  EXPECT_EQ(lsp::context_at(text, text.find("f")).key, "e");
  EXPECT_EQ(lsp::context_at(text, text.find("f")).siblings, Path{"a"});
}

TEST(LspContext, WithOtherBytes) {
  EXPECT_EQ(place("\xEF\xBB\xBF|"), "?");
  EXPECT_EQ(place("\xEF\xBB\xBF"
                  "a: |\r\nb: c\r\n"),
            "a: (b)");
  EXPECT_EQ(place("\xEF\xBB\xBF"
                  "a: b\r\n|\r\nc: d\r\n"),
            "? (a c)");
  EXPECT_EQ(place("a:\r\n- {b: c, d|\r\n- {e: f}\r\n"), "a/-/? d (b)");
  EXPECT_EQ(place("a:\t|b\n"), "a: b");
  EXPECT_EQ(place("\xC3\xA4: \xF0\x9F\x98\x80|\n"), "\xC3\xA4: \xF0\x9F\x98\x80");
  EXPECT_EQ(place("a: &x !!str b|\n"), "a: b");
  EXPECT_EQ(place("a: b\n---\nc: |d\ne: f\n"), "c: d (e)");
  EXPECT_EQ(place("%YAML 1.2\n---\nc: |d\n"), "c: d");
}

TEST(LspContext, KnowsTheOuterMapping) {
  using Values = std::vector<std::pair<std::string, std::string>>;
  const Values start = {{"start", "A"}, {"at", "1"}};
  EXPECT_EQ(at("- {start: A, at: 1, parameters: {|}}").outer, start);
  EXPECT_EQ(at("- {start: A, at: 1, parameters: {b: |}}").outer, start);
  EXPECT_EQ(at("- start: A\n  at: 1\n  parameters:\n    |\n").outer, start);
  EXPECT_EQ(at("- start: A\n  at: 1\n  parameters:\n    b: |\n").outer, start);
}

TEST(LspContext, OfHugeTexts) {
  const auto begin = std::chrono::steady_clock::now();
  for (const std::string_view part :
       {"- {behavior: A, task: B, requires: [{task: C}]}\n", "[", "{", "- ", "\"", "'",
        "a: ", "a:\n", "\n", "'\n", "\"\n", "a: \"\n", ": ", ", ", "#", "{\"a\": 'b\n", "|\n",
        "a: >\n", "  x\n"}) {
    std::string text;
    while (text.size() < 3'000'000) text += part;
    (void)lsp::context_at(text, text.size());
    (void)lsp::context_at(text, text.size() / 2);
    (void)lsp::context_at(text, 0);
  }
  // Far more than it takes, and far less than a quadratic time.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::minutes(1));
}

// The corpus --------------------------------------------------------------------------------------

struct File {
  std::string path;
  std::string text;
  FileKind kind = FileKind::other;
  std::unique_ptr<const yaml::Document> document;
};

/// The YAML files of the project that people write.
const std::vector<File>& corpus() {
  static const std::vector<File> files = [] {
    std::vector<File> found;
    for (const char* const folder : {"/catalogs", "/docs", "/src/init/files"}) {
      for (const auto& entry :
           std::filesystem::recursive_directory_iterator(CBC_SOURCE_DIR + std::string(folder))) {
        if (entry.path().extension() != ".yaml") continue;
        File file{entry.path(), test::read_file(entry.path()), FileKind::other, nullptr};
        Diagnostics ignored;
        file.document = yaml::parse(file.text, file.path, ignored);
        file.kind = cli::recognize(file.path, file.text, file.document.get()).kind;
        found.push_back(std::move(file));
      }
    }
    std::sort(found.begin(), found.end(),
              [](const File& a, const File& b) { return a.path < b.path; });
    return found;
  }();
  return files;
}

std::string in_words(const Context& context) {
  std::string text = context.is_key ? "key" : context.is_item ? "item" : "value of " + context.key;
  for (const std::string& step : context.path) text += " / " + step;
  return text + " = " + context.text;
}

/// Compares the context of each scalar with the tree.
class TreeCheck {
 public:
  explicit TreeCheck(const File& file) : file_(file), positions_(file.text) {}

  std::size_t check() {
    visit(file_.document->root());
    return scalars_;
  }

 private:
  void visit(const yaml::Node& node) {
    Context context;
    context.path = path_;
    if (node.kind == yaml::Kind::sequence) {
      for (const yaml::Node* item : node.items) {
        context.is_item = true;
        expect(*item, context);
        path_.emplace_back();
        visit(*item);
        path_.pop_back();
      }
    }
    for (const auto& [key, value] : node.entries) {
      context.siblings.clear();
      for (const auto& other : node.entries) {
        if (other.first != key) context.siblings.push_back(other.first->text);
      }
      context.is_key = true;
      context.key.clear();
      expect(*key, context);
      context.is_key = false;
      context.key = key->text;
      expect(*value, context);
      path_.push_back(key->text);
      visit(*value);
      path_.pop_back();
    }
  }

  void expect(const yaml::Node& node, const Context& expected) {
    if (node.kind != yaml::Kind::scalar || node.shared) return;
    ++scalars_;
    const std::size_t begin =
        yaml::skip_properties(file_.text, positions_.offset(node.range.begin));
    const yaml::ScalarExtent extent = yaml::extent_of_scalar(file_.text, begin, node.text);
    for (const std::size_t cursor : {extent.begin, extent.end}) {
      Context context = lsp::context_at(file_.text, cursor);
      EXPECT_EQ(context.begin, extent.begin) << file_.path;
      const bool is_on_one_line = node.text.find(' ') == std::string::npos;
      if (is_on_one_line) EXPECT_EQ(context.end, extent.end) << file_.path;
      EXPECT_EQ(context.siblings, expected.siblings) << file_.path << " " << in_words(context);
      Context wanted = expected;
      wanted.text = node.text;
      EXPECT_EQ(in_words(context), in_words(wanted)) << file_.path;
    }
  }

  const File& file_;
  PositionMap positions_;
  Path path_;
  std::size_t scalars_ = 0;
};

TEST(LspContext, OfEachScalarOfOurFilesIsThatOfTheParser) {
  std::size_t scalars = 0;
  for (const File& file : corpus()) {
    if (file.document != nullptr) scalars += TreeCheck(file).check();
    if (HasFailure()) FAIL() << file.path;
  }
  EXPECT_GT(scalars, 10'000U);
}

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
  if (is_empty) EXPECT_TRUE(completions.empty());
  for (const Completion& completion : completions) EXPECT_FALSE(completion.insert.empty());
  (void)lsp::describe(context, kind, catalog);
  (void)lsp::name_kind_at(context, kind, catalog);
}

std::string folder_of(const std::string& path) { return path.substr(0, path.rfind('/')); }

/// Small files of each kind, for tests that ask at each byte.
std::vector<const File*> small_files(std::size_t most) {
  std::vector<const File*> files;
  for (const File& file : corpus()) {
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
  for (const File& file : corpus()) {
    for (std::size_t size = 0; size <= file.text.size(); ++size) {
      const Context context = lsp::context_at(std::string_view(file.text).substr(0, size), size);
      ASSERT_LE(context.begin, context.end);
      ASSERT_LE(context.end, size);
      if (file.text.size() > 4000) size += 16;
    }
  }
  const Catalog catalog = catalog_at(std::string(quadrotor_path));
  for (const File* const file : small_files(700)) {
    for (std::size_t size = 0; size <= file->text.size(); size += 3) {
      ask(file->text.substr(0, size), size, file->kind, &catalog);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(LspLanguage, TakesRandomEdits) {
  const Catalog catalog = catalog_at(std::string(quadrotor_path));
  const std::vector<const File*> files = small_files(2000);
  constexpr std::string_view pieces[] = {"{",  "}",    "[",     "]",  ",",      ": ",          ":",
                                         "- ", "\n",   "\"",    "'",  "#",      "\r",          "\t",
                                         "|",  ">",    "  ",    "*",  "&a ",    "!t ",         "\\",
                                         std::string_view("\0", 1), "\xFF", "---\n", "? ", "task: ", "\xEF\xBB\xBF"};
  std::mt19937 random(42);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same in each run
  const auto below = [&random](std::size_t end) { return end == 0 ? 0 : random() % end; };
  for (int round = 0; round < 5000; ++round) {
    const File& file = *files[below(files.size())];
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
std::optional<std::vector<NamePlace>> names_by_readers(const File& file, const Catalog*& catalog) {
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

TEST(LspNames, OfOurFilesAreThoseOfTheReaders) {
  std::map<FileKind, std::size_t> files;
  for (const File& file : corpus()) {
    const bool has_names = file.kind == FileKind::catalog || file.kind == FileKind::script ||
                           file.kind == FileKind::properties;
    if (!has_names || file.document == nullptr) continue;
    const Catalog* catalog = nullptr;
    const auto names = names_by_readers(file, catalog);
    if (!names) continue;
    ++files[file.kind];
    NameMap expected = offsets_of(*names, file.text);
    const PositionMap positions(file.text);
    NameMap found;
    for (const yaml::Node& node : file.document->nodes()) {
      if (node.kind != yaml::Kind::scalar || node.shared) continue;
      const std::size_t begin =
          yaml::skip_properties(file.text, positions.offset(node.range.begin));
      const Context context = lsp::context_at(file.text, begin);
      const auto kind = lsp::name_kind_at(context, file.kind, catalog);
      if (kind) found.emplace(begin, *kind);
    }
    EXPECT_EQ(found, expected) << file.path;
  }
  EXPECT_GT(files[FileKind::catalog], 15U);
  EXPECT_GT(files[FileKind::script], 50U);
  EXPECT_GT(files[FileKind::properties], 10U);
}

}  // namespace
}  // namespace cbc::lsp_language_test
