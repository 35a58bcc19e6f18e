#pragma once

#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

/// Finds the files of a command line whose folders may have files of any kind, and the catalogs of
/// those that name none.
namespace cbc::cli {

/// A file of a command line.
struct FoundFile {
  std::string path;
  bool is_named = false;  ///< on the command line, so it counts whatever it is
  std::string folder;     ///< on the command line that contains the file, or empty
};

/// The files of all paths, each once; of folders those with one of the suffixes (".yaml"). Prints
/// which folders cannot be read, and sets `has_failed`.
[[nodiscard]] std::vector<FoundFile> find_files(const std::vector<std::string>& paths,
                                                std::initializer_list<std::string_view> suffixes,
                                                bool& has_failed);

/// The catalogs of a command line, by folder.
class CatalogFolders {
 public:
  void add(const std::string& path);

  /// The only catalog in the nearest folder that has catalogs: the file's own one, or one above it
  /// up to `top`, the folder of the command line. Empty if there is none, or several.
  [[nodiscard]] std::string beside(const std::string& file, const std::string& top) const;

 private:
  std::map<std::filesystem::path, std::vector<std::string>> catalogs_;
};

}  // namespace cbc::cli
