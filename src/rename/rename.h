#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/catalog/name_place.h"
#include "core/catalog/renaming.h"
#include "core/check/check.h"
#include "core/files/file_search.h"
#include "core/files/file_set.h"

namespace cbc::cli {

/// What the command line of `cbc rename` says.
struct RenameCommand {
  std::string kind;  ///< see name_of(NameKind)
  std::string old_name;
  std::string new_name;
  std::vector<std::string> paths;
  bool diff = false;  ///< what would change, instead of changing it
  std::uint64_t max_states = 10'000;
};

/// A file in which the name may stand.
struct NamedFile {
  enum class Kind : std::uint8_t { catalog, script, properties, settings };
  Kind kind = Kind::catalog;
  std::shared_ptr<const InputFile> file;
  std::vector<NamePlace> names;
  /// Of a catalog itself; of a script or a property file the one it is about; null for settings.
  std::shared_ptr<const CheckedCatalog> catalog;
};

/// The files of a command line that a renaming is about: the catalogs that have the old name, then
/// the files that are about these. Messages about others go to standard error.
class NamedFiles {
 public:
  explicit NamedFiles(const Renaming& renaming) : renaming_(renaming) {}

  /// Empty if anything is wrong.
  [[nodiscard]] std::optional<std::vector<NamedFile>> load(const std::vector<std::string>& paths);

 private:
  void take(const FoundFile& found);
  void take_catalog(const FoundFile& found, NamedBy named_by);
  void take_about_catalog(const NamedFile& about, const std::string& folder);
  [[nodiscard]] const NamedFile* catalog_of(const InputFile& file, const std::string& folder);
  [[nodiscard]] bool has_name(const NamedFile& catalog, const std::string& name) const;
  void keep_renamed();
  void report_missing();
  void report_taken(const NamedFile& catalog);
  void take_settings(const NamedFile& catalog, const std::vector<std::string>& paths);
  [[nodiscard]] bool is_among(const std::string& settings,
                              const std::vector<std::string>& paths) const;
  void fail() { has_failed_ = true; }

  const Renaming& renaming_;
  FileSet files_;
  std::vector<std::unique_ptr<NamedFile>> catalogs_;
  CatalogFolders folders_;
  /// Scripts and property files, and the folder of the command line that each is in.
  std::vector<std::pair<NamedFile, std::string>> others_;
  std::set<std::string> taken_;  ///< files, whatever they are called
  std::vector<NamedFile> result_;
  bool has_failed_ = false;
};

/// Renames, and prints what was done. Returns the exit status.
[[nodiscard]] int rename(const RenameCommand& command);

}  // namespace cbc::cli
