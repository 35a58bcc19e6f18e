#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace cbc {

/// Breaks a long name into lines of about equal length, behind a blank or one of "_-./" and before
/// the capitals of CamelCase. A line may be longer than `width` characters if there is no such
/// place. The lines together are the name.
[[nodiscard]] std::vector<std::string_view> wrap_name(std::string_view name, std::size_t width);

}  // namespace cbc
