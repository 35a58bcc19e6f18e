// The table of docs/architecture.md is that of the code: a folder includes itself and folders of
// lower layers, and has no more lines than its row says.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cbc::layers_test {
namespace {

namespace fs = std::filesystem;

const fs::path root = CBC_SOURCE_DIR;
const fs::path source = root / "src";

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A row of the table.
struct Room {
  int layer = 0;
  std::size_t most_lines = 0;
};

/// The rows by folder, which is relative to the project.
std::map<std::string, Room> rows_of_table() {
  std::ifstream page(root / "docs" / "architecture.md");
  std::map<std::string, Room> rows;
  const std::regex form(R"(^\| (\d+) \| `([a-z_/]+)` \| ([\d,]+) \|.*)");
  for (std::string line; std::getline(page, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, form)) continue;
    std::string lines = match[3];
    std::erase(lines, ',');
    EXPECT_TRUE(rows.emplace(match[2], Room{std::stoi(match[1]), std::stoul(lines)}).second)
        << match[2] << " is there twice";
  }
  return rows;
}

/// The row of a folder or of the nearest one around it; that of src is for the files in it alone.
const Room* row_of(const std::map<std::string, Room>& rows, const std::string& folder) {
  for (fs::path at = folder; !at.empty() && (at != "src" || folder == at); at = at.parent_path()) {
    if (const auto row = rows.find(at.string()); row != rows.end()) return &row->second;
  }
  return nullptr;
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
      if (!line.starts_with("#include") || !std::regex_search(line, match, form)) continue;
      if (match[1] != "cbc") includes.push_back({path, path.parent_path(), match[1]});
    }
  }
  return includes;
}

std::string command_of(const std::string& folder) { return folder.substr(0, folder.find('/')); }

TEST(Layers, IncludeOnlyLowerOnes) {
  const std::map<std::string, Room> rows = rows_of_table();
  for (const Include& include : all_includes()) {
    if (include.folder.empty() || include.other.empty()) continue;  // main(), the table of commands
    const Room* row = row_of(rows, "src/" + include.folder);
    const Room* other = row_of(rows, "src/" + include.other);
    ASSERT_TRUE(row && other) << include.from << " includes from " << include.other
                              << ": one of the folders is not in docs/architecture.md";
    if (row == other) continue;
    EXPECT_GT(row->layer, other->layer) << include.from << " includes from " << include.other;
  }
}

/// What a row is about is there, and what is there has a row.
TEST(Layers, AreOfFoldersThatExist) {
  const std::map<std::string, Room> rows = rows_of_table();
  ASSERT_GT(rows.size(), 30);
  for (const auto& [folder, row] : rows) EXPECT_TRUE(fs::is_directory(root / folder)) << folder;
}

std::size_t lines_of(const fs::path& file) {
  const std::string text = text_of(file);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(Layers, KeepToTheirLines) {
  const std::map<std::string, Room> rows = rows_of_table();
  std::map<const Room*, std::size_t> lines;
  for (const fs::path& top : {source, root / "include"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(top)) {
      if (!is_source(entry.path())) continue;
      const std::string folder = entry.path().lexically_relative(root).parent_path();
      const Room* row = row_of(rows, folder);
      ASSERT_TRUE(row) << folder << " is not in docs/architecture.md";
      lines[row] += lines_of(entry.path());
    }
  }
  for (const auto& [folder, row] : rows) {
    EXPECT_LE(lines[&row], row.most_lines) << folder << ": see the table of docs/architecture.md";
  }
}

/// The budget of the tests is in a sentence below the table.
TEST(Layers, TestsKeepToTheirLines) {
  std::smatch match;
  std::string page = text_of(root / "docs" / "architecture.md");
  std::erase(page, ',');
  ASSERT_TRUE(std::regex_search(
      page, match,
      std::regex(R"((\d+) lines in all files under `tests` and (\d+) files of golden)")));
  std::size_t lines = 0;
  std::size_t golden_files = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / "tests")) {
    const std::string path = entry.path().lexically_relative(root);
    if (!entry.is_regular_file() || entry.path().extension() == ".pyc") continue;
    if (path.find("/node_modules/") != std::string::npos) continue;
    lines += lines_of(entry.path());
    if (path.starts_with("tests/golden/") && !is_source(entry.path())) ++golden_files;
  }
  EXPECT_LE(lines, std::stoul(match[1])) << "see below the table of docs/architecture.md";
  EXPECT_LE(golden_files, std::stoul(match[2])) << "see below the table of docs/architecture.md";
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
