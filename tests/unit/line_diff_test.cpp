#include "core/support/line_diff.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/scratch_folder.h"

namespace cbc::line_diff_test {
namespace {

constexpr const char* head = "--- a/f.yaml\n+++ b/f.yaml\n";

std::string diff(const std::string& before, const std::string& after) {
  return unified_diff(before, after, "f.yaml");
}

TEST(LineDiff, EqualTexts) {
  EXPECT_EQ(diff("", ""), "");
  EXPECT_EQ(diff("a\nb", "a\nb"), "");
}

TEST(LineDiff, NearChangesShareAHunk) {
  EXPECT_EQ(diff("a\n1\n2\n3\n4\n5\n6\nb\n", "A\n1\n2\n3\n4\n5\n6\nB\n"),
            std::string(head) + "@@ -1,8 +1,8 @@\n-a\n+A\n 1\n 2\n 3\n 4\n 5\n 6\n-b\n+B\n");
  EXPECT_EQ(diff("a\n1\n2\n3\n4\n5\n6\n7\nb\n", "A\n1\n2\n3\n4\n5\n6\n7\nB\n"),
            std::string(head) +
                "@@ -1,4 +1,4 @@\n-a\n+A\n 1\n 2\n 3\n@@ -6,4 +6,4 @@\n 5\n 6\n 7\n-b\n+B\n");
  EXPECT_EQ(diff("a\nb\n", "A\nB\n"), std::string(head) + "@@ -1,2 +1,2 @@\n-a\n-b\n+A\n+B\n");
}

TEST(LineDiff, TheLastLineBreak) {
  const std::string no_line_break = "\\ No newline at end of file\n";
  EXPECT_EQ(diff("a", "a\n"), std::string(head) + "@@ -1 +1 @@\n-a\n" + no_line_break + "+a\n");
  EXPECT_EQ(diff("1\na", "2\na"),
            std::string(head) + "@@ -1,2 +1,2 @@\n-1\n+2\n a\n" + no_line_break);
  EXPECT_EQ(diff("1\r\na\r\n", "2\r\na\r\n"),
            std::string(head) + "@@ -1,2 +1,2 @@\n-1\r\n+2\r\n a\r\n");
}

TEST(LineDiff, NamesOfFiles) {
  const auto name = [](const std::string& file) {
    const std::string text = unified_diff("a\n", "b\n", file);
    return text.substr(0, text.find('\n'));
  };
  EXPECT_EQ(name("x/é.yaml"), "--- a/x/é.yaml");
  EXPECT_EQ(name("x y"), "--- a/x y\t");
  // What a terminal obeys or does not show, and what is not UTF-8.
  EXPECT_EQ(name("a\nb"), "--- a/a\\nb");
  EXPECT_EQ(name("\xFF"), "--- a/\\xff");
}

/// Texts of few different lines, with changes here and there.
class RandomTexts {
 public:
  explicit RandomTexts(unsigned seed) : random_(seed) {}

  std::string text(std::size_t lines, int kinds) {
    std::string result;
    for (std::size_t i = 0; i < lines; ++i) result += line(kinds);
    if (chance(4) && !result.empty()) result.pop_back();
    return result;
  }

  std::string change(const std::string& text, int one_in, int kinds) {
    std::string result;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
      if (chance(one_in)) {
        if (chance(2)) result += line(kinds);
        if (chance(2)) begin = end;
      }
      result += text.substr(begin, end - begin);
      begin = end;
    }
    return result;
  }

 private:
  bool chance(int one_in) { return random_() % static_cast<unsigned>(one_in) == 0; }
  std::string line(int kinds) {
    return "line " + std::to_string(random_() % static_cast<unsigned>(kinds)) + "\n";
  }
  std::mt19937 random_;
};

/// Whether a program turns the first text into the second one by the difference.
void expect_applies(const std::string& before, const std::string& after,
                    const std::string& command) {
  const test::ScratchFolder folder;
  folder.write("f.yaml", before);
  folder.write("difference", unified_diff(before, after, "f.yaml"));
  ASSERT_EQ(std::system(("cd '" + folder.path() + "' && " + command).c_str()), 0)
      << folder.read("difference");
  EXPECT_EQ(folder.read("f.yaml"), after) << folder.read("difference");
}

bool has_program(const std::string& name) {
  return std::system(("command -v " + name + " > /dev/null").c_str()) == 0;
}

TEST(LineDiff, PatchAndGitTakeIt) {
  std::vector<std::string> commands;
  if (has_program("patch")) commands.emplace_back("patch -p1 --quiet --fuzz=0 < difference");
  if (has_program("git")) {
    commands.emplace_back("GIT_DIR=none git apply -p1 --whitespace=nowarn difference");
  }
  if (commands.empty()) GTEST_SKIP() << "neither patch nor git";
  for (const std::string& command : commands) {
    for (unsigned seed = 1; seed <= 30; ++seed) {
      SCOPED_TRACE(seed);
      RandomTexts random(seed);
      const std::string before = random.text(std::size_t{seed} * 10, 8);
      const std::string after = random.change(before, seed % 2 == 0 ? 10 : 3, 8);
      if (before != after && !after.empty()) expect_applies(before, after, command);
    }
    expect_applies("a\r\nb\r\nc", "a\r\nB\r\nc", command);
    expect_applies("a\nb", "a\nb\n", command);
  }
}

/// Applies a difference strictly, without another program.
std::string patched(const std::string& before, const std::string& difference) {
  const auto split = [](const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < text.size(); begin += lines.back().size()) {
      lines.push_back(text.substr(begin, text.find('\n', begin) + 1 - begin));
    }
    return lines;
  };
  const std::vector<std::string> old_lines = split(before);
  std::vector<std::string> lines = split(difference);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i][0] == '\\') lines[i - 1].pop_back();
  }
  std::string result;
  std::size_t next = 0;
  for (std::size_t i = 2; i < lines.size(); ++i) {
    const std::string content = lines[i].substr(1);
    if (lines[i][0] == '@') {
      std::size_t first = std::stoul(lines[i].substr(4));
      const bool is_empty = lines[i].substr(0, lines[i].find(" +")).ends_with(",0");
      for (first -= is_empty ? 0 : 1; next < first; ++next) result += old_lines.at(next);
    } else if (lines[i][0] == '+') {
      result += content;
    } else if (lines[i][0] != '\\') {
      EXPECT_EQ(old_lines.at(next++), content);
      if (lines[i][0] == ' ') result += content;
    }
  }
  for (; next < old_lines.size(); ++next) result += old_lines[next];
  return result;
}

TEST(LineDiff, GivesTheOtherText) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    RandomTexts random(seed);
    const std::string before = random.text(seed % 40, 4);
    const std::string after = seed % 3 == 0
                                  ? random.text(seed % 50, 4)
                                  : random.change(before, 1 + static_cast<int>(seed % 7), 4);
    EXPECT_EQ(patched(before, diff(before, after)), after) << diff(before, after);
  }
}

TEST(LineDiff, OfFewChangesIsShort) {
  RandomTexts random(1);
  const std::string before = random.text(100'000, 20);
  std::string after = before;
  std::size_t changed = 0;
  for (std::size_t at = 0; (at = after.find("line 7\n", at)) != std::string::npos; ++at) {
    after.replace(at, 6, "LINE 7");
    ++changed;
  }
  const std::string difference = diff(before, after);
  EXPECT_EQ(patched(before, difference), after);
  std::size_t removed = 0;
  for (std::size_t at = 0; (at = difference.find("\n-", at)) != std::string::npos; ++at) ++removed;
  EXPECT_EQ(removed, changed);
}

TEST(LineDiff, OfTextsThatHaveNothingInCommonTakesNoTime) {
  std::string before;
  std::string after;
  for (int line = 0; line < 50'000; ++line) {
    before += "a" + std::to_string(line) + "\n";
    after += "b" + std::to_string(line) + "\n";
  }
  EXPECT_EQ(patched(before, diff(before, after)), after);
}

}  // namespace
}  // namespace cbc::line_diff_test
