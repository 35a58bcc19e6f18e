// The program from outside: the sessions in sessions/, each a text of commands and of exactly what
// comes of them, about one topic. The first characters of a line say what it is:
//
//   ## NAME      begins a case: its files and commands get a folder of their own
//   # ...        a comment
//   + FILE       a file in this folder; its lines follow, set in by two blanks. Before the first
//                case, a file is one of every case. Without lines, it is copied: a file, or with a
//                slash at its end a folder, of shared/ or of the repository.
//   = NAME       a text, for the files of several cases: "+ FILE = NAME"
//   $ cbc ...    a command. Blanks separate arguments, single quotes keep blanks; "< FILE" and
//                "> FILE" at the end are its standard input (nothing else) and output (/dev/full)
//   two blanks   a line that it writes to standard output
//   ! ...        a line that it writes to standard error
//   [2]          its exit status, if that is not 0
//
// Of empty lines before the next command, file, comment or case, one is none of a file or of an
// output. "\ " in place of two blanks, and "\!" in place of "! ", begin a line in which \\, \n, \r
// and \xNN mean what they do in C, which ends without "\n": for bytes that editors change, such as
// blanks at the end of a line.
//
// After a change of the output that is meant, CBC_UPDATE_GOLDEN=1 makes the tests write it anew
// from what the program does, and leave all else as it is:
//
//   CBC_UPDATE_GOLDEN=1 build/release/tests/cbc_golden_tests --gtest_filter='Session/*'
//   git diff tests/golden/sessions
//
// Whatever the program did is then what it should do, so this diff is to be read line by line.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "golden/json_relations.h"
#include "golden/process.h"
#include "support/lines.h"
#include "support/scratch_folder.h"
#include "support/sessions.h"

namespace cbc::test {

inline void PrintTo(const Case& one, std::ostream* out) {
  *out << one.session.string() << ", " << one.name;
}

}  // namespace cbc::test

namespace cbc::golden::golden_test {
namespace {

namespace fs = std::filesystem;

bool is_updating() {
  const char* const value = std::getenv("CBC_UPDATE_GOLDEN");
  return value != nullptr && std::string(value) == "1";
}

/// Fails if an output is not the one in the session, with the first line that differs.
void expect_text(const std::string& place, const std::string& expected, const std::string& actual) {
  if (expected == actual) return;
  constexpr std::size_t context = 40;  // shown of a line before what differs
  constexpr std::size_t longest = 160;
  const std::vector<std::string> left = test::lines_of(expected);
  const std::vector<std::string> right = test::lines_of(actual);
  std::size_t line = 0;
  while (line < left.size() && line < right.size() && left[line] == right[line]) ++line;
  const std::string wanted = line < left.size() ? left[line] : "(end)";
  const std::string found = line < right.size() ? right[line] : "(end)";
  const auto differs = std::mismatch(wanted.begin(), wanted.end(), found.begin(), found.end());
  const auto equal = static_cast<std::size_t>(differs.first - wanted.begin());
  const std::size_t begin = equal > context ? equal - context : 0;
  ADD_FAILURE() << place << ", line " << line + 1 << ": expected\n  "
                << wanted.substr(begin, longest) << "\nbut found\n  "
                << found.substr(begin, longest);
}

bool asks_for_json(const Call& call) {
  const auto format = std::find(call.arguments.begin(), call.arguments.end(), "--format");
  return format != call.arguments.end() && format + 1 != call.arguments.end() &&
         *(format + 1) == "json";
}

class Golden : public testing::TestWithParam<test::Case> {
 protected:
  Result run_in_folder(const test::CaseCommand& command) {
    Call call{command.arguments, folder.path()};
    if (!command.input.empty()) call.standard_input = call.folder / command.input;
    if (!command.output.empty()) call.standard_output = call.folder / command.output;
    Result result = run(call);
    if (asks_for_json(call) && !result.out.empty()) {
      EXPECT_EQ(find_contradictions(result.out), std::vector<std::string>());
    }
    return result;
  }

  test::ScratchFolder folder;
};

TEST_P(Golden, Matches) {
  test::Case tested = GetParam();
  test::unpack(tested, folder.path());
  for (test::CaseCommand& command : tested.commands) {
    Result result = run_in_folder(command);
    const std::string place = tested.session.string() + ":" + std::to_string(command.line) + ": ";
    if (!is_updating()) {
      expect_text(place + "standard output", command.out, result.out);
      expect_text(place + "standard error", command.err, result.err);
      EXPECT_EQ(command.status, result.status) << place << "exit status";
    }
    command.out = std::move(result.out);
    command.err = std::move(result.err);
    command.status = result.status;
  }
  if (is_updating()) test::update_session(tested);
}

INSTANTIATE_TEST_SUITE_P(Session, Golden, testing::ValuesIn(test::read_cases()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace cbc::golden::golden_test
