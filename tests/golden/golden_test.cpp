// The program from outside: for each folder of cases/ a command line, and exactly what the program
// has to make of it. Files of a case:
//
//   command   one line of arguments, for the folder of the case as working directory. Blanks
//             separate them, single quotes keep blanks; "> FILE" at the end sends standard output
//             to a file (/dev/full).
//   stdin     what the program reads from standard input; if it is missing, nothing
//   stdout    what the program writes to standard output; if it is missing, nothing
//   stderr    the same for standard error
//   status    the exit status
//
// All else in the folder is input: catalogs and scripts.
//
// After a change of the output that is meant, CBC_UPDATE_GOLDEN=1 makes the tests write the last
// three anew from what the program does:
//
//   CBC_UPDATE_GOLDEN=1 build/release/tests/cbc_golden_tests
//   git diff tests/golden/cases
//
// Whatever the program did is then what it should do, so this diff is to be read line by line.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "golden/json_relations.h"
#include "golden/process.h"
#include "support/read_file.h"

namespace cbc::golden::golden_test {
namespace {

namespace fs = std::filesystem;

fs::path cases_folder() { return fs::path(CBC_SOURCE_DIR) / "tests" / "golden" / "cases"; }

std::vector<std::string> find_cases() {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(cases_folder())) {
    if (entry.is_directory()) names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool is_updating() {
  const char* const value = std::getenv("CBC_UPDATE_GOLDEN");
  return value != nullptr && std::string(value) == "1";
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words;
  bool is_in_word = false;
  bool is_quoted = false;
  for (const char character : line) {
    const bool separates = !is_quoted && (character == ' ' || character == '\n');
    if (!separates && !is_in_word) words.emplace_back();
    is_in_word = !separates;
    if (character == '\'') {
      is_quoted = !is_quoted;
    } else if (!separates) {
      words.back() += character;
    }
  }
  return words;
}

Call read_call(const fs::path& folder) {
  Call call;
  call.folder = folder;
  call.arguments = split(test::read_file(folder / "command"));
  const std::size_t count = call.arguments.size();
  if (count >= 2 && call.arguments[count - 2] == ">") {
    call.standard_output = call.arguments.back();
    call.arguments.resize(count - 2);
  }
  if (fs::exists(folder / "stdin")) call.standard_input = folder / "stdin";
  return call;
}

std::string read_if_there(const fs::path& path) {
  return fs::exists(path) ? test::read_file(path) : std::string();
}

/// Writes a file, or removes it if there is nothing to write.
void update(const fs::path& path, const std::string& text) {
  if (read_if_there(path) == text) return;
  if (text.empty()) {
    fs::remove(path);
  } else {
    std::ofstream(path, std::ios::binary) << text;
  }
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Fails if a text is not that of the file, with the first line that differs.
void expect_text_of(const fs::path& path, const std::string& actual) {
  const std::string expected = read_if_there(path);
  if (expected == actual) return;
  constexpr std::size_t context = 40;  // shown of a line before what differs
  constexpr std::size_t longest = 160;
  const std::vector<std::string> left = lines_of(expected);
  const std::vector<std::string> right = lines_of(actual);
  std::size_t line = 0;
  while (line < left.size() && line < right.size() && left[line] == right[line]) ++line;
  const std::string wanted = line < left.size() ? left[line] : "(end)";
  const std::string found = line < right.size() ? right[line] : "(end)";
  const auto differs = std::mismatch(wanted.begin(), wanted.end(), found.begin(), found.end());
  const auto equal = static_cast<std::size_t>(differs.first - wanted.begin());
  const std::size_t begin = equal > context ? equal - context : 0;
  ADD_FAILURE() << path.string() << ":" << line + 1 << ": expected\n  "
                << wanted.substr(begin, longest) << "\nbut found\n  "
                << found.substr(begin, longest);
}

bool asks_for_json(const Call& call) {
  const auto format = std::find(call.arguments.begin(), call.arguments.end(), "--format");
  return format != call.arguments.end() && format + 1 != call.arguments.end() &&
         *(format + 1) == "json";
}

class Golden : public testing::TestWithParam<std::string> {};

TEST_P(Golden, Matches) {
  const fs::path folder = cases_folder() / GetParam();
  ASSERT_TRUE(fs::exists(folder / "command")) << folder;
  const Call call = read_call(folder);
  const Result result = run(call);
  const std::string status = std::to_string(result.status) + "\n";
  if (is_updating()) {
    update(folder / "stdout", result.out);
    update(folder / "stderr", result.err);
    update(folder / "status", status);
  }
  expect_text_of(folder / "stdout", result.out);
  expect_text_of(folder / "stderr", result.err);
  expect_text_of(folder / "status", status);
  if (asks_for_json(call) && !result.out.empty()) {
    EXPECT_EQ(find_contradictions(result.out), std::vector<std::string>());
  }
}

INSTANTIATE_TEST_SUITE_P(Case, Golden, testing::ValuesIn(find_cases()),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace cbc::golden::golden_test
