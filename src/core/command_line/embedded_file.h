#pragma once

#include <string_view>

/// A file of the source tree that is part of the program; embed_files.cmake makes tables of them.
namespace cbc::cli {

struct EmbeddedFile {
  std::string_view name;  ///< its path in its folder
  std::string_view text;
};

}  // namespace cbc::cli
