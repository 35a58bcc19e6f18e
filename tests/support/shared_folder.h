#pragma once

#include <cstdlib>
#include <filesystem>

namespace cbc::test {

/// The folder of what is published elsewhere: the one that CBC_SHARED names, ../shared of the
/// repository otherwise. It need not be there.
[[nodiscard]] inline std::filesystem::path shared_folder() {
  const char* const given = std::getenv("CBC_SHARED");
  return given != nullptr ? given : CBC_SOURCE_DIR "/../shared";
}

/// Of it, the folder of the catalogs published with the original tool.
[[nodiscard]] inline std::filesystem::path shared_catalogs() {
  return shared_folder() / "catalogs";
}

}  // namespace cbc::test
