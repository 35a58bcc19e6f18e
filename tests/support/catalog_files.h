#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace cbc::test {

/// The catalogs in a folder, that is its YAML files but for missions and property files, in the
/// order of their names; none if there is no such folder.
[[nodiscard]] inline std::vector<std::filesystem::path> catalog_files(
    const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".yaml") && !name.ends_with(".mission.yaml") &&
        !name.ends_with(".properties.yaml")) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace cbc::test
