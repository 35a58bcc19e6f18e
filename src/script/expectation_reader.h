#pragma once

#include "diagnostic/reporter.h"
#include "script/names.h"
#include "script/script.h"
#include "yaml/document.h"

namespace cbc {

/// Reads the value of an `expect`, and warns of what can never hold. What is wrong with it is
/// reported; the result may be used only if there were no errors.
[[nodiscard]] Expectation read_expectation(const yaml::Node& node, NameIndex& names,
                                           Reporter& reporter);

}  // namespace cbc
