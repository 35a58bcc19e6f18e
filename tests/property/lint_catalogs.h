// Random catalogs without errors, as text in the usual block style.
#pragma once

#include <string>

#include "random.h"

namespace cbc::mutation {

using oracle::Random;

[[nodiscard]] std::string random_catalog_text(Random& random);

}  // namespace cbc::mutation
