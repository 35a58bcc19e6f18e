#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace cbc::test {

/// A file that is there when the commands of a case are run.
struct CaseFile {
  std::string path;            ///< in the folder of the case
  std::string content;         ///< if it stands in the session
  bool is_in_session = false;  ///< otherwise it is copied: a file or a folder
};

/// A command of a session, and what has to come of it.
struct CaseCommand {
  std::vector<std::string> arguments;
  std::string input;   ///< a file in the folder of the case that it reads, or empty
  std::string output;  ///< a file that takes its standard output, or empty
  std::string out;     ///< to its standard output
  std::string err;     ///< to its standard error
  int status = 0;
  std::size_t line = 0;  ///< its line in the session, from 1
  std::size_t end = 0;   ///< the line behind the last one of what comes of it
};

/// One or more commands of a session, which are run in a folder of their own, one after the other.
struct Case {
  std::string name;
  std::filesystem::path session;
  std::vector<CaseFile> files;
  std::vector<CaseCommand> commands;
};

/// The sessions in tests/golden/sessions, whose form golden/golden_test.cpp describes. They are
/// read here, as other tests use their catalogs and scripts as well. Throw std::runtime_error if a
/// session cannot be understood.
[[nodiscard]] std::vector<Case> read_cases();
[[nodiscard]] std::vector<Case> read_session(const std::filesystem::path& path);

/// Writes the files of a case into a folder.
void unpack(const Case& one, const std::filesystem::path& folder);

/// Writes what has to come of the commands of a case into its session, and leaves all else as it
/// is.
void update_session(const Case& one);

}  // namespace cbc::test
