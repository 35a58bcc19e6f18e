#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/compiled/compiled_catalog.h"

/// Compiled catalogs as files: reading with verification, writing, and digests.
namespace cbc {

/// XXH3 of 128 bits, in its canonical (big-endian) form. It tells whether a content is damaged or
/// has changed, but does not protect against forgery.
struct Digest {
  std::array<std::uint8_t, 16> bytes{};

  bool operator==(const Digest&) const = default;
};

[[nodiscard]] Digest digest_of(std::string_view content);

/// 32 hexadecimal digits, as `xxh128sum` prints them.
[[nodiscard]] std::string to_hex(const Digest& digest);

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

/// The newest format, which is the one that is written.
inline constexpr std::uint32_t newest_format = 3;

/// A file whose arrays lie in `bytes`, which begin at a multiple of 16. The arrays are readable and
/// aligned, and the digest is right, but they are not verified, and the catalog has no names yet.
[[nodiscard]] CompiledFileResult decode(std::string_view bytes);

/// The digest of all that was compiled: catalogs with the same one give the same answers in the
/// same words. It does not depend on whether a catalog comes from YAML or from a compiled file, on
/// its path, on the version of cbc, or on parts of the source that are not compiled, such as
/// comments.
[[nodiscard]] Digest identity_of(const CompiledCatalog& catalog);

/// What is wrong with the arrays of a decoded catalog, or nothing: then everything that compile()
/// ensures holds. Takes time and memory linear in the size of the arrays.
[[nodiscard]] std::optional<std::string> find_fault(const CompiledCatalog& catalog);

}  // namespace cbc
