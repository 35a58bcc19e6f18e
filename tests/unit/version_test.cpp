// What people read names the version that the project has.
#include "cbc/version.h"

#include <cstddef>
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include "support/read_file.h"

namespace cbc::version_test {
namespace {

std::string source_text(const std::string& name) {
  return test::read_file(std::string(CBC_SOURCE_DIR) + "/" + name);
}

TEST(Version, IsTheNewestOfTheChangelog) {
  const std::string changelog = source_text("CHANGELOG.md");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(changelog, found, std::regex(R"(\n## \[([0-9][^\]]*)\])")));
  EXPECT_EQ(found.str(1), version);
}

TEST(Version, IsTheOneToUseInPipelines) {
  const std::string page = source_text("docs/ci.md") + source_text("src/init/files/ci.sh");
  const std::regex tag(R"(\bv([0-9]+\.[0-9]+\.[0-9]+)\b)");
  std::size_t count = 0;
  for (std::sregex_iterator found(page.begin(), page.end(), tag), end; found != end; ++found) {
    EXPECT_EQ(found->str(1), version);
    ++count;
  }
  EXPECT_EQ(count, 3U);
}

}  // namespace
}  // namespace cbc::version_test
