#include <random>
#include <string>

#include <fmt/core.h>

#include "page/serve/server.h"

namespace cbc::serve {

std::string make_token() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

}  // namespace cbc::serve
