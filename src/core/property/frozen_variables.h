#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/property/properties.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// Variables that may change, but that `never` keeps as they are: it excludes each change of one of
/// them in every situation that can be reached.
struct FrozenVariables {
  std::vector<std::uint32_t> variables;  ///< ascending; `never` ties them to one another
  /// Variables that would have to change at once, so that some of the others can change; empty:
  /// there are none, and so there is no situation in which they have other values.
  std::vector<std::uint32_t> together;
  std::vector<std::uint32_t> coupled;  ///< those that could change then
  std::vector<std::size_t> entries;    ///< places in `never` that exclude their changes; ascending
};

/// Finds them; what takes too long to find out is not among them.
[[nodiscard]] std::vector<FrozenVariables> find_frozen_variables(const CompiledCatalog& catalog,
                                                                 const Assumptions& assumptions);

}  // namespace cbc
