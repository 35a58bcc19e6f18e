// Catalogs, scripts and other files of the project, of which inputs are made.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc::fuzz {

/// Compiles a catalog; null if it has errors. Those of the last inputs are kept, as the mutator
/// rarely changes them.
[[nodiscard]] std::shared_ptr<const CompiledCatalog> catalog_of(const std::string& yaml);

/// The script on the catalog; empty if it has errors.
[[nodiscard]] std::optional<Script> script_of(const std::string& yaml,
                                              const CompiledCatalog& catalog);

/// The catalogs in catalogs/, the examples of all rules, and a small one with something of
/// everything.
[[nodiscard]] std::vector<std::string> catalog_texts();

struct Pair {
  std::string catalog;
  std::string text;
};
/// Catalogs that compile, each with a script: those of the golden cases, of catalogs/, and of the
/// examples of rules.
[[nodiscard]] std::vector<Pair> catalogs_with_scripts();
/// The same with property files.
[[nodiscard]] std::vector<Pair> catalogs_with_properties();
/// Settings files with a catalog they apply to.
[[nodiscard]] std::vector<Pair> settings_with_catalogs();

/// A part of a script, with a line of JSON for each of its events, as a stream has them; empty if
/// the script has no list of events.
[[nodiscard]] std::string stream_of(const std::string& script_yaml);

}  // namespace cbc::fuzz
