#include "cli/named_catalog.h"

#include <filesystem>

#include "script/reader.h"

namespace cbc::cli {

std::optional<std::string> path_of_catalog(const std::string& script_path,
                                           const yaml::Document& script) {
  const std::optional<std::string> named = catalog_of_script(script);
  if (!named) return std::nullopt;
  const std::filesystem::path folder = std::filesystem::path(script_path).parent_path();
  return (folder / *named).lexically_normal().string();
}

}  // namespace cbc::cli
