#include "manual/page.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

namespace cbc::manual {
namespace {

std::filesystem::path path_of(const std::string& name) {
  return std::filesystem::path(CBC_SOURCE_DIR) / "man" / name;
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

/// What follows a line, up to and without a line that begins like one of the ends.
std::string_view after(std::string_view page, std::string_view first,
                       std::initializer_list<std::string_view> ends) {
  while (!page.empty() && take_line(page) != first) {
  }
  std::string_view rest = page;
  while (!rest.empty()) {
    const std::size_t size = page.size() - rest.size();
    const std::string_view line = take_line(rest);
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

void write_page(const std::string& name, const std::string& text) {
  std::ofstream file(path_of(name), std::ios::binary);
  file << text;
  EXPECT_TRUE(file.flush()) << "cannot write man/" << name;
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
    std::string_view line = take_line(part);
    if (!line.starts_with(begin)) continue;
    line.remove_prefix(begin.size());
    words.emplace(line.substr(0, line.find(' ')));
  }
  return words;
}

}  // namespace cbc::manual
