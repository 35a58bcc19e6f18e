#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"

namespace cbc::diagnostic_text_test {
namespace {

std::string render_at(std::string_view text, const Range& range,
                      const Style& style = plain_style()) {
  SourceTexts sources;
  sources.add("a.yaml", text);
  return render({rule::wrong_type, Severity::error, "a.yaml", range, "bad", {}}, sources, style);
}

TEST(DiagnosticText, KeepsTabsSoThatTheCaretLinesUp) {
  EXPECT_EQ(render_at("\ta:\tb", {{1, 5}, {1, 6}}),
            "a.yaml:1:5: error: bad [wrong-type]\n"
            "  \ta:\tb\n"
            "  \t  \t^\n");
}

TEST(DiagnosticText, CountsCharactersAndTheirWidth) {
  EXPECT_EQ(render_at("é: ü", {{1, 4}, {1, 5}}),
            "a.yaml:1:4: error: bad [wrong-type]\n"
            "  é: ü\n"
            "     ^\n");
  // Two columns for each of the wide characters.
  EXPECT_EQ(render_at("日本: 東京", {{1, 5}, {1, 7}}),
            "a.yaml:1:5: error: bad [wrong-type]\n"
            "  日本: 東京\n"
            "        ^~~~\n");
}

TEST(DiagnosticText, ShowsRangesAtAndBeyondTheEndOfTheLine) {
  EXPECT_EQ(render_at("ab", {{1, 3}, {1, 3}}),
            "a.yaml:1:3: error: bad [wrong-type]\n  ab\n    ^\n");
  EXPECT_EQ(render_at("ab", {{1, 9}, {1, 20}}),
            "a.yaml:1:9: error: bad [wrong-type]\n  ab\n    ^\n");
  EXPECT_EQ(render_at("a: \"x\ny\"", {{1, 4}, {2, 3}}),
            "a.yaml:1:4: error: bad [wrong-type]\n  a: \"x\n     ^~\n");
}

TEST(DiagnosticText, LeavesOutUnknownLines) {
  const std::string head = "a.yaml:5:1: error: bad [wrong-type]\n";
  EXPECT_EQ(render_at("one line", {{5, 1}, {5, 2}}), head);
  EXPECT_EQ(render_at("", {{5, 1}, {5, 2}}), head);
}

TEST(DiagnosticText, CutsLongLines) {
  const std::string text = std::string(200, 'a') + "bcd" + std::string(200, 'e');
  // 96 characters are shown, 48 of them before the place.
  EXPECT_EQ(render_at(text, {{1, 201}, {1, 204}}),
            "a.yaml:1:201: error: bad [wrong-type]\n"
            "  ..." +
                std::string(48, 'a') + "bcd" + std::string(45, 'e') + "...\n" + "     " +
                std::string(48, ' ') + "^~~\n");
  EXPECT_EQ(render_at(text, {{1, 2}, {1, 403}}),
            "a.yaml:1:2: error: bad [wrong-type]\n"
            "  " +
                std::string(96, 'a') + "...\n" + "   ^" + std::string(94, '~') + "\n");
  EXPECT_EQ(render_at(text, {{1, 403}, {1, 404}}),
            "a.yaml:1:403: error: bad [wrong-type]\n"
            "  ..." +
                std::string(96, 'e') + "\n" + "     " + std::string(95, ' ') + "^\n");
}

TEST(DiagnosticText, ShowsNoControlCharactersAndNoInvalidBytes) {
  EXPECT_EQ(render_at("a\x1b[0m\xff!", {{1, 7}, {1, 8}}),
            "a.yaml:1:7: error: bad [wrong-type]\n"
            "  a\xEF\xBF\xBD[0m\xEF\xBF\xBD!\n"
            "        ^\n");
}

TEST(DiagnosticText, ShowsNoCharactersThatTurnTheDirection) {
  EXPECT_EQ(render_at("a\u202E\u2066b", {{1, 4}, {1, 5}}),
            "a.yaml:1:4: error: bad [wrong-type]\n"
            "  a\xEF\xBF\xBD\xEF\xBF\xBD"
            "b\n"
            "     ^\n");
}

TEST(DiagnosticText, MakesControlCharactersOfNamesAndMessagesHarmless) {
  const Diagnostic diagnostic{rule::wrong_type, Severity::error,
                              "a\n.yaml",       {{1, 1}, {1, 2}},
                              "bad \x1b[2J",    {{"b\r.yaml", {{7, 8}, {7, 9}}, "see\athere\xff"}}};
  EXPECT_EQ(render(diagnostic, {}, plain_style()),
            "a\\n.yaml:1:1: error: bad \\x1b[2J [wrong-type]\n"
            "b\\r.yaml:7:8: note: see\\x07there\\xff\n");
}

TEST(DiagnosticText, IgnoresByteOrderMarksAndCarriageReturns) {
  EXPECT_EQ(render_at("\xEF\xBB\xBFone\r\ntwo\r\n", {{1, 1}, {1, 4}}),
            "a.yaml:1:1: error: bad [wrong-type]\n  one\n  ^~~\n");
}

TEST(DiagnosticText, ColorsOnRequest) {
  EXPECT_EQ(render_at("ab", {{1, 1}, {1, 3}}, color_style()),
            "\x1b[1ma.yaml:1:1:\x1b[0m \x1b[1;31merror:\x1b[0m bad [wrong-type]\n"
            "  ab\n"
            "  \x1b[1;32m^~\x1b[0m\n");
}

}  // namespace
}  // namespace cbc::diagnostic_text_test
