#pragma once

#include <cstdint>
#include <cstdlib>

namespace cbc {

/// The number that a variable of the environment says, if it is set.
inline std::uint64_t environment(const char* name, std::uint64_t otherwise) {
  const char* value = std::getenv(name);
  return value == nullptr ? otherwise : std::strtoull(value, nullptr, 0);
}

}  // namespace cbc
