#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace cbc::cli {

/// The difference of two texts in the unified format, with three lines of context, for `patch -p1`
/// and `git apply`; an empty text if there is none. `file` is the name in its head. It is made by
/// diff(1), which every system has that has `patch`; where there is none, as in a browser, says so,
/// and returns nothing.
[[nodiscard]] std::optional<std::string> unified_diff(std::string_view before,
                                                      std::string_view after,
                                                      std::string_view file);

}  // namespace cbc::cli
