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
  EXPECT_EQ(place("a: b\n  - c|\n"), "a: b - c");         // no list
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
  EXPECT_EQ(at("a:\nb|\n").list_key, "a");
  EXPECT_EQ(at(text + "be|\n").list_key, "behaviors");
  EXPECT_EQ(at(text + "  be|\n").list_key, "requires");
  EXPECT_EQ(at("a: b\nc|\n").list_key, "");
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
    while (text.size() < 1'000'000) text += part;
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
      if (is_on_one_line) {
        EXPECT_EQ(context.end, extent.end) << file_.path;
      }
      EXPECT_EQ(context.siblings, expected.siblings) << file_.path << " " << in_words(context);
      Context wanted = expected;
      wanted.text = node.text;
      EXPECT_EQ(in_words(context), in_words(wanted)) << file_.path;
      if (expected.is_key || !is_on_one_line) continue;
      // So far as it would be written if the rest was not there yet.
      const std::string_view so_far = std::string_view(file_.text).substr(0, extent.end);
      EXPECT_EQ(in_words(lsp::context_at(so_far, cursor)), in_words(wanted)) << file_.path;
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
  EXPECT_TRUE(!is_empty || completions.empty());
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

/// Compares the places of names with those that the readers note.
void expect_names(const File& file, const std::vector<NamePlace>& names, const Catalog& catalog) {
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
    expect_names(file, *names, *catalog);
  }
  EXPECT_GT(files[FileKind::catalog], 15U);
  EXPECT_GT(files[FileKind::script], 50U);
  EXPECT_GT(files[FileKind::properties], 10U);
}

// What the language has ---------------------------------------------------------------------------

constexpr const char* robot_text =
    "behaviors:\n"
    "- {behavior: FLY_FAST, task: FLY, suitability: 90, requires: [{task: SEE, "
    "minimum_performance: "
    "50}],\n"
    "   situation: {LIGHT: [day, dusk], WIND: false}, timeout: 4.5, package: wings}\n"
    "- {behavior: FLY_SLOWLY, task: FLY, suitability: 60}\n"
    "- {behavior: LOOK, task: SEE}\n"
    "- {behavior: 'yes', task: 'a: b'}\n"
    "tasks:\n"
    "- {task: FLY, timeout: 30, minimum_performance: 20, parameters: [{parameter: speed, "
    "allowed_values: [0, 30]},\n"
    "   {parameter: side, allowed_values: [left, right]}, {parameter: hard, allowed_values: "
    "boolean}]}\n"
    "- {task: SEE, start_on_request: false, execution_goal: keep_running}\n"
    "- {task: LAND, reactive_start: true, start_on_request: false}\n"
    "exclusivity_constraints:\n"
    "- {mutually_exclusive: [FLY, LAND]}\n"
    "situation:\n"
    "- {variable: LIGHT, values: [day, dusk, night]}\n"
    "- {variable: WIND}\n";

const Catalog& robot() {
  static const Catalog catalog = [] {
    Diagnostics ignored;
    return *read_catalog(robot_text, "robot.yaml", ignored);
  }();
  return catalog;
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
  const CompiledCatalog compiled = compile(robot());
  for (const auto& [kind, text] : texts) {
    Diagnostics diagnostics;
    const File file{"", text, kind, yaml::parse(text, "", diagnostics)};
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
    expect_names(file, names, robot());
  }
  Diagnostics ignored;
  const File catalog{"", robot_text, FileKind::catalog, yaml::parse(robot_text, "", ignored)};
  expect_names(catalog, understand_catalog(*catalog.document, ignored).names, robot());
  EXPECT_EQ(lsp::name_kind_at(at("never_together: [[A, |B]]"), FileKind::settings, nullptr),
            NameKind::task);
}

std::vector<Completion> completions(const std::string& marked, FileKind kind,
                                    const Catalog* catalog = &robot()) {
  return lsp::complete(at(marked), kind, catalog);
}

/// What would be inserted, but for snippets.
std::string offered(const std::string& marked, FileKind kind, const Catalog* catalog = &robot()) {
  std::string text;
  for (const Completion& completion : completions(marked, kind, catalog)) {
    if (completion.is_snippet) continue;
    text += (text.empty() ? "" : "; ") + completion.insert;
  }
  return text;
}

/// The labels of the snippets.
std::set<std::string> snippets(const std::string& marked, FileKind kind) {
  std::set<std::string> labels;
  for (const Completion& completion : completions(marked, kind)) {
    if (completion.is_snippet) labels.insert(completion.label);
  }
  return labels;
}

constexpr auto catalog_kind = FileKind::catalog;
constexpr auto script_kind = FileKind::script;
constexpr auto property_kind = FileKind::properties;

TEST(LspCompletion, OfKeys) {
  EXPECT_EQ(offered("|", catalog_kind),
            "default_values: ; behaviors: ; tasks: ; exclusivity_constraints: ; situation: ");
  EXPECT_EQ(offered("tasks:\n- {task: A}\n|\nbehaviors: []", catalog_kind),
            "default_values: ; exclusivity_constraints: ; situation: ");
  EXPECT_EQ(offered("behaviors:\n- {behavior: A, task: B, |}", catalog_kind),
            "package: ; requires: ; timeout: ; situation: ; suitability: ");
  EXPECT_EQ(offered("behaviors:\n- {behavior: A, ta|: B}", catalog_kind),
            "package; task; tasks; requires; timeout; situation; suitability");
  EXPECT_EQ(offered("behaviors:\n- beh|", catalog_kind),
            "behavior: ; package: ; task: ; tasks: ; requires: ; timeout: ; situation: ; "
            "suitability: ");
  EXPECT_EQ(
      offered("{\"behaviors\": [{\"behavior\": \"A\", \"requires\": [{\"|\"}]}]}", catalog_kind),
      "\"task\": ; \"minimum_performance\": ");
  EXPECT_EQ(offered("- {start: A, |}", script_kind),
            "at: ; wait: ; priority: ; parameters: ; cause: ");
  EXPECT_EQ(offered("events:\n- expect: {|}", script_kind),
            "outcome: ; running: ; stopped: ; active: ; active_includes: ");
  EXPECT_EQ(offered("- expect:\n    |", script_kind),
            "outcome: ; running: ; stopped: ; active: ; active_includes: ");
  EXPECT_EQ(offered("- expect:\n    out|", script_kind),
            "outcome: ; running: ; stopped: ; active: ; active_includes: ");
  EXPECT_EQ(
      offered("properties:\n- {never: {not: {any: [{|}]}}}", property_kind),
      "running: ; stopped: ; active: ; active_includes: ; faulty: ; available: ; requested: ; "
      "situation: ; not: ; any: ; all: ");
  EXPECT_EQ(offered("assume: {faults: {most: 1, |}}", property_kind), "of: ; except: ");
  EXPECT_EQ(offered("|", FileKind::settings),
            "error: ; warn: ; note: ; allow: ; strict: ; never_together: ");
  EXPECT_EQ(offered("|", FileKind::other), "");
  EXPECT_EQ(offered("a: b # |", catalog_kind), "");
}

TEST(LspCompletion, ExplainsKeys) {
  const auto found = completions("behaviors:\n- {|}", catalog_kind);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].kind, Completion::Kind::key);
  EXPECT_EQ(found[0].label, "behavior");
  EXPECT_EQ(found[0].detail, "required");
  EXPECT_TRUE(found[0].documentation.starts_with("The name of the behavior"))
      << found[0].documentation;
  EXPECT_EQ(found[1].detail, "");
}

TEST(LspCompletion, OfWords) {
  EXPECT_EQ(offered("tasks:\n- {task: A, execution_goal: |}", catalog_kind),
            "achieve_goal; keep_running");
  EXPECT_EQ(offered("tasks:\n- {task: A, start_on_request: |}", catalog_kind), "true; false");
  EXPECT_EQ(offered("{\"tasks\": [{\"task\": \"A\", \"execution_goal\": |}]}", catalog_kind),
            "\"achieve_goal\"; \"keep_running\"");
  EXPECT_EQ(offered("{\"tasks\": [{\"task\": \"A\", \"start_on_request\": |}]}", catalog_kind),
            "true; false");
  EXPECT_EQ(
      offered("- {finish: A, cause: |}", script_kind),
      "goal_achieved; time_out; wrong_progress; situation_change; process_failure; interrupted");
  EXPECT_EQ(offered("- expect: {outcome: |}", script_kind), "accepted; rejected; unchanged");
  EXPECT_EQ(offered("properties:\n- {keeps_running: A, by: [|]}", property_kind),
            "start; stop; successes; failures; fault; repair; situation; queue");
  EXPECT_EQ(offered("strict: |", FileKind::settings), "true; false");
  const std::string rules = offered("allow: [|]", FileKind::settings);
  EXPECT_EQ(std::count(rules.begin(), rules.end(), ';') + 1,
            static_cast<std::ptrdiff_t>(all_rules().size()));
}

TEST(LspCompletion, OfNames) {
  const std::string tasks = "FLY; SEE; LAND; \"a: b\"";
  const std::string behaviors = "FLY_FAST; FLY_SLOWLY; LOOK; \"yes\"";
  const auto expect = [](const std::string& marked, FileKind kind, const std::string& expected) {
    std::vector<std::string> names;
    for (const Completion& completion : completions(marked, kind)) {
      if (!completion.is_snippet) names.push_back(completion.insert);
    }
    std::sort(names.begin(), names.end());
    std::vector<std::string> wanted;
    for (std::size_t begin = 0; begin < expected.size();) {
      const std::size_t end = std::min(expected.find("; ", begin), expected.size());
      wanted.push_back(expected.substr(begin, end - begin));
      begin = end + 2;
    }
    std::sort(wanted.begin(), wanted.end());
    EXPECT_EQ(names, wanted) << marked;
  };
  expect("behaviors:\n- {behavior: X, task: |}", catalog_kind, tasks);
  expect("behaviors:\n- {behavior: |, task: A}", catalog_kind, "");
  expect("behaviors:\n- behavior: A\n  requires:\n  - task: F|\n", catalog_kind, tasks);
  expect("behaviors:\n- {behavior: A, tasks: [{task: |}]}", catalog_kind, tasks);
  expect("behaviors:\n- {behavior: A, situation: {|}}", catalog_kind, "LIGHT: ; WIND: ");
  expect("behaviors:\n- {behavior: A, situation: {LIGHT: |}}", catalog_kind, "day; dusk; night");
  expect("behaviors:\n- {behavior: A, situation: {LIGHT: [day, |]}}", catalog_kind,
         "day; dusk; night");
  expect("behaviors:\n- {behavior: A, situation: {WIND: |}}", catalog_kind, "true; false");
  expect("tasks:\n- task: |", catalog_kind, "\"a: b\"");
  expect("exclusivity_constraints:\n- {mutually_exclusive: [FLY, |", catalog_kind, tasks);
  expect("situation:\n- variable: |", catalog_kind, "");
  expect("- start: |", script_kind, tasks);
  expect("events:\n- {stop: |", script_kind, tasks);
  expect("- finish: |", script_kind, behaviors);
  expect("- finish: {task: |}", script_kind, tasks);
  expect("- fault: |", script_kind, behaviors);
  expect("- repair: |", script_kind, behaviors);
  expect("- {situation: {|}}", script_kind,
         "LIGHT: ; WIND: ; FLY_FAST: ; FLY_SLOWLY: ; LOOK: ; \"yes\": ");
  expect("- {situation: {LIGHT: |}}", script_kind, "day; dusk; night");
  expect("situation: {LOOK: |}", script_kind, "true; false");
  expect("- {expect: {running: {|}}}", script_kind, "FLY: ; SEE: ; \"a: b\": ; LAND: ");
  expect("- {expect: {running: {FLY: |}}}", script_kind, "any; FLY_FAST; FLY_SLOWLY");
  expect("- {expect: {running: {FLY: [FLY_FAST, |]}}}", script_kind, "FLY_FAST; FLY_SLOWLY");
  expect("- {expect: {stopped: [|]}}", script_kind, tasks);
  expect("- {expect: {active: [|]}}", script_kind, behaviors);
  expect("assume: {start: [|]}", property_kind, tasks);
  expect("assume: {start: {|}}", property_kind, "FLY: ; SEE: ; \"a: b\": ; LAND: ");
  expect("assume: {start: |}", property_kind, "all");
  expect("assume: {together: [[|]]}", property_kind, "LIGHT; WIND");
  expect("initially: {LIGHT: |}", property_kind, "day; dusk; night");
  expect("properties:\n- can_start: |", property_kind, tasks);
  expect("properties:\n- always: {faulty: |}", property_kind, "none");
  expect("properties:\n- always: {faulty: [|]}", property_kind, behaviors);
  expect("properties:\n- always: {not: {running: {SEE: |}}}", property_kind, "any; LOOK");
  expect("properties:\n- always: {all: [{situation: {LIGHT: |}}]}", property_kind,
         "day; dusk; night");
  expect("never_together: [[|]]", FileKind::settings, tasks);
  EXPECT_EQ(offered("- start: |", script_kind, nullptr), "");
  EXPECT_EQ(offered("[{\"start\": |}]", script_kind), "\"FLY\"; \"SEE\"; \"LAND\"; \"a: b\"");
}

TEST(LspCompletion, OfParameters) {
  EXPECT_EQ(offered("- {start: FLY, parameters: {|}}", script_kind), "speed: ; side: ; hard: ");
  EXPECT_EQ(offered("- start: FLY\n  parameters:\n    side: left\n    |", script_kind),
            "speed: ; hard: ");
  EXPECT_EQ(offered("- {start: FLY, parameters: {side: |}}", script_kind), "left; right");
  EXPECT_EQ(offered("- {start: FLY, parameters: {hard: |}}", script_kind), "true; false");
  EXPECT_EQ(offered("- {start: FLY, parameters: {speed: |}}", script_kind), "");
  EXPECT_EQ(offered("- {start: SEE, parameters: {|}}", script_kind), "");
  EXPECT_EQ(completions("- {start: FLY, parameters: {|}}", script_kind)[0].detail, "[0, 30]");
}

TEST(LspCompletion, NamesAreInsertedAsThey) {
  Diagnostics ignored;
  for (const char* const name :
       {"A",  "a b", "true", "12", "~",  "null", "a: b",     "a #b", "[x]",  "a,b", "- a", "*a",
        "&a", "@a",  "'a'",  "\"", "\\", "<<",   "\xC3\xA4", "\n",   "a\tb", "%a",  "?",   "-"}) {
    Catalog catalog;
    catalog.tasks.emplace_back().name = name;
    for (const std::string text :
         {"- {start: |}\n", "- start: |\n", "- {\"expect\": {stopped: [|]}}\n"}) {
      const auto found = completions(text, script_kind, &catalog);
      ASSERT_FALSE(found.empty());
      std::string written = text;
      written.replace(written.find('|'), 1, found[0].insert);
      const auto document = yaml::parse(written, "", ignored);
      ASSERT_NE(document, nullptr) << written;
      const auto& nodes = document->nodes();
      EXPECT_TRUE(std::any_of(nodes.begin(), nodes.end(), [name](const yaml::Node& node) {
        return node.kind == yaml::Kind::scalar && node.text == name;
      })) << written;
    }
  }
}

TEST(LspCompletion, OffersSnippetsWhereEntriesStand) {
  const std::set<std::string> of_behaviors = {"behavior", "behavior that requires a task"};
  EXPECT_EQ(snippets("behaviors:\n- |", catalog_kind), of_behaviors);
  EXPECT_EQ(snippets("behaviors:\n- be|", catalog_kind), of_behaviors);
  EXPECT_EQ(snippets("behaviors:\n|", catalog_kind), of_behaviors);
  EXPECT_EQ(snippets("behaviors:\n  |", catalog_kind), of_behaviors);
  EXPECT_EQ(snippets("behaviors:\n- {behavior: A}\n|", catalog_kind), of_behaviors);
  EXPECT_EQ(snippets("behaviors:\n- {behavior: A}\nbe|", catalog_kind), of_behaviors);
  EXPECT_EQ(snippets("behaviors: [|]", catalog_kind), of_behaviors);
  EXPECT_EQ(snippets("behaviors:\n- {|}", catalog_kind), std::set<std::string>());
  EXPECT_EQ(snippets("- {start: A}\n|", script_kind), snippets("events:\n- |", script_kind));
  EXPECT_EQ(snippets("- |", script_kind), snippets("events:\n- |", script_kind));
  EXPECT_EQ(snippets("- finish: |", script_kind), std::set<std::string>{"task: TASK"});
}

/// Completed as an editor does if nobody changes the placeholders.
std::string without_placeholders(std::string text) {
  for (std::size_t begin = 0; (begin = text.find("${", begin)) != std::string::npos;) {
    text.erase(text.find('}', begin), 1);
    text.erase(begin, text.find(':', begin) + 1 - begin);
  }
  return text;
}

TEST(LspCompletion, SnippetsAreValid) {
  const std::vector<std::pair<std::string, FileKind>> lists = {
      {"behaviors:\n", catalog_kind},
      {"behaviors: [{behavior: A, task: B}]\ntasks:\n", catalog_kind},
      {"behaviors: [{behavior: A, task: B}]\nexclusivity_constraints:\n", catalog_kind},
      {"behaviors: [{behavior: A, task: B}]\nsituation:\n", catalog_kind},
      {"behaviors:\n- behavior: A\n  task: B\n  requires:\n  ", catalog_kind},
      {"behaviors:\n- behavior: A\n  tasks:\n  ", catalog_kind},
      {"behaviors: [{behavior: A, task: B}]\ntasks:\n- task: B\n  parameters:\n  ", catalog_kind},
      {"events:\n", script_kind},
      {"properties:\n", property_kind}};
  Diagnostics ignored;
  const Catalog catalog = *read_catalog(
      "behaviors:\n- {behavior: BEHAVIOR, task: TASK}\n- {behavior: B, task: OTHER}\nsituation: "
      "[{variable: NAME}]\n",
      "", ignored);
  const CompiledCatalog compiled = compile(catalog);
  std::map<FileKind, std::size_t> checked;
  std::set<std::string> labels;
  for (const auto& [list, kind] : lists) {
    for (const Completion& completion : completions(list + "|\n", kind)) {
      if (!completion.is_snippet || !completion.insert.starts_with("- ")) continue;
      ++checked[kind];
      labels.insert(completion.label);
      const std::string text = list + without_placeholders(completion.insert) + "\n";
      Diagnostics diagnostics;
      const auto document = yaml::parse(text, "", diagnostics);
      ASSERT_NE(document, nullptr) << text;
      if (kind == catalog_kind) {
        EXPECT_TRUE(understand_catalog(*document, diagnostics).has_all_behaviors) << text;
      } else if (kind == script_kind) {
        EXPECT_TRUE(read_script(*document, compiled, Severity::error, diagnostics)) << text;
      } else {
        EXPECT_TRUE(read_properties(*document, compiled, diagnostics)) << text;
      }
      for (const Diagnostic& finding : diagnostics.all()) {
        const bool is_known = finding.rule == rule::undefined_task.name;
        EXPECT_TRUE(is_known || finding.severity != Severity::error) << text << finding.message;
      }
    }
  }
  EXPECT_GE(checked[catalog_kind], 11U);
  for (const std::string_view verb : words_of<Verb>())
    EXPECT_TRUE(labels.contains(std::string(verb)));
  EXPECT_TRUE(labels.contains("expect"));
  for (const std::string_view kind : property_kinds)
    EXPECT_TRUE(labels.contains(std::string(kind)));
}

TEST(LspCompletion, SnippetsOfJsonAreJson) {
  const auto found =
      completions("{\"behaviors\": [{\"behavior\": \"A\", \"task\": \"B\"}, |]}", catalog_kind);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].insert,
            "{\"behavior\": \"${1:NAME}\", \"task\": \"${2:TASK}\", \"suitability\": ${3:100}}");
}

std::string hover(const std::string& marked, FileKind kind, const Catalog* catalog = &robot()) {
  return lsp::describe(at(marked), kind, catalog);
}

TEST(LspHover, OfNames) {
  EXPECT_EQ(hover("- start: F|LY", script_kind),
            "task **FLY**\n\n"
            "- performed by: FLY\\_FAST \\(90 %\\), FLY\\_SLOWLY \\(60 %\\)\n"
            "- excludes: LAND\n"
            "- timeout: 30 s\n"
            "- minimum performance: 20 %\n"
            "- parameters: speed \\[0, 30\\], side \\[left, right\\], hard boolean\n");
  EXPECT_EQ(hover("tasks:\n- task: |SEE", catalog_kind),
            "task **SEE**\n\n"
            "- performed by: LOOK \\(100 %\\)\n"
            "- required by: FLY\\_FAST \\(at least 50 %\\)\n"
            "- also starts when a behavior requires it\n"
            "- keeps running\n");
  EXPECT_EQ(hover("- fault: FLY_FAST|", script_kind),
            "behavior **FLY\\_FAST**\n\n"
            "- performs: FLY \\(90 %\\)\n"
            "- requires: SEE \\(at least 50 %\\)\n"
            "- fits in: LIGHT\\: day, dusk, not WIND\n"
            "- timeout: 4\\.5 s\n"
            "- package: wings\n");
  EXPECT_EQ(hover("situation: {L|IGHT: day}", script_kind),
            "situation variable **LIGHT**\n\n"
            "- values: day, dusk, night\n"
            "- at first: day\n"
            "- behaviors that depend on it: FLY\\_FAST \\(LIGHT\\: day, dusk\\)\n");
  EXPECT_EQ(hover("situation: {LIGHT: d|ay}", script_kind),
            hover("situation: {L|IGHT: day}", script_kind));
  EXPECT_EQ(hover("- start: F|L", script_kind), "the catalog has no task FL\n");
  EXPECT_EQ(hover("- start: F|LY", script_kind, nullptr), "");
}

TEST(LspHover, OfKeysAndWords) {
  const std::string priority = hover("- {start: A, prio|rity: 1}", script_kind);
  EXPECT_TRUE(priority.starts_with("key **priority**\n\nThe priority of a start")) << priority;
  EXPECT_EQ(hover("- {start: A, priority: 1|}", script_kind), priority);
  EXPECT_TRUE(hover("tasks:\n- {task: A, cat|egory: recurrent}", catalog_kind)
                  .starts_with("key **category**\n\nAn older name of execution"));
  EXPECT_EQ(hover("- {start: A, foo|: 1}", script_kind), "");
  EXPECT_EQ(hover("a: # com|ment", script_kind), "");
  EXPECT_EQ(hover("allow: [dead-ta|sk]", FileKind::settings), lsp::describe_rule("dead-task"));
}

TEST(LspHover, OfRules) {
  for (const Rule& rule : all_rules()) {
    const std::string text = lsp::describe_rule(rule.name);
    EXPECT_NE(text.find("```yaml\n" + std::string(rule.example) + "```"), std::string::npos);
    EXPECT_NE(text.find("**" + std::string(rule.name) + "**"), std::string::npos);
  }
  EXPECT_EQ(lsp::describe_rule("no-such-rule"), "");
}

TEST(LspHover, EscapesMarkdown) {
  Catalog catalog;
  catalog.tasks.emplace_back().name = "<b>*a*\n# b";
  const std::string text = hover("- start: \"<b>*a*\\n# |b\"", script_kind, &catalog);
  EXPECT_EQ(text.find("<b>"), std::string::npos);
  EXPECT_EQ(text.find("\n#"), std::string::npos);
  EXPECT_NE(text.find("\\*a\\*"), std::string::npos) << text;
}

}  // namespace
}  // namespace cbc::lsp_language_test
