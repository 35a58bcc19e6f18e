#include "compiled/parameters.h"

namespace cbc {

std::vector<Parameter> parameters_of(const CompiledCatalog& catalog, std::uint32_t task) {
  std::vector<Parameter> parameters;
  for (const CompiledParameter& from : catalog.parameters[task]) {
    Parameter& to = parameters.emplace_back();
    to.name = catalog.texts[from.name];
    to.allowed_is_list = from.allowed_is_list != 0;
    for (const TextId text :
         catalog.allowed_values.subspan(from.first_allowed, from.allowed_count)) {
      to.allowed_values.emplace_back(catalog.texts[text]);
    }
  }
  return parameters;
}

}  // namespace cbc
