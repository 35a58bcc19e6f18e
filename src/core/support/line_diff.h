#pragma once

#include <string>
#include <string_view>

namespace cbc {

/// The difference of two texts in the unified format, with three lines of context, for `patch -p1`
/// and `git apply`; empty if there is none. `file` is the name in its head. The work is
/// bounded: where much has changed in one place the difference may not be the shortest.
[[nodiscard]] std::string unified_diff(std::string_view before, std::string_view after,
                                       std::string_view file);

}  // namespace cbc
