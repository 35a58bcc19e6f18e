#pragma once

#include <memory>
#include <span>
#include <string>

namespace cbc::cli {

/// A file that was read, and what is to be in its place.
struct Replacement {
  std::string path;
  std::shared_ptr<const std::string> before;
  std::string after;
};

/// Replaces all of these files, or none: nothing is written if one has changed in the meantime or
/// cannot be written, and if writing fails later, those that were written get their old content
/// back. Each is replaced as a whole. Returns the exit status, after a message if it is not
/// exit_ok.
[[nodiscard]] int replace_inputs(std::span<const Replacement> replacements);

}  // namespace cbc::cli
