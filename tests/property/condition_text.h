#pragma once

#include <optional>
#include <string>

#include "core/property/properties.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc::plain {

/// The property as an entry of a property file.
[[nodiscard]] std::string yaml_of(const CompiledCatalog& catalog, const Property& property);

/// The property, written and read again. Empty if the reader refuses it.
[[nodiscard]] std::optional<Property> read_again(const CompiledCatalog& catalog,
                                                 const Property& property);

/// Whether the reader says that parts of the condition contradict one another.
[[nodiscard]] bool is_called_impossible(const CompiledCatalog& catalog,
                                        const StateCondition& condition);

}  // namespace cbc::plain
