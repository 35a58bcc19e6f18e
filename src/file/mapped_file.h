#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace cbc {

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

}  // namespace cbc
