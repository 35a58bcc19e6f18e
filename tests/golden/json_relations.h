#pragma once

#include <string>
#include <vector>

namespace cbc::golden {

/// Where the numbers, places and lists of a report in JSON do not fit one another, one line each:
/// what its schema in schemas/ cannot tell. Throws if a member is missing.
[[nodiscard]] std::vector<std::string> find_contradictions(const std::string& text);

}  // namespace cbc::golden
