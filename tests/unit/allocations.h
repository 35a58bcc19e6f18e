#pragma once

#include <cstdint>

namespace cbc::test {

/// How often this program has allocated memory so far.
[[nodiscard]] std::uint64_t allocations();

}  // namespace cbc::test
