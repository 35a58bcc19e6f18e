#include "core/files/file_search.h"

#include <cstddef>
#include <unordered_map>

#include "core/files/read.h"

namespace cbc::cli {
namespace {

/// The same for './robot.yaml' and 'robot.yaml'.
std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.lexically_normal().parent_path();
}

}  // namespace

std::vector<FoundFile> find_files(const std::vector<std::string>& paths,
                                  std::initializer_list<std::string_view> suffixes,
                                  bool& has_failed) {
  std::vector<FoundFile> files;
  std::unordered_map<std::string, std::size_t> places;
  const auto file_of = [&](const std::string& path) -> FoundFile& {
    const auto [known, is_new] = places.try_emplace(path, files.size());
    if (is_new) files.push_back({path, false, {}});
    return files[known->second];
  };
  for (const std::string& path : paths) {
    if (!is_folder(path)) {
      file_of(path).is_named = true;
    } else {
      for (const std::string& file : list_folder(path, suffixes, has_failed)) {
        file_of(file).folder = path;
      }
    }
  }
  return files;
}

void CatalogFolders::add(const std::string& path) { catalogs_[folder_of(path)].push_back(path); }

std::string CatalogFolders::beside(const std::string& file, const std::string& top) const {
  const std::filesystem::path highest = folder_of(std::filesystem::path(top) / "any");
  std::filesystem::path folder = folder_of(file);
  for (;;) {
    if (const auto known = catalogs_.find(folder); known != catalogs_.end()) {
      return known->second.size() == 1 ? known->second.front() : std::string();
    }
    if (folder == highest || !folder.has_relative_path()) return {};
    folder = folder.parent_path();
  }
}

}  // namespace cbc::cli
