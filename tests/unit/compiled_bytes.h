#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace cbc::test {

/// A small catalog with something of everything: several groups, tasks and behaviors of all kinds,
/// requirements and minimums, exclusivity, parameters, packages, timeouts.
extern const std::string_view rich_catalog;

/// The file of a catalog.
[[nodiscard]] std::string compiled_bytes(std::string_view yaml);

/// Where the content lies in a compiled file.
struct ContentPlace {
  std::size_t digest = 0;  ///< first byte of its digest
  std::size_t begin = 0;
  std::size_t size = 0;
};
[[nodiscard]] ContentPlace find_content(const std::string& file);

/// Sets the digest to that of the content, as somebody does who means to deceive.
void sign_anew(std::string& file, const ContentPlace& place);

}  // namespace cbc::test
