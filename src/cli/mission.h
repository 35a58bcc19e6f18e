#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cbc/diagnostic.h"
#include "cli/settings_finder.h"
#include "compiled/compiled_catalog.h"
#include "script/script.h"
#include "yaml/document.h"

namespace cbc::cli {

/// A script and the catalog it runs on.
struct Mission {
  std::shared_ptr<const CompiledCatalog> catalog;
  Script script;
};

/// Finds out what the files of a command line are, reads all of them, and checks every script
/// against its catalog before anything runs. Findings and problems go to standard error.
class MissionLoader {
 public:
  /// `paths`: a catalog (which may be missing if the scripts name theirs), then scripts; "-" is a
  /// script from standard input, a folder stands for the scripts in it. Empty if anything is wrong.
  [[nodiscard]] std::optional<std::vector<Mission>> load(const std::vector<std::string>& paths);

 private:
  using DocumentPointer = std::unique_ptr<const yaml::Document>;

  [[nodiscard]] DocumentPointer read(const std::string& path);
  [[nodiscard]] std::shared_ptr<const CompiledCatalog> compile(const std::string& path,
                                                               const yaml::Document& document);
  [[nodiscard]] std::shared_ptr<const CompiledCatalog> catalog_of(const std::string& script_path,
                                                                  const yaml::Document& script);
  [[nodiscard]] std::shared_ptr<const CompiledCatalog> catalog_at(const std::string& path);
  void add_script(const std::string& path, const yaml::Document& document);
  void add_folder(const std::string& path);
  void add_path(const std::string& path);
  [[nodiscard]] bool take_findings(const std::string& path, const yaml::Document& document,
                                   Diagnostics diagnostics);

  std::map<std::string, std::string> texts_;  ///< by name in messages
  std::vector<Diagnostic> findings_;
  SettingsFinder settings_;
  std::map<std::string, std::shared_ptr<const CompiledCatalog>> catalogs_;  ///< by path
  std::shared_ptr<const CompiledCatalog> given_catalog_;
  std::vector<Mission> missions_;
  bool has_failed_ = false;
};

}  // namespace cbc::cli
