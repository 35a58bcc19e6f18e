#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "core/property/properties.h"
#include "core/script/names.h"
#include "core/script/script.h"
#include "core/yaml/document.h"
#include "core/yaml/values.h"
#include "runtime/compiled/compiled_catalog.h"

/// The keys of the mappings in a property file.
namespace cbc::shape {

extern const yaml::Shape property_file;
extern const yaml::Shape assumptions;
extern const yaml::Shape faults;
extern const yaml::Shape failures;
extern const yaml::Shape suspended;
extern const yaml::Shape property;
extern const yaml::Shape condition;

}  // namespace cbc::shape

namespace cbc {

/// Reads and checks a whole property file. Conditions that contradict themselves are errors; those
/// that the catalog or the assumptions rule out are warnings, or notes where they are to be ruled
/// out. `names`, if not null, takes where names of the catalog stand. The result is empty after an
/// error.
[[nodiscard]] std::optional<PropertyFile> read_properties(const yaml::Document& document,
                                                          const CompiledCatalog& catalog,
                                                          Diagnostics& diagnostics,
                                                          std::vector<NamePlace>* names = nullptr);

/// Whether a file has the key `properties` and no property. Without the key it only says what is
/// assumed.
[[nodiscard]] bool lacks_properties(const yaml::Document& document, const PropertyFile& file);

// Parts of the reader of property files: assumptions and conditions, and what these share.

/// With the numbers of the compiled catalog in place of those of the file.
[[nodiscard]] SituationPart part_of(const Situation& situation, const CompiledCatalog& catalog);

/// Reads the values of the keys `assume` and `initially`; null if there is none. `knows_all`: no
/// other key may be one of them, misspelt. Mistakes are reported; the result may be used only if
/// there was no error.
[[nodiscard]] Assumptions read_assumptions(const yaml::Node* assume, const yaml::Node* initially,
                                           bool knows_all, NameIndex& names, Reporter& reporter);

/// Reads the condition that is the value of the key `what`. Mistakes are reported; the result may
/// be used only if there was no error.
[[nodiscard]] StateCondition read_condition(const yaml::Node& node, std::string_view what,
                                            NameIndex& names, Reporter& reporter);

}  // namespace cbc
