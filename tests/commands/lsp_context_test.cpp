// Where a cursor is in a text. The scanner is compared with the YAML parser on all catalogs,
// missions and property files of the project.
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"
#include "core/yaml/source.h"
#include "lsp/language/context.h"
#include "support/edited_files.h"

namespace cbc::lsp_context_test {
namespace {

using lsp::Context;
using test::context_at_mark;
using Path = std::vector<std::string>;

/// "behaviors/-/task: X" for a value, "behaviors/-? ta" for a key, "list/-. X" for an item; "!" if
/// it is none of them. The siblings follow in parentheses.
std::string place(const std::string& marked) {
  const Context context = context_at_mark(marked);
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
  EXPECT_TRUE(context_at_mark("{\"a\": [{\"b\": |}]}").is_json);
  EXPECT_FALSE(context_at_mark("{a: [{\"b\": |}]}").is_json);
  EXPECT_FALSE(context_at_mark("a: [{\"b\": |}]").is_json);
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
  EXPECT_EQ(context_at_mark(text + "|\n").list_key, "behaviors");
  EXPECT_EQ(context_at_mark(text + "  |\n").list_key, "requires");
  EXPECT_EQ(context_at_mark(text + "    |\n").list_key, "");
  EXPECT_EQ(place("a:\n  |\n"), "a/?");
  EXPECT_EQ(place("a:\n|\n"), "? (a)");
  EXPECT_EQ(context_at_mark("a:\n|\n").list_key, "a");
  EXPECT_EQ(context_at_mark("a:\nb|\n").list_key, "a");
  EXPECT_EQ(context_at_mark(text + "be|\n").list_key, "behaviors");
  EXPECT_EQ(context_at_mark(text + "  be|\n").list_key, "requires");
  EXPECT_EQ(context_at_mark("a: b\nc|\n").list_key, "");
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
  const Context context = context_at_mark("a: 'b|'\n");
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
  EXPECT_EQ(lsp::context_at(text, text.find('c')).key, "a");
  EXPECT_EQ(lsp::context_at(text, text.find('d')).text, "b: c\n\n- d\n");
  EXPECT_EQ(lsp::context_at(text, text.find('f')).key, "e");
  EXPECT_EQ(lsp::context_at(text, text.find('f')).siblings, Path{"a"});
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
  EXPECT_EQ(context_at_mark("- {start: A, at: 1, parameters: {|}}").outer, start);
  EXPECT_EQ(context_at_mark("- {start: A, at: 1, parameters: {b: |}}").outer, start);
  EXPECT_EQ(context_at_mark("- start: A\n  at: 1\n  parameters:\n    |\n").outer, start);
  EXPECT_EQ(context_at_mark("- start: A\n  at: 1\n  parameters:\n    b: |\n").outer, start);
}

TEST(LspContext, OfHugeTexts) {
  // A quadratic time would not end.
  for (const std::string_view part :
       {"- {behavior: A, task: B, requires: [{task: C}]}\n", "[", "{", "- ", "\"", "'",
        "a: ", "a:\n", "\n", "'\n", "\"\n", "a: \"\n", ": ", ", ", "#", "{\"a\": 'b\n", "|\n",
        "a: >\n", "  x\n"}) {
    std::string text;
    while (text.size() < 1'000'000) text += part;
    for (const std::size_t cursor : {text.size(), text.size() / 2, std::size_t{0}}) {
      EXPECT_LE(lsp::context_at(text, cursor).end, text.size());
    }
  }
}

std::string in_words(const Context& context) {
  std::string text = context.is_key ? "key" : context.is_item ? "item" : "value of " + context.key;
  for (const std::string& step : context.path) text += " / " + step;
  return text + " = " + context.text;
}

/// Compares the context of each scalar with the tree.
class TreeCheck {
 public:
  explicit TreeCheck(const test::EditedFile& file) : file_(file), positions_(file.text) {}

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

  const test::EditedFile& file_;
  PositionMap positions_;
  Path path_;
  std::size_t scalars_ = 0;
};

TEST(LspContext, OfEachScalarOfOurFilesIsThatOfTheParser) {
  std::size_t scalars = 0;
  for (const test::EditedFile& file : test::edited_files()) {
    if (file.document != nullptr) scalars += TreeCheck(file).check();
    if (HasFailure()) FAIL() << file.path;
  }
  EXPECT_GT(scalars, 10'000U);
}

}  // namespace
}  // namespace cbc::lsp_context_test
