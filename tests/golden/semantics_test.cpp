// docs/semantics.md: its examples are run, and the comments that refer to it name sections that are
// there.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "golden/process.h"
#include "support/read_file.h"
#include "support/scratch_folder.h"

namespace cbc::golden::semantics_test {
namespace {

namespace fs = std::filesystem;

using Lines = std::vector<std::string>;

const std::string page_path = CBC_SOURCE_DIR "/docs/semantics.md";
const std::string omission = "…";  // a line of it stands for one line or more

Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// What stands between "```LANGUAGE" and "```".
struct Block {
  std::string language;
  std::size_t line = 0;  ///< of its beginning
  Lines lines{};
};

std::vector<Block> blocks_of_page() {
  std::vector<Block> blocks;
  bool is_inside = false;
  std::size_t number = 0;
  for (const std::string& line : lines_of(test::read_file(page_path))) {
    ++number;
    if (line.starts_with("```")) {
      if (!is_inside) blocks.push_back({line.substr(3), number});
      is_inside = !is_inside;
    } else if (is_inside) {
      blocks.back().lines.push_back(line);
    }
  }
  EXPECT_FALSE(is_inside) << "the last block does not end";
  return blocks;
}

/// The name in a line "# NAME.yaml", or nothing.
std::string file_name_in(const std::string& line) {
  static const std::regex comment("# ([a-z.]+\\.yaml)");
  std::smatch found;
  return std::regex_match(line, found, comment) ? found[1].str() : std::string();
}

/// Writes the files of a block, each of which begins with a comment that names it. False if the
/// block begins otherwise.
bool write_files(const Block& block, const test::ScratchFolder& folder) {
  std::string name;
  std::string content;
  for (const std::string& line : block.lines) {
    if (const std::string next = file_name_in(line); !next.empty()) {
      if (!name.empty()) folder.write(name, content);
      name = next;
      content.clear();
    }
    if (name.empty()) return false;
    content += line + "\n";
  }
  folder.write(name, content);
  return !name.empty();
}

/// Whether the lines are those of the pattern, in which a line may be an omission.
bool match(const Lines& lines, const Lines& pattern) {
  std::vector<bool> fits(lines.size() + 1, false);  // by number of lines: the pattern so far
  fits.front() = true;
  for (const std::string& expected : pattern) {
    std::vector<bool> next(fits.size(), false);
    for (std::size_t count = 0; count < lines.size(); ++count) {
      next[count + 1] = expected == omission ? fits[count] || next[count]
                                             : fits[count] && lines[count] == expected;
    }
    fits = std::move(next);
  }
  return fits.back();
}

/// Runs the command in the first line of a block, and compares what it prints with the others.
void run_block(const Block& block, const std::string& folder) {
  ASSERT_FALSE(block.lines.empty());
  const std::string prompt = "$ cbc ";
  ASSERT_TRUE(block.lines.front().starts_with(prompt)) << block.lines.front();
  Call call{{}, folder};
  std::istringstream words(block.lines.front().substr(prompt.size()));
  for (std::string word; words >> word;) call.arguments.push_back(word);
  const Result result = run(call);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "");
  const Lines expected(block.lines.begin() + 1, block.lines.end());
  EXPECT_GT(std::count_if(expected.begin(), expected.end(),
                          [](const std::string& line) { return line != omission; }),
            1);
  EXPECT_TRUE(match(lines_of(result.out), expected)) << "it prints\n" << result.out;
}

TEST(Semantics, ExamplesAreWhatTheProgramDoes) {
  const test::ScratchFolder folder;
  std::size_t runs = 0;
  for (const Block& block : blocks_of_page()) {
    SCOPED_TRACE(page_path + ":" + std::to_string(block.line));
    if (block.language == "yaml") {
      EXPECT_TRUE(write_files(block, folder)) << "the block does not begin with '# NAME.yaml'";
    } else if (block.language == "console") {
      run_block(block, folder.path());
      ++runs;
    } else {
      EXPECT_EQ(block.language, "text");
    }
  }
  EXPECT_GE(runs, 8U);
  for (const std::string& name : folder.names()) {
    if (!name.ends_with(".mission.yaml")) continue;
    EXPECT_NE(folder.read(name).find("expect:"), std::string::npos) << name << " expects nothing";
  }
}

/// The titles of the sections, in order.
Lines titles_of_page() {
  Lines titles;
  bool is_inside = false;
  for (const std::string& line : lines_of(test::read_file(page_path))) {
    if (line.starts_with("```")) is_inside = !is_inside;
    static const std::regex heading("###? (.*)");
    std::smatch found;
    if (!is_inside && std::regex_match(line, found, heading)) titles.push_back(found[1]);
  }
  return titles;
}

TEST(Semantics, ContentsHaveAllSections) {
  Lines titles = titles_of_page();
  ASSERT_FALSE(titles.empty());
  ASSERT_EQ(titles.front(), "Contents");
  titles.erase(titles.begin());
  const std::string page = test::read_file(page_path);
  const std::size_t begin = page.find("## Contents");
  const std::string contents = page.substr(begin, page.find("\n## ", begin) - begin);
  Lines listed;
  const std::regex link(R"(\[([^\]]*)\]\(#)");
  for (std::sregex_iterator at(contents.begin(), contents.end(), link), end; at != end; ++at) {
    listed.push_back((*at)[1]);
  }
  EXPECT_EQ(listed, titles);
}

/// `docs/semantics.md, "TITLE"`, in comments, perhaps over several lines.
TEST(Semantics, CommentsReferToSections) {
  const Lines titles = titles_of_page();
  const std::set<std::string> known(titles.begin(), titles.end());
  for (const char* folder : {"src", "include", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(CBC_SOURCE_DIR) / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      std::string text = test::read_file(entry.path());
      if (text.find("docs/semantics.md") == std::string::npos) continue;
      text = std::regex_replace(text, std::regex("\n *///? *"), " ");
      const std::regex reference("docs/semantics\\.md, \"([A-Z][a-z][^\"]*)\"");
      for (std::sregex_iterator at(text.begin(), text.end(), reference), end; at != end; ++at) {
        const std::string title = (*at)[1];
        EXPECT_TRUE(known.contains(title))
            << entry.path() << " refers to the section '" << title << "'";
      }
    }
  }
}

/// Numbers of sections and rules are those of documents that are not here.
TEST(Semantics, CommentsReferToNothingElse) {
  const std::regex foreign(R"(//.*(\bsections? [0-9]|\brules? [0-9]|semantics:))");
  int count = 0;
  for (const char* folder : {"src", "include"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(CBC_SOURCE_DIR) / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      ++count;
      for (const std::string& line : lines_of(test::read_file(entry.path()))) {
        EXPECT_FALSE(std::regex_search(line, foreign)) << entry.path() << ": " << line;
      }
    }
  }
  EXPECT_GT(count, 100);
}

}  // namespace
}  // namespace cbc::golden::semantics_test
