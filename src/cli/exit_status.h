#pragma once

namespace cbc::cli {

/// What the program exits with (the same for every command).
enum ExitStatus : int {
  exit_ok = 0,
  exit_no = 1,        ///< the answer is "no": an expectation failed, a file is stale
  exit_unusable = 2,  ///< usage, unreadable or invalid input, output that could not be written
  exit_internal = 3   ///< an answer that the checker refuses
};

}  // namespace cbc::cli
