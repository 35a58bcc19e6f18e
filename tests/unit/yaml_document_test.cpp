#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "core/yaml/document.h"
#include "unit/findings.h"

namespace cbc::yaml::yaml_document_test {
namespace {

// A tree as text: "ok" or what was found instead of it. Plain scalars stand as they are, others in
// quotes; each one is followed by its range.
std::string show(const Node& node, bool ranges) {
  std::string text;
  switch (node.kind) {
    case Kind::null:
      text = "~";
      break;
    case Kind::scalar:
      text = node.plain ? node.text : "\"" + node.text + "\"";
      break;
    case Kind::sequence:
      for (const Node* item : node.items) {
        text += (text.empty() ? "" : ", ") + show(*item, ranges);
      }
      text = "[" + text + "]";
      break;
    case Kind::mapping:
      for (const auto& [key, value] : node.entries) {
        text += (text.empty() ? "" : ", ") + show(*key, ranges) + ": " + show(*value, ranges);
      }
      text = "{" + text + "}";
      break;
  }
  return ranges ? text + "@" + cbc::show(node.range) : text;
}

std::string read(std::string_view text, bool ranges) {
  Diagnostics diagnostics;
  const auto document = parse(text, "a.yaml", diagnostics);
  if (document == nullptr) return cbc::show(diagnostics);
  EXPECT_EQ(diagnostics.all().size(), 0U);
  EXPECT_EQ(document->file(), "a.yaml");
  return show(document->root(), ranges);
}

std::string tree(std::string_view text) { return read(text, false); }
std::string tree_with_ranges(std::string_view text) { return read(text, true); }

std::string syntax_error(const std::string& range, const std::string& message) {
  return range + " error yaml-syntax: " + message + "\n";
}

std::string repeat(std::string_view part, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) text += part;
  return text;
}

// The texts of the nodes that are shared, each once, in the order of the file.
std::string shared(std::string_view text) {
  Diagnostics diagnostics;
  const auto document = parse(text, "a.yaml", diagnostics);
  if (document == nullptr) return cbc::show(diagnostics);
  std::map<Range, std::string> found;
  std::vector<const Node*> open{&document->root()};
  while (!open.empty()) {
    const Node* node = open.back();
    open.pop_back();
    if (node->shared) found[node->range] += show(*node, false) + "; ";
    open.insert(open.end(), node->items.begin(), node->items.end());
    for (const auto& [key, value] : node->entries) {
      open.push_back(key);
      open.push_back(value);
    }
  }
  std::string result;
  for (const auto& [range, texts] : found) result += texts;
  return result;
}

TEST(YamlDocument, MarksWhatAliasesAndMergesShare) {
  EXPECT_EQ(shared("a: &x 1\nb: 2\n"), "");
  EXPECT_EQ(shared("a: &x 1\nb: *x\n"), "1; 1; ");
  EXPECT_EQ(shared("[&x [a, {b: c}], d, *x]"),
            "[a, {b: c}]; [a, {b: c}]; a; a; {b: c}; {b: c}; b; b; c; c; ");
  EXPECT_EQ(shared("&k a: 1\nb: *k\n"), "a; a; ");
  // Also what hides a merged key, and what is merged.
  EXPECT_EQ(shared("- &m {a: 1}\n- {b: 2, <<: *m}\n- c\n"),
            "{a: 1}; a; a; 1; 1; {b: 2, a: 1}; b; 2; ");
}

// Shape ---------------------------------------------------------------------------------------

TEST(YamlDocument, ReadsBlocksFlowsAndJson) {
  EXPECT_EQ(tree("a: 1\nb:\n- x\n- y: z\n"), "{a: 1, b: [x, {y: z}]}");
  EXPECT_EQ(tree("{a: [1, 2], b: {c: d}}"), "{a: [1, 2], b: {c: d}}");
  EXPECT_EQ(tree("{\"a\":[1,true,null,\"x\"],\"b\":{}}"),
            "{\"a\": [1, true, ~, \"x\"], \"b\": {}}");
  EXPECT_EQ(tree("just text"), "just text");
  EXPECT_EQ(tree("# comment\n---\na: 1\n...\n# the end\n"), "{a: 1}");
}

TEST(YamlDocument, TellsPlainFromQuoted) {
  EXPECT_EQ(tree("[1, '1', \"1\", ! 1, !!str 1, !!int \"1\", !!bool yes, !!float 1]"),
            "[1, \"1\", \"1\", \"1\", \"1\", 1, yes, 1]");
  EXPECT_EQ(tree("a: |\n  x\n  y\n"), "{a: \"x\ny\n\"}");
  EXPECT_EQ(tree("a: x\n  y\n"), "{a: x y}");
}

TEST(YamlDocument, ReadsNulls) {
  EXPECT_EQ(tree("[~, null, Null, NULL, !!null ~, '', 'null']"), "[~, ~, ~, ~, ~, \"\", \"null\"]");
  EXPECT_EQ(tree("a:\nb: ~\nc: !!str\n"), "{a: ~, b: ~, c: \"\"}");
  EXPECT_EQ(tree("-\n- ~\n-\n"), "[~, ~, ~]");
}

TEST(YamlDocument, AnEmptyTextIsNull) {
  for (const std::string_view text : {"", "\n", "# nothing\n", "---\n", "...\n", "\xEF\xBB\xBF"}) {
    EXPECT_EQ(tree(text), "~") << text;
  }
}

TEST(YamlDocument, KeepsDuplicateKeys) { EXPECT_EQ(tree("a: 1\na: 2\n"), "{a: 1, a: 2}"); }

TEST(YamlDocument, FindsTheFirstValueThatIsNotNull) {
  Diagnostics diagnostics;
  const auto document = parse("a: 1\na: 2\nb: ~\n", "a.yaml", diagnostics);
  ASSERT_NE(document, nullptr);
  ASSERT_NE(document->root().find("a"), nullptr);
  EXPECT_EQ(document->root().find("a")->text, "1");
  EXPECT_EQ(document->root().find("b"), nullptr);
  EXPECT_EQ(document->root().find("c"), nullptr);
}

TEST(YamlDocument, ReadsAliases) {
  EXPECT_EQ(tree("a: &x [1, 2]\nb: *x\n"), "{a: [1, 2], b: [1, 2]}");
  EXPECT_EQ(tree("- &x 1\n- *x\n- &x 2\n- *x\n"), "[1, 1, 2, 2]");
  EXPECT_EQ(tree("- &x ~\n- *x\n"), "[~, ~]");
  EXPECT_EQ(tree("&x a: 1\nb: *x\n"), "{a: 1, b: a}");
}

TEST(YamlDocument, MergesMappings) {
  const std::string base = "base: &x {a: 1, b: 2}\n";
  EXPECT_EQ(tree(base + "c: {<<: *x, d: 3}\n"), "{base: {a: 1, b: 2}, c: {a: 1, b: 2, d: 3}}");
  // What the mapping says itself counts, wherever it stands.
  EXPECT_EQ(tree(base + "c: {b: 4, <<: *x, a: 3}\n"), "{base: {a: 1, b: 2}, c: {b: 4, a: 3}}");
  // Of several the first.
  EXPECT_EQ(tree("c: {<<: [{a: 1}, {a: 2, b: 3}]}"), "{c: {a: 1, b: 3}}");
  // A key in quotes is an ordinary one.
  EXPECT_EQ(tree("{'<<': 1}"), "{\"<<\": 1}");
}

// Places --------------------------------------------------------------------------------------

TEST(YamlDocument, GivesPlaces) {
  EXPECT_EQ(tree_with_ranges("key: value"), "{key@1:1-4: value@1:6-11}@1:1-2");
  EXPECT_EQ(tree_with_ranges("a:\n  - b\n  - [c]\n"),
            "{a@1:1-2: [b@2:5-6, [c@3:6-7]@3:5-6]@2:3-4}@1:1-2");
  EXPECT_EQ(tree_with_ranges("k: \"a \\\" b\" # c"), "{k@1:1-2: \"a \" b\"@1:4-12}@1:1-2");
  EXPECT_EQ(tree_with_ranges("k: 'it''s'"), "{k@1:1-2: \"it's\"@1:4-11}@1:1-2");
}

TEST(YamlDocument, CountsCharactersNotBytes) {
  EXPECT_EQ(tree_with_ranges("{é: 日本, b: c}"),
            "{é@1:2-3: 日本@1:5-7, b@1:9-10: c@1:12-13}@1:1-2");
}

TEST(YamlDocument, CountsNoByteOrderMarkAndNoCarriageReturn) {
  EXPECT_EQ(tree_with_ranges("\xEF\xBB\xBF"
                             "a: b\r\nc: d\r\n"),
            "{a@1:1-2: b@1:4-5, c@2:1-2: d@2:4-5}@1:1-2");
}

TEST(YamlDocument, PlacesOfScalarsOverSeveralLines) {
  EXPECT_EQ(tree_with_ranges("k: one\n  two\n"), "{k@1:1-2: one two@1:4-7}@1:1-2");
  EXPECT_EQ(tree_with_ranges("k: \"one\n  two\"\n"), "{k@1:1-2: \"one two\"@1:4-2:7}@1:1-2");
  EXPECT_EQ(tree_with_ranges("k: >-\n  one\n  two\n"), "{k@1:1-2: \"one two\"@1:4-5}@1:1-2");
}

TEST(YamlDocument, PlacesOfScalarsWithProperties) {
  EXPECT_EQ(tree_with_ranges("k: !!str &a x\n"), "{k@1:1-2: \"x\"@1:13-14}@1:1-2");
  EXPECT_EQ(tree_with_ranges("k: !<tag:yaml.org,2002:str> x\n"), "{k@1:1-2: \"x\"@1:29-30}@1:1-2");
  EXPECT_EQ(tree_with_ranges("k: !!str\nl: m\n"), "{k@1:1-2: \"\"@1:4-9, l@2:1-2: m@2:4-5}@1:1-2");
  EXPECT_EQ(tree_with_ranges("k: &a\n  l: m\n"), "{k@1:1-2: {l@2:3-4: m@2:6-7}@2:3-4}@1:1-2");
}

TEST(YamlDocument, PlacesOfNulls) {
  EXPECT_EQ(tree_with_ranges("k: ~\nl: null\n"), "{k@1:1-2: ~@1:4-5, l@2:1-2: ~@2:4-8}@1:1-2");
  // Where nothing is written: the key, or the dash.
  EXPECT_EQ(tree_with_ranges("k:\nlong: # x\n"), "{k@1:1-2: ~@1:1-2, long@2:1-5: ~@2:1-5}@1:1-2");
  EXPECT_EQ(tree_with_ranges("- a\n-\n# - comment\n-   # x\n- b\n"),
            "[a@1:3-4, ~@2:1-2, ~@4:1-2, b@5:3-4]@1:1-2");
  EXPECT_EQ(tree_with_ranges("- - a\n  -\n-\n"), "[[a@1:5-6, ~@2:3-4]@1:3-4, ~@3:1-2]@1:1-2");
}

TEST(YamlDocument, PlacesOfAliasesAreThoseOfTheirAnchors) {
  EXPECT_EQ(tree_with_ranges("- &x a\n- *x\n"), "[a@1:6-7, a@1:6-7]@1:1-2");
}

// Errors --------------------------------------------------------------------------------------

TEST(YamlDocument, RefusesWhatIsNotYaml) {
  EXPECT_EQ(tree("a: b: c\n"),
            syntax_error("1:5-6",
                         "unexpected ':': is the indentation right? a value with ': ' in "
                         "it must be in quotes"));
  // The parser notices only a line, or a comment, later.
  for (const char* const text : {"- a: 1\n  b:2\n- c: 3\n", "- a: 1\n  b 2\n\n# c\n- d: 3\n",
                                 "- a: 1\n  b:2  # d\n  c: 3\n"}) {
    EXPECT_EQ(tree(text),
              syntax_error("2:3-6",
                           "expected a key and a value: is ':' missing, or the space after it?"));
  }
  EXPECT_EQ(
      tree("- a 1 # x\n  b: 2\n"),
      syntax_error("1:3-6", "expected a key and a value: is ':' missing, or the space after it?"));
  // A name in a list is no key.
  EXPECT_EQ(tree("- a:\n  - b c\n   d: 2\n"),
            syntax_error("3:5-6",
                         "unexpected ':': is the indentation right? a value with ': ' in "
                         "it must be in quotes"));
  EXPECT_EQ(tree("- a: 1\n   b: 2\n- c\n"),
            syntax_error("2:5-6",
                         "unexpected ':': is the indentation right? a value with ': ' in "
                         "it must be in quotes"));
  EXPECT_EQ(tree("a:\n  - b: 1\n   c: 2\n"),
            syntax_error("3:4-5",
                         "expected '- ', or the end of the list: is the indentation "
                         "right?"));
  EXPECT_EQ(tree("a: *x\n"), syntax_error("1:4-6", "there is no anchor 'x'"));
  EXPECT_EQ(tree("a: @x\n"),
            syntax_error("1:4-5", "a value cannot begin with this character; put it in quotes"));
}

TEST(YamlDocument, RefusesWhatIsNotClosed) {
  EXPECT_EQ(tree("a: [1, 2\n"), syntax_error("1:4-5", "'[' is not closed") +
                                    "  2:1-1 expected ',' or ']' before this\n");
  EXPECT_EQ(tree("a: [1, 2\nb: 3\n"), syntax_error("1:4-5", "'[' is not closed") +
                                          "  2:2-3 expected ',' or ']' before this\n");
  EXPECT_EQ(tree("a: [{b: 1, c: 2\nd: 3\n"), syntax_error("1:5-6", "'{' is not closed"));
  EXPECT_EQ(tree("a: [b: 1, c: 2\nd: 3\n"), syntax_error("1:4-5", "'[' is not closed") +
                                                "  2:2-3 expected ',' or ']' before this\n");
  // Of what may be a key, the parser tells nothing before its end.
  EXPECT_EQ(
      tree("- {a: b, c: [{d: e}\n- {f: g}\n"),
      syntax_error("1:13-14", "'[' is not closed") + "  2:1-2 expected ',' or ']' before this\n");
  EXPECT_EQ(tree("[1, 2"), syntax_error("1:1-2", "'[' is not closed"));
  EXPECT_EQ(tree("{a: 1"), syntax_error("1:1-2", "'{' is not closed"));
  const std::string message = "a text in quotes does not end";
  EXPECT_EQ(tree("a: \"x\n"), syntax_error("1:4-5", message));
  EXPECT_EQ(tree("a: \"x\nb: c"), syntax_error("1:4-5", message));
  EXPECT_EQ(tree("a: 'x\n"), syntax_error("1:4-5", message));
  EXPECT_EQ(tree("a: b # it's\nc: 'it''s"), syntax_error("2:4-5", message));
}

TEST(YamlDocument, RefusesHalfCharacters) {
  EXPECT_EQ(tree("a: \"\\u00e9\\U0001F600\""), "{a: \"é😀\"}");
  EXPECT_EQ(tree("a: \"x\\ud83d\\ude00\""),
            syntax_error("1:12-13",
                         "this escape is no character; write the character itself, or \\U and 8 "
                         "digits"));
}

TEST(YamlDocument, RefusesKeysThatAreNoNames) {
  const std::string message = "a key must be a plain name, not a list or a mapping";
  EXPECT_EQ(tree("? [a]\n: b\n"), syntax_error("1:3-4", message));
  EXPECT_EQ(tree("[a]: b\n"), syntax_error("1:1-2", message));
  EXPECT_EQ(tree("{{a: b}: c}\n"), syntax_error("1:2-3", message));
  EXPECT_EQ(tree("- &x [a]\n- *x : b\n"), syntax_error("2:3-5", message));
  EXPECT_EQ(tree("a: 1\n: 2\n"), syntax_error("2:1-2", "a key is missing here, or is null"));
  EXPECT_EQ(tree("a: 1\n~: 2\n"), syntax_error("2:1-2", "a key is missing here, or is null"));
}

TEST(YamlDocument, RefusesOtherTags) {
  EXPECT_EQ(tree("a: !foo x\n"), syntax_error("1:9-10", "unsupported tag '!foo'"));
  EXPECT_EQ(tree("a: !!binary eA==\n"),
            syntax_error("1:13-17", "unsupported tag 'tag:yaml.org,2002:binary'"));
  EXPECT_EQ(tree("!!set {a}\n"), syntax_error("1:7-8", "unsupported tag 'tag:yaml.org,2002:set'"));
  EXPECT_EQ(tree("!!map [a]\n"), syntax_error("1:7-8", "unsupported tag 'tag:yaml.org,2002:map'"));
  EXPECT_EQ(tree("!!null x\n"), syntax_error("1:8-9", "unsupported tag 'tag:yaml.org,2002:null'"));
  EXPECT_EQ(tree("[!!seq [a], !!map {b: c}]"), "[[a], {b: c}]");
}

TEST(YamlDocument, RefusesMergesOfOtherThings) {
  const std::string message = "the merge key '<<' takes a mapping, or a list of mappings";
  EXPECT_EQ(tree("a: {<<: 1}"), syntax_error("1:9-10", message));
  EXPECT_EQ(tree("- &x 1\n- {<<: *x}"), syntax_error("2:8-10", message));
  EXPECT_EQ(tree("{<<: [{a: 1}, b]}"), syntax_error("1:6-7", message));
  EXPECT_EQ(
      tree("{<<: {a: 1}, <<: {b: 2}}"),
      syntax_error("1:14-16", "a second merge key '<<' in one mapping; merge a list instead"));
}

TEST(YamlDocument, RefusesBytesThatAreNoText) {
  EXPECT_EQ(tree("a: é\xff\n"), syntax_error("1:5-6", "not valid UTF-8"));
  EXPECT_EQ(tree(std::string_view("a: 1\nb\0c", 8)), syntax_error("2:2-3", "a NUL byte"));
  EXPECT_EQ(tree("a: x\x1b[0m"), syntax_error("1:5-6", "a control character: '\\x1b'"));
  EXPECT_EQ(tree("a: x\x04z"), syntax_error("1:5-6", "a control character: '\\x04'"));
  EXPECT_EQ(tree("a: \xc2\x9b"), syntax_error("1:4-5", "a control character: '\\x9b'"));
  // Other readers would see a second line here.
  const std::string alone = "a carriage return without a line feed; end lines with a line feed";
  EXPECT_EQ(tree("a: 1\r# b\rc: 2\n"), syntax_error("1:5-6", alone));
  EXPECT_EQ(tree("a: 1\r\r\nb: 2\r\n"), syntax_error("1:5-6", alone));
  EXPECT_EQ(tree("a: 1\r\nb: 'c\rd'"), syntax_error("2:6-7", alone));
  EXPECT_EQ(tree(std::string_view("\xff\xfe"
                                  "a\0:\0",
                                  6)),
            syntax_error("1:1-2", "expected UTF-8, found UTF-16"));
  EXPECT_EQ(tree(std::string_view("ab\0:\0", 5)), syntax_error("1:3-4", "a NUL byte"));
}

TEST(YamlDocument, NamesOtherEncodings) {
  const auto found = [](std::string_view text) {
    const std::string shown = tree(text);
    const std::size_t place = shown.find("found ");
    return place == std::string::npos ? shown : shown.substr(place + 6, 6);
  };
  EXPECT_EQ(found(std::string_view("\xff\xfe"
                                   "a\0",
                                   4)),
            "UTF-16");
  EXPECT_EQ(found(std::string_view("\xfe\xff\0a", 4)), "UTF-16");
  EXPECT_EQ(found(std::string_view("\xff\xfe\0\0a\0\0\0", 8)), "UTF-32");
  EXPECT_EQ(found(std::string_view("\0\0\xfe\xff\0\0\0a", 8)), "UTF-32");
  EXPECT_EQ(tree(std::string_view("a\0\0\0bcde", 8)), syntax_error("1:2-3", "a NUL byte"));
  EXPECT_EQ(tree(std::string_view("\0\0\0abcde", 8)), syntax_error("1:1-2", "a NUL byte"));
}

// Bombs ---------------------------------------------------------------------------------------

std::string too_deep(const std::string& range) {
  return syntax_error(range, "nested too deeply: more than 64 levels");
}

TEST(YamlDocument, BoundsTheDepth) {
  EXPECT_EQ(tree(repeat("[", 64) + repeat("]", 64)), repeat("[", 64) + repeat("]", 64));
  EXPECT_EQ(tree(repeat("[", 65) + repeat("]", 65)), too_deep("1:65-66"));
  EXPECT_EQ(tree(repeat("- ", 64) + "a"), repeat("[", 64) + "a" + repeat("]", 64));
  EXPECT_EQ(tree(repeat("- ", 65) + "a"), too_deep("1:129-130"));
  EXPECT_EQ(tree(repeat("{a: ", 65) + "b" + repeat("}", 65)), too_deep("1:257-258"));
}

TEST(YamlDocument, BoundsTheDepthThroughAliases) {
  const std::string nested = repeat("[", 40) + repeat("]", 40);
  EXPECT_EQ(tree("- &x " + nested + "\n- " + repeat("[", 23) + "*x" + repeat("]", 23) + "\n"),
            "[" + nested + ", " + repeat("[", 63) + repeat("]", 63) + "]");
  EXPECT_EQ(tree("- &x " + nested + "\n- " + repeat("[", 24) + "*x" + repeat("]", 24) + "\n"),
            too_deep("2:27-29"));
}

TEST(YamlDocument, RefusesEndlessNestingEarly) {
  constexpr std::size_t million = 1'000'000;
  EXPECT_EQ(tree(repeat("[", million)), too_deep("1:65-66"));
  EXPECT_EQ(tree(repeat("{", million)), too_deep("1:65-66"));
  EXPECT_EQ(tree(repeat("[a,", million / 3)), too_deep("1:193-194"));
  EXPECT_EQ(tree(repeat("[\n", million / 2)), too_deep("65:1-2"));
  EXPECT_EQ(tree(repeat("- ", million / 2)), too_deep("1:129-130"));
}

TEST(YamlDocument, ManyBracketsThatAreTextAreNoNesting) {
  const std::string text = repeat("- '[0, 1)'\n", 20'000);
  EXPECT_EQ(tree(text).size(), 20'000 * 10U);
}

TEST(YamlDocument, RefusesAliasBombs) {
  EXPECT_EQ(tree("&a [*a]"),
            syntax_error("1:5-7", "an alias stands within the value that it names"));
  EXPECT_EQ(tree("&a {b: *a}"),
            syntax_error("1:8-10", "an alias stands within the value that it names"));
  std::string laughs = "- &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 10; ++i) {
    laughs +=
        "- &a" + std::to_string(i) + " [" + repeat("*a" + std::to_string(i - 1) + ", ", 10) + "]\n";
  }
  // In lines 2 to 4 they stand for 110 + 1110 + 11110 values, in line 5 for 11111 each.
  EXPECT_EQ(tree(laughs), syntax_error("5:43-46", "aliases stand for more than 100000 values"));
}

TEST(YamlDocument, RefusesMergeBombs) {
  std::string text = "- &x {";
  for (int i = 0; i < 1'000; ++i) text += "k" + std::to_string(i) + ": 1, ";
  text += "}\n" + repeat("- {<<: *x}\n", 100);
  // Each merge counts 2001 values for the alias and 2000 for the keys and values it adds.
  EXPECT_EQ(tree(text), syntax_error("26:8-10", "aliases stand for more than 100000 values"));
}

TEST(YamlDocument, AllowsManyAliases) {
  const std::string text = "- &x a\n" + repeat("- *x\n", 100'000);
  EXPECT_EQ(tree(text).size(), 1 + 3 * 100'001U - 1);
}

// Nothing but a result is expected of these: no crash, no hang.
TEST(YamlDocument, SurvivesStrangeTexts) {
  constexpr std::size_t million = 1'000'000;
  for (const std::string& text :
       {repeat("\"", million),
        repeat("'", million),
        repeat("? ", million / 2),
        repeat(": ", million / 2),
        repeat(":", million),
        repeat("!", million),
        repeat("&", million),
        repeat("&a ", million / 3),
        repeat("*", million),
        repeat("%", million),
        repeat("%a b\n", million / 5),
        repeat("]", million),
        repeat("\t", million),
        repeat(" ", million),
        repeat("\n", million),
        repeat("|", million),
        repeat("---\n", million / 4),
        repeat("...\n", million / 4),
        repeat("#", million),
        repeat("a: ", million / 3),
        repeat("k", million) + ": 1",
        "[" + repeat(",", million) + "]",
        "[#" + repeat("x", million / 2) + "\n" + repeat(",", million / 2) + "]",
        repeat("a\n", million / 2),
        "\"" + repeat("a\n", million / 2) + "\"",
        "a" + repeat(" ", million) + "b",
        repeat("[? ", million / 3),
        repeat("[: ", million / 3)}) {
    Diagnostics diagnostics;
    const auto document = parse(text, "a.yaml", diagnostics);
    EXPECT_EQ(document == nullptr, diagnostics.has_errors()) << text.substr(0, 20);
  }
}

TEST(YamlDocument, SurvivesEveryTruncation) {
  const std::string text =
      "# c\na: &x {b: [1, 'two', \"th\\u0072ee\"], c: ~}\n? d\n: - *x\n  - !!str é\n  -\n"
      "<<: *x\ne: |\n  f\n  g\nh: >-\n  i\n";
  ASSERT_NE(tree(text).front(), '1');
  for (std::size_t size = 0; size < text.size(); ++size) {
    Diagnostics diagnostics;
    const auto document = parse(std::string_view(text).substr(0, size), "a.yaml", diagnostics);
    EXPECT_EQ(document == nullptr, diagnostics.has_errors()) << size;
  }
}

}  // namespace
}  // namespace cbc::yaml::yaml_document_test
