#pragma once

#include "compiled/compiled_catalog.h"
#include "compiled/digest.h"

namespace cbc {

/// Tells whether two catalogs give the same answers in the same words: the digest of all that was
/// compiled. It is the same for a catalog in YAML and compiled; the path that it was named by does
/// not count, nor does the version of cbc, nor what of the source is not compiled (comments).
[[nodiscard]] Digest identity_of(const CompiledCatalog& catalog);

}  // namespace cbc
