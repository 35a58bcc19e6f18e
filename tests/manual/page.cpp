#include "manual/page.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

namespace cbc::manual {
namespace {

std::filesystem::path path_of(const std::string& name) {
  return std::filesystem::path(CBC_SOURCE_DIR) / "man" / name;
}

/// What follows a line, up to and without a line that begins like one of the ends.
std::string_view after(std::string_view page, std::string_view first,
                       std::initializer_list<std::string_view> ends) {
  while (!page.empty() && take_until("\n", page) != first) {
  }
  std::string_view rest = page;
  while (!rest.empty()) {
    const std::size_t size = page.size() - rest.size();
    const std::string_view line = take_until("\n", rest);
    for (const std::string_view end : ends) {
      if (line.starts_with(end)) return page.substr(0, size);
    }
  }
  ADD_FAILURE() << "the page has no part from '" << first << "' to '" << *ends.begin() << "'";
  return {};
}

}  // namespace

std::string read_page(const std::string& name) {
  const std::ifstream file(path_of(name), std::ios::binary);
  EXPECT_TRUE(file) << "cannot read man/" << name;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void expect_part(const std::string& name, std::string_view first, std::string_view last,
                 const std::string& expected) {
  std::string page = read_page(name);
  const std::string_view written = between(page, first, last);
  const char* const update = std::getenv("CBC_UPDATE_GOLDEN");
  if (update == nullptr || std::string_view(update) != "1" || written.data() == nullptr) {
    EXPECT_EQ(written, expected) << "in man/" << name;
    return;
  }
  page.replace(static_cast<std::size_t>(written.data() - page.data()), written.size(), expected);
  std::ofstream file(path_of(name), std::ios::binary);
  file << page;
  EXPECT_TRUE(file.flush()) << "cannot write man/" << name;
}

/// groff prints these characters as other ones, that no program understands.
std::string escape(std::string_view text) {
  std::string escaped;
  for (const char character : text) {
    switch (character) {
      case '-':
        escaped += "\\-";
        break;
      case '\\':
        escaped += "\\e";
        break;
      case '\'':
        escaped += "\\(aq";
        break;
      case '`':
        escaped += "\\(ga";
        break;
      case '^':
        escaped += "\\(ha";
        break;
      case '~':
        escaped += "\\(ti";
        break;
      default:
        escaped += character;
    }
  }
  // A period would begin a request.
  return escaped.starts_with('.') ? "\\&" + escaped : escaped;
}

std::string_view take_until(std::string_view separator, std::string_view& rest) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  const std::string_view taken = rest.substr(0, end);
  rest.remove_prefix(std::min(end + separator.size(), rest.size()));
  return taken;
}

/// A paragraph, each sentence of it on lines of its own.
std::string prose(std::string_view paragraph) {
  constexpr std::size_t columns = 80;
  std::string text;
  std::string line;
  while (!paragraph.empty()) {
    const std::string_view word = take_until(" ", paragraph);
    if (!line.empty() && line.size() + 1 + escape(word).size() > columns) {
      text += line + '\n';
      line.clear();
    }
    // What begins no line needs no protection of its period.
    line += line.empty() ? escape(word) : ' ' + escape("x" + std::string(word)).substr(1);
    if (word.ends_with('.')) {
      text += line + '\n';
      line.clear();
    }
  }
  return line.empty() ? text : text + line + '\n';
}

std::string_view between(std::string_view page, std::string_view first, std::string_view last) {
  return after(page, first, {last});
}

std::string_view subsection(std::string_view page, std::string_view title) {
  return after(page, ".Ss " + std::string(title), {".Ss ", ".Sh "});
}

std::set<std::string> items(std::string_view part, std::string_view macro) {
  const std::string begin = ".It " + std::string(macro) + ' ';
  std::set<std::string> words;
  while (!part.empty()) {
    std::string_view line = take_until("\n", part);
    if (!line.starts_with(begin)) continue;
    line.remove_prefix(begin.size());
    words.emplace(line.substr(0, line.find(' ')));
  }
  return words;
}

}  // namespace cbc::manual
