// The layers of docs/architecture.md are those of the code: a folder of src/ includes itself and
// the rows below its own. A command is a folder as well: it includes its own files, what is below
// all commands, and the engine of at most one other command.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace cbc::layers_test {
namespace {

namespace fs = std::filesystem;

const fs::path source = fs::path(CBC_SOURCE_DIR) / "src";

/// The rows of the table of layers, the highest one first.
constexpr int row_of_commands = 2;

/// The row of each folder in the table.
std::map<std::string, int> rows_of_table() {
  std::ifstream page(fs::path(CBC_SOURCE_DIR) / "docs" / "architecture.md");
  std::map<std::string, int> rows;
  const std::regex name("`src/([a-z_/]+)`");
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

/// An include of one of our files by another one. Folders are relative to src.
struct Include {
  std::string from;  ///< the file
  std::string folder;
  std::string other;  ///< the folder of the included file; empty: src itself
};

std::vector<Include> all_includes() {
  std::vector<Include> includes;
  const std::regex form(R"(^#include "(?:([a-z_/]+)/)?[a-z_]+\.h")");
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(source)) {
    if (!is_source(entry.path())) continue;
    const fs::path path = entry.path().lexically_relative(source);
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      std::smatch match;
      if (!std::regex_search(line, match, form)) continue;
      if (match[1] != "cbc") includes.push_back({path, path.parent_path(), match[1]});
    }
  }
  return includes;
}

std::string command_of(const std::string& folder) { return folder.substr(0, folder.find('/')); }

TEST(Layers, IncludeOnlyLowerOnes) {
  const std::map<std::string, int> rows = rows_of_table();
  const auto row_of = [&](const std::string& folder) {
    const auto row = rows.find(folder);
    return row != rows.end()                   ? row->second
           : rows.contains(command_of(folder)) ? row_of_commands
                                               : 0;
  };
  std::set<std::string> folders;
  std::map<std::string, std::set<std::string>> other_commands;
  for (const Include& include : all_includes()) {
    if (include.folder.empty() || include.other.empty()) continue;  // main(), the table of commands
    const int row = row_of(include.folder);
    ASSERT_GT(row, 0) << include.folder << " is not in docs/architecture.md";
    folders.insert(row == row_of_commands ? command_of(include.folder) : include.folder);
    if (include.other == include.folder) continue;
    const int other_row = row_of(include.other);
    ASSERT_GT(other_row, 0) << include.from << " includes from " << include.other;
    if (other_row != row_of_commands || row < row_of_commands) {
      EXPECT_GT(other_row, row) << include.from << " includes from " << include.other;
      continue;
    }
    EXPECT_EQ(row, row_of_commands) << include.from << " includes from " << include.other;
    if (command_of(include.other) == command_of(include.folder)) continue;
    EXPECT_TRUE(include.other.find("/engine") != std::string::npos)
        << include.from << " includes from " << include.other << ", which is no engine";
    other_commands[command_of(include.folder)].insert(command_of(include.other));
  }
  for (const auto& [command, others] : other_commands) {
    EXPECT_EQ(others.size(), 1) << command << " includes the engines of several commands";
    for (const std::string& other : others) {
      EXPECT_FALSE(other_commands.contains(other))
          << command << " and " << other << " include others";
    }
  }
  EXPECT_EQ(folders.size(), rows.size()) << "docs/architecture.md has folders that are not there";
}

/// The inside of a command: the engine knows nothing of its reports, and neither of its command
/// line.
TEST(Layers, EnginesIncludeNoReports) {
  int count = 0;
  for (const Include& include : all_includes()) {
    if (include.folder.find("/engine") != std::string::npos) {
      EXPECT_TRUE(include.other.find("/report") == std::string::npos ||
                  include.other == "core/report")
          << include.from << " includes from " << include.other;
      EXPECT_NE(include.other, command_of(include.folder)) << include.from;
      ++count;
    } else if (include.folder.find("/report") != std::string::npos) {
      EXPECT_NE(include.other, command_of(include.folder)) << include.from;
      ++count;
    }
  }
  EXPECT_GT(count, 100);
}

/// The text of the page stays true when files move.
TEST(Layers, PageNamesFilesThatExist) {
  std::ifstream page(fs::path(CBC_SOURCE_DIR) / "docs" / "architecture.md");
  const std::regex name("`([a-z_/]+\\.(?:cpp|h|fbs|js))`");
  int count = 0;
  for (std::string line; std::getline(page, line);) {
    for (std::sregex_iterator at(line.begin(), line.end(), name), end; at != end; ++at) {
      const std::string file = (*at)[1];
      EXPECT_TRUE(fs::exists(source / file) || fs::exists(source / "runtime" / file) ||
                  fs::exists(source / "core" / file) || fs::exists(source.parent_path() / file))
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
