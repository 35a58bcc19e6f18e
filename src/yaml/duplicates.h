#pragma once

#include "diagnostic/reporter.h"
#include "yaml/document.h"

namespace cbc::yaml {

/// Reports keys that stand twice in a mapping whose keys are free.
void report_duplicate_keys(const Node& mapping, Reporter& reporter);

}  // namespace cbc::yaml
