#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/property/properties.h"
#include "explore/properties/explore.h"
#include "model.h"
#include "question_generator.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc::plain {

/// A random small catalog, and a question about it.
struct VerifyCase {
  oracle::Catalog source;
  std::string yaml;
  CompiledCatalog catalog;
  Question question;

  [[nodiscard]] std::vector<const Property*> properties() const;
};

/// The same seed gives the same case. `with_keys`: the catalog has the keys that need not be there.
/// Throws std::runtime_error if the catalog is refused.
[[nodiscard]] VerifyCase generate_verify_case(std::uint64_t seed, bool with_keys = false);

// For reports: one line for each move; the whole case; a verdict with its script.
[[nodiscard]] std::string text_of(const CompiledCatalog& catalog, const std::vector<Move>& script);
[[nodiscard]] std::string text_of(const VerifyCase& sample);
[[nodiscard]] std::string text_of(const CompiledCatalog& catalog, const Verdict& verdict);

}  // namespace cbc::plain
