#pragma once

#include <cstdint>

/// Numbers of 64 bits with a fixed binary point: the functions of a math library may differ in the
/// last bit from machine to machine, and compiled catalogs must not.
namespace cbc::fixed {

__extension__ using Wide = unsigned __int128;  // -Wpedantic knows no such type

inline constexpr unsigned bits = 60;  ///< after the binary point
inline constexpr std::uint64_t one = std::uint64_t{1} << bits;
inline constexpr std::uint64_t log_of_two = 799'144'290'325'165'979;  ///< ln(2) * 2^60

[[nodiscard]] constexpr std::uint64_t multiply(std::uint64_t a, std::uint64_t b) {
  return static_cast<std::uint64_t>((Wide{a} * b) >> bits);
}

}  // namespace cbc::fixed
