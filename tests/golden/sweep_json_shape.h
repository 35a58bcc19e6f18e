#pragma once

#include <string>
#include <vector>

namespace cbc::golden {

/// The same as find_shape_faults for a sweep: keys that are missing, too many or in another order,
/// and numbers that do not add up.
[[nodiscard]] std::vector<std::string> find_sweep_shape_faults(const std::string& text);

}  // namespace cbc::golden
