#include "coordinator/record.h"

#include <array>

namespace cbc {

std::string_view name_of(SearchStatus status) {
  static constexpr std::array<std::string_view, 4> names{"optimal", "feasible", "infeasible",
                                                         "unknown"};
  return names[static_cast<std::size_t>(status)];
}

}  // namespace cbc
