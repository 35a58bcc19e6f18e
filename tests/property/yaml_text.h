// Catalogs and scripts as YAML text, in any of the forms that a file may have: the choice of forms
// is random, the meaning is that of the model.
#pragma once

#include <string>

#include "model.h"
#include "random.h"

namespace cbc::oracle {

std::string catalog_yaml(const Catalog& catalog, Random& random);
std::string script_yaml(const Catalog& catalog, const Script& script, Random& random);

}  // namespace cbc::oracle
