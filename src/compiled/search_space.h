#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cbc {

/// The product of domain sizes, in decimal digits.
[[nodiscard]] std::string search_space(const std::vector<std::uint32_t>& domain_sizes);

}  // namespace cbc
