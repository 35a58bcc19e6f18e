#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "compiled/compiled_catalog.h"
#include "compiled/digest.h"

namespace cbc {

/// A compiled catalog that was read from a file, verified: it may be used without any check.
struct CompiledFile {
  CompiledCatalog catalog;
  std::uint32_t format = 0;  ///< version of the file format
  std::string written_by;    ///< version of cbc that wrote it
  Digest source;             ///< of the text that was compiled
  Digest content;            ///< of all that the file holds
  std::size_t size = 0;      ///< of the file, in bytes
};

/// A file, or why there is none, for people: "it is damaged: …".
struct CompiledFileResult {
  std::optional<CompiledFile> file;
  std::string error;
};

/// Compiled files may not be larger, so that offsets in them fit in 31 bits.
inline constexpr std::size_t largest_compiled_file = std::size_t{1} << 30;

/// Whether these are the first bytes (8 are enough) of a compiled catalog.
[[nodiscard]] bool is_compiled(std::string_view first_bytes);

/// The content of the file of a catalog; empty if it would be larger than a file may be. The same
/// catalog and digest give the same bytes on every machine.
[[nodiscard]] std::string write_compiled(const CompiledCatalog& catalog, const Digest& source);

/// Maps a file into memory and verifies it. A file that may be changed while it is in use must be
/// replaced (as `cbc compile` does it), not written over.
[[nodiscard]] CompiledFileResult load_compiled(const std::string& path);

/// The same for a content in memory.
[[nodiscard]] CompiledFileResult read_compiled(std::string_view content);

}  // namespace cbc
