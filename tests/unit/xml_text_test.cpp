#include <string>

#include <gtest/gtest.h>

#include "core/support/wording.h"

namespace cbc::xml_text_test {
namespace {

TEST(XmlText, EscapesWhatIsMarkup) {
  EXPECT_EQ(xml_text(R"(<a b="c">&'d'</a>]]>)"),
            "&lt;a b=&quot;c&quot;&gt;&amp;'d'&lt;/a&gt;]]&gt;");
}

TEST(XmlText, LeavesOtherTextAsItIs) {
  EXPECT_EQ(xml_text("Höhe 5 %; 高度 \U0001F681"), "Höhe 5 %; 高度 \U0001F681");
  EXPECT_EQ(xml_text(""), "");
}

TEST(XmlText, KeepsLineEndsOfAttributes) { EXPECT_EQ(xml_text("a\nb"), "a&#10;b"); }

/// XML 1.0 has no place for these, not even as numbers.
TEST(XmlText, MakesPrintableWhatXmlCannotHold) {
  for (int code = 0; code < 0x20; ++code) {
    if (code == '\n') continue;
    const std::string text = xml_text(std::string(1, static_cast<char>(code)));
    EXPECT_EQ(text.front(), '\\') << code;
    for (const char byte : text) EXPECT_GE(byte, 0x20) << code;
  }
  EXPECT_EQ(xml_text("\x1b[2J"), "\\x1b[2J");
  EXPECT_EQ(xml_text("\xEF\xBF\xBE \xEF\xBF\xBF"), "\\ufffe \\uffff");
  EXPECT_EQ(xml_text("\xff \xED\xA0\x80"), "\\xff \\xed\\xa0\\x80") << "a byte, and half a pair";
}

}  // namespace
}  // namespace cbc::xml_text_test
