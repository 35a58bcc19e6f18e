#pragma once

#include <cstdlib>

namespace cbc::test {

/// How many random cases a test takes, or has to see at the least: of `all` the percentage that
/// CBC_RANDOM_PERCENT says, where each case takes long or the tests have to be quick; all if it
/// says nothing.
template <typename Count>
[[nodiscard]] Count rounds(Count all) {
  const char* const percent = std::getenv("CBC_RANDOM_PERCENT");
  return percent == nullptr ? all : all * static_cast<Count>(std::atoi(percent)) / 100;
}

}  // namespace cbc::test
