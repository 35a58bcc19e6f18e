#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unistd.h>

#include "compiled/compiled_catalog.h"

namespace cbc {

/// An open file, which is closed when it is no longer needed; or none.
class Descriptor {
 public:
  Descriptor() = default;
  /// Takes over the file; a negative number is none.
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }

  void set(int number) {
    close();
    number_ = number;
  }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_ = -1;
};

/// The content of a file in memory, or why there is none ("No such file or directory").
struct MappedFile {
  std::shared_ptr<const void> memory;  ///< keeps the content; null after an error
  std::string_view content;            ///< begins at a multiple of 16
  std::string error;
};

/// Maps a regular file of at most `largest` bytes into memory, read-only.
[[nodiscard]] MappedFile map_file(const std::string& path, std::size_t largest);

/// Memory with a copy of a content.
[[nodiscard]] MappedFile copy_to_memory(std::string_view content);

/// XXH3 of 128 bits, in its canonical (big-endian) form. Tells that a content is damaged or has
/// changed; it is no protection against somebody who means harm.
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

/// The bytes of compiled catalogs: see catalog.fbs, which flatc turns into code.

/// The newest format, which is the one that is written.
inline constexpr std::uint32_t newest_format = 1;

/// A file whose arrays lie in `bytes`, which begin at a multiple of 16. They are readable and
/// aligned, and the digest fits, but what is in them is not verified yet.
[[nodiscard]] CompiledFileResult decode(std::string_view bytes);

/// Tells whether two catalogs give the same answers in the same words: the digest of all that was
/// compiled. It is the same for a catalog in YAML and compiled; the path that it was named by does
/// not count, nor does the version of cbc, nor what of the source is not compiled (comments).
[[nodiscard]] Digest identity_of(const CompiledCatalog& catalog);

/// What is wrong with the arrays of a compiled catalog that came from outside, or nothing: then
/// everything that compile() ensures holds. All spans lie in readable memory and are aligned;
/// nothing else is taken for granted. Takes time linear in the size of the arrays.
[[nodiscard]] std::optional<std::string> find_fault(const CompiledCatalog& catalog);

}  // namespace cbc
