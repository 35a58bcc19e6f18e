#pragma once

#include <optional>

#include "core/diagnostic/diagnostic.h"
#include "core/property/properties.h"
#include "core/yaml/document.h"
#include "core/yaml/values.h"
#include "runtime/compiled/compiled_catalog.h"

/// The keys of the mappings in a property file.
namespace cbc::shape {

extern const yaml::Shape property_file;
extern const yaml::Shape assumptions;
extern const yaml::Shape property;
extern const yaml::Shape condition;

}  // namespace cbc::shape

namespace cbc {

/// Reads and checks a whole property file. Conditions that contradict themselves are errors; those
/// that the catalog or the assumptions rule out are warnings, or notes where they are to be ruled
/// out. The result is empty after an error.
[[nodiscard]] std::optional<PropertyFile> read_properties(const yaml::Document& document,
                                                          const CompiledCatalog& catalog,
                                                          Diagnostics& diagnostics);

}  // namespace cbc
