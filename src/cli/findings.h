#pragma once

#include <map>
#include <string>
#include <vector>

#include "cbc/diagnostic.h"

namespace cbc::cli {

/// Prints findings to standard error: all errors; of warnings, the first few of each rule and file;
/// no notes. `texts`: the files they are about, by name in messages.
void print_findings(const std::vector<Diagnostic>& findings,
                    const std::map<std::string, std::string>& texts);

}  // namespace cbc::cli
