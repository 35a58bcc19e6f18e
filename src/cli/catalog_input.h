#pragma once

#include <optional>
#include <string>

#include "compiled/compiled_file.h"

namespace cbc::cli {

/// A file that was read: a text, or a compiled catalog. Its content tells which, not its name.
struct CatalogInput {
  std::string path;
  std::string content;  ///< empty if it is a compiled catalog that can be mapped into memory
  bool is_compiled = false;
};

/// Reads a file, or standard input for "-". Prints why not to standard error.
[[nodiscard]] std::optional<CatalogInput> read_catalog_input(const std::string& path);

/// The compiled catalog that was read. Prints why there is none to standard error.
[[nodiscard]] std::optional<CompiledFile> load(const CatalogInput& input);

}  // namespace cbc::cli
