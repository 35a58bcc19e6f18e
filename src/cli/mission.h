#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/catalog_loader.h"
#include "cli/input_files.h"
#include "compiled/compiled_catalog.h"
#include "script/script.h"
#include "yaml/document.h"

namespace cbc::cli {

/// A script and the catalog it runs on.
struct Mission {
  std::shared_ptr<const CompiledCatalog> catalog;
  std::optional<std::string> named_catalog;  ///< path of the catalog that the script names
  Script script;
};

/// Finds out what the files of a command line are, reads all of them, and checks every script
/// against its catalog before anything runs. Findings and problems go to standard error.
class MissionLoader {
 public:
  /// `paths`: a catalog (which may be missing if the scripts name theirs), then scripts; "-" is a
  /// script from standard input, a folder stands for the scripts in it. Empty if anything is wrong.
  [[nodiscard]] std::optional<std::vector<Mission>> load(const std::vector<std::string>& paths);

  /// What was found in the files.
  [[nodiscard]] const std::vector<Diagnostic>& findings() const { return files_.findings(); }

 private:
  [[nodiscard]] std::shared_ptr<const CompiledCatalog> catalog_of(const std::string& script_path,
                                                                  const yaml::Document& script);
  void add_script(const std::string& path, const yaml::Document& document);
  void add_folder(const std::string& path);
  void add_path(const std::string& path);
  void complain_of_catalog(const std::string& path);

  InputFiles files_;
  CatalogLoader catalogs_{files_};
  std::shared_ptr<const CompiledCatalog> given_catalog_;
  bool is_given_catalog_bad_ = false;
  std::vector<Mission> missions_;
  bool has_failed_ = false;
};

}  // namespace cbc::cli
