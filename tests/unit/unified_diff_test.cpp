#include "core/files/unified_diff.h"

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "support/scratch_folder.h"

namespace cbc::cli::unified_diff_test {
namespace {

std::string diff(const std::string& before, const std::string& after) {
  return unified_diff(before, after, "f.yaml").value_or("no diff");
}

TEST(UnifiedDiff, HasTheChangedLines) {
  EXPECT_EQ(diff("", ""), "");
  EXPECT_EQ(diff("a\nb", "a\nb"), "");
  EXPECT_EQ(diff("a\nb\n", "a\nB\n"), "--- a/f.yaml\n+++ b/f.yaml\n@@ -1,2 +1,2 @@\n a\n-b\n+B\n");
}

TEST(UnifiedDiff, NamesFiles) {
  const auto name = [](const std::string& file) {
    const std::string text = unified_diff("a\n", "b\n", file).value_or("");
    return text.substr(0, text.find('\n'));
  };
  EXPECT_EQ(name("x/é.yaml"), "--- a/x/é.yaml");
  EXPECT_EQ(name("-u"), "--- a/-u");
  EXPECT_EQ(name("x y"), "--- a/x y\t");
  // What a terminal obeys or does not show, and what is not UTF-8.
  EXPECT_EQ(name("a\nb"), "--- a/a\\nb");
  EXPECT_EQ(name("\xFF"), "--- a/\\xff");
}

TEST(UnifiedDiff, IsWhatPatchTakes) {
  if (std::system("command -v patch > /dev/null") != 0) GTEST_SKIP() << "no patch";
  const test::ScratchFolder folder;
  folder.write("f.yaml", "1\r\na\n2\n3");
  folder.write("difference", diff("1\r\na\n2\n3", "1\r\nb\n2\n"));
  ASSERT_EQ(
      std::system(("cd '" + folder.path() + "' && patch -p1 -s --binary < difference").c_str()), 0);
  EXPECT_EQ(folder.read("f.yaml"), "1\r\nb\n2\n");
}

}  // namespace
}  // namespace cbc::cli::unified_diff_test
