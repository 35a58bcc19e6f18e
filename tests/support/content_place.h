#pragma once

#include <cstddef>
#include <string>

namespace cbc::test {

/// Where the content lies in a compiled file.
struct ContentPlace {
  std::size_t digest = 0;  ///< first byte of its digest
  std::size_t begin = 0;
  std::size_t size = 0;
};

/// Throws std::runtime_error if the file is not as it should be.
[[nodiscard]] ContentPlace find_content(const std::string& file);

/// Sets the digest to that of the content, as somebody does who means to deceive.
void sign_anew(std::string& file, const ContentPlace& place);

}  // namespace cbc::test
