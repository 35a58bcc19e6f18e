#include "compiled/verify.h"

#include "compiled/verify_parts.h"

namespace cbc {

std::optional<std::string> find_fault(const CompiledCatalog& catalog) {
  for (const auto find_fault_of_part :
       {verify::find_size_fault, verify::find_text_fault, verify::find_group_fault,
        verify::find_value_fault, verify::find_requirement_fault, verify::find_graph_fault,
        verify::find_clique_fault, verify::find_connection_fault}) {
    if (auto fault = find_fault_of_part(catalog)) return fault;
  }
  return std::nullopt;
}

}  // namespace cbc
