// The layers of docs/architecture.md are those of the code: a folder of src/ includes itself and
// the rows below its own, and nothing else. Includes name a folder by its last part.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace cbc::layers_test {
namespace {

namespace fs = std::filesystem;

/// The row of each folder in the table of layers; the first row is the highest layer.
std::map<std::string, int> rows_of_table() {
  std::ifstream page(fs::path(CBC_SOURCE_DIR) / "docs" / "architecture.md");
  std::map<std::string, int> rows;
  const std::regex name("`src/(?:[a-z]+/)?([a-z]+)`");
  int row = 0;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| `src/")) continue;
    ++row;
    const std::string cell = line.substr(0, line.find('|', 1));
    for (std::sregex_iterator at(cell.begin(), cell.end(), name), end; at != end; ++at) {
      EXPECT_TRUE(rows.emplace((*at)[1], row).second) << (*at)[1] << " is there twice";
    }
  }
  return rows;
}

bool is_source(const fs::path& path) {
  return path.extension() == ".h" || path.extension() == ".cpp";
}

TEST(Layers, IncludeOnlyLowerOnes) {
  const std::map<std::string, int> rows = rows_of_table();
  const fs::path source = fs::path(CBC_SOURCE_DIR) / "src";
  const std::regex include("^#include \"([a-z]+)/");
  std::set<std::string> folders;
  int count = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(source)) {
    if (!is_source(entry.path())) continue;
    const std::string folder = entry.path().parent_path().filename().string();
    folders.insert(folder);
    ASSERT_TRUE(rows.contains(folder)) << folder << " is not in docs/architecture.md";
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      std::smatch match;
      if (!std::regex_search(line, match, include)) continue;
      const std::string other = match[1];
      if (other == "cbc" || other == folder) continue;
      ASSERT_TRUE(rows.contains(other)) << entry.path() << ": " << line;
      EXPECT_GT(rows.at(other), rows.at(folder)) << entry.path() << ": " << line;
      ++count;
    }
  }
  EXPECT_GT(count, 100);
  EXPECT_EQ(folders.size(), rows.size()) << "docs/architecture.md has folders that are not there";
}

/// The text of the page stays true when files move.
TEST(Layers, PageNamesFilesThatExist) {
  std::ifstream page(fs::path(CBC_SOURCE_DIR) / "docs" / "architecture.md");
  const fs::path source = fs::path(CBC_SOURCE_DIR) / "src";
  const std::regex name("`([a-z_/]+\\.(?:cpp|h|fbs))`");
  int count = 0;
  for (std::string line; std::getline(page, line);) {
    for (std::sregex_iterator at(line.begin(), line.end(), name), end; at != end; ++at) {
      const std::string file = (*at)[1];
      EXPECT_TRUE(fs::exists(source / file) || fs::exists(source / "runtime" / file) ||
                  fs::exists(source / "tool" / file) || fs::exists(source.parent_path() / file))
          << file;
      ++count;
    }
  }
  EXPECT_GT(count, 20);
}

/// Users of the library see these alone.
TEST(Layers, PublicHeadersIncludeNoPrivateOnes) {
  int count = 0;
  const std::regex include("^#include \"(.*)\"");
  for (const auto& entry : fs::directory_iterator(fs::path(CBC_SOURCE_DIR) / "include" / "cbc")) {
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      std::smatch match;
      if (!std::regex_search(line, match, include)) continue;
      EXPECT_TRUE(match[1].str().starts_with("cbc/")) << entry.path() << ": " << line;
      ++count;
    }
  }
  EXPECT_GT(count, 2);
}

/// Who links with it needs no other library. FlatBuffers and xxHash are headers only.
TEST(Layers, TheRuntimeIncludesNoLibraries) {
  int count = 0;
  const std::regex include("^#include <(.*)>");
  const std::regex allowed(
      R"([a-z_]+|flatbuffers/flatbuffers\.h|xxhash\.h|(fcntl|unistd|sys/[a-z]+)\.h)");
  const fs::path runtime = fs::path(CBC_SOURCE_DIR) / "src" / "runtime";
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(runtime)) {
    if (!is_source(entry.path())) continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      std::smatch match;
      if (!std::regex_search(line, match, include)) continue;
      EXPECT_TRUE(std::regex_match(match[1].str(), allowed)) << entry.path() << ": " << line;
      ++count;
    }
  }
  EXPECT_GT(count, 100);
}

}  // namespace
}  // namespace cbc::layers_test
