#include "explain/reason.h"

namespace cbc {

std::string_view name_of(Reason::Kind kind) {
  static constexpr std::array<std::string_view, 10> names{
      "priority", "no_behavior", "protected",   "exclusive", "on_request",
      "requires", "performance", "unavailable", "faulty",    "finished"};
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace cbc
