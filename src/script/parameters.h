#pragma once

#include <optional>

#include "diagnostic/reporter.h"
#include "script/script.h"
#include "yaml/document.h"

namespace cbc {

/// Reads the parameters of a start: a mapping of anything.
///
/// The canonical form compares them as data: scalars by their text, mappings without order; null,
/// empty and absent are alike at every depth. The JSON form keeps the order, and numbers, booleans
/// and nulls where the text is plain and JSON would write it in just this way.
[[nodiscard]] std::optional<Parameters> read_parameters(const yaml::Node& node, Reporter& reporter);

}  // namespace cbc
