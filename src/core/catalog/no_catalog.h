#pragma once

#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"

/// What is said of a file that is none of the catalogs that can be read.
namespace cbc {

/// Reports a document that is empty, a catalog of an older format, a file that has its sections in
/// another place, or one of another program. Returns whether it is one of these, so that nothing
/// else of it can be read.
[[nodiscard]] bool report_no_catalog(const yaml::Document& document, Reporter& reporter);

}  // namespace cbc
