#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cbc {

/// "1 task", "2 tasks", "0 tasks".
[[nodiscard]] inline std::string quantity(std::uint64_t number, std::string_view noun) {
  return std::to_string(number) + " " + std::string(noun) + (number == 1 ? "" : "s");
}

}  // namespace cbc
