#pragma once

#include <string>
#include <string_view>

namespace cbc::bench {

/// What compiling a catalog took, in seconds of the processor, and gave.
struct Compilation {
  double parsing = 0;        ///< of the YAML
  double understanding = 0;  ///< of the catalog
  double compiling = 0;      ///< to arrays, and these to bytes
  std::string bytes;         ///< content of a compiled file

  [[nodiscard]] double total() const { return parsing + understanding + compiling; }
};

/// Throws std::runtime_error if the catalog has errors or is too large.
[[nodiscard]] Compilation compile_to_bytes(std::string_view text, const std::string& name);

/// A file that is removed at the end.
class TemporaryFile {
 public:
  /// Throws std::runtime_error if it cannot be written.
  explicit TemporaryFile(std::string_view content);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace cbc::bench
