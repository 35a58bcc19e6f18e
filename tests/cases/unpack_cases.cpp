// unpack_cases FOLDER: writes the files of each case of tests/golden/sessions into FOLDER/NAME, and
// into FOLDER/cases.json what its commands are, and what comes of them: for tests that are not in
// C++.
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "support/sessions.h"

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::filesystem::path folder = arguments[1];
  std::filesystem::remove_all(folder);
  nlohmann::ordered_json cases = nlohmann::json::array();
  for (const cbc::test::Case& one : cbc::test::read_cases()) {
    std::filesystem::create_directories(folder / one.name);
    cbc::test::unpack(one, folder / one.name);
    nlohmann::ordered_json commands = nlohmann::json::array();
    for (const cbc::test::CaseCommand& command : one.commands) {
      commands.push_back({{"arguments", command.arguments},
                          {"stdin", command.input},
                          {"redirection", command.output},
                          {"stdout", command.out},
                          {"stderr", command.err},
                          {"status", command.status}});
    }
    cases.push_back({{"case", one.name}, {"commands", commands}});
  }
  std::ofstream(folder / "cases.json") << cases.dump(1) << "\n";
  return 0;
}
