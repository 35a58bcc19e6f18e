#pragma once

#include <string>
#include <vector>

namespace cbc::golden {

/// What of a text is not as the JSON of `cbc lint` has to be: keys that are missing, too many or in
/// another order, values of another type, numbers that do not add up. Empty if all is well.
[[nodiscard]] std::vector<std::string> find_lint_shape_faults(const std::string& text);

}  // namespace cbc::golden
