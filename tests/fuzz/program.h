// Runs functions of the program within this process, as a shell would run the program:
// with files in memory, standard input and standard output.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "solve/solve.h"

namespace cbc::fuzz {

/// The path of a file in memory with this content. It lasts until the next call with the same
/// number; numbers are small.
[[nodiscard]] std::string memory_file(std::size_t number, std::string_view content);

/// The path of the compiled form of a catalog; empty if it has errors. It lasts for some time: that
/// of one input.
[[nodiscard]] std::string compiled_file_of(const std::string& catalog_yaml);

struct ProgramRun {
  int status = 0;      ///< exit status
  std::string output;  ///< standard output
};
/// A fault of the program (exit status 3) is a finding.
[[nodiscard]] ProgramRun run_program(std::string_view standard_input,
                                     const std::function<int()>& command);

/// Options of `cbc solve` with limits that keep a run short.
[[nodiscard]] cli::SolveOptions bounded_options();
/// The same limits for runs in the library.
[[nodiscard]] CoordinatorOptions bounded_coordinator();

}  // namespace cbc::fuzz
