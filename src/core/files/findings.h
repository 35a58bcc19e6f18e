#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/diagnostic/diagnostic.h"

namespace cbc::cli {

/// The texts of files, by their names in messages.
using Texts = std::map<std::string, std::shared_ptr<const std::string>>;

/// Prints findings to standard error: all errors, and the first few warnings of each rule in each
/// file, but no notes. Older names of keys, of which a file usually has many, are only counted.
/// `texts` has the files they are about.
void print_findings(const std::vector<Diagnostic>& findings, const Texts& texts);

}  // namespace cbc::cli
