#pragma once

#include <string>

#include "catalog/catalog.h"
#include "text/quote.h"

namespace cbc {

/// What a behavior is called in messages; its name may be missing in the file.
[[nodiscard]] inline std::string describe(const Behavior& behavior) {
  return behavior.name.empty() ? "a behavior" : "behavior " + quote(behavior.name);
}

}  // namespace cbc
