#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "catalog/catalog.h"
#include "cli/catalog_input.h"
#include "cli/settings_finder.h"
#include "compiled/compiled_catalog.h"
#include "lint/lint.h"
#include "lint/linted_file.h"
#include "lint/severity_settings.h"
#include "yaml/document.h"

namespace cbc::cli {

/// Lints the files of a command line, with the settings that hold for each. What cannot be read is
/// complained of on standard error.
class Linter {
 public:
  struct Options {
    LintOptions lint;
    SeveritySettings settings;   ///< of the command line: stronger than those of files
    std::string stdin_filename;  ///< for "-"
    bool is_to_fix = false;
    bool is_to_show_fixes = false;  ///< as a diff, instead of writing them
    bool is_to_summarize = false;   ///< compiled catalogs, too
    bool has_scripts = false;       ///< for which a compiled catalog will do
  };
  explicit Linter(Options options);

  /// A catalog, or an event script that names its catalog.
  void lint_catalog(const std::string& path);
  /// A file of a folder, in which there may be others than catalogs. Whether it is a catalog.
  bool lint_if_catalog(const std::string& path);
  /// `catalog`: path of the catalog that it runs on; if empty, the one that the script names.
  void lint_script(const std::string& path, const std::string& catalog);

  [[nodiscard]] const std::vector<LintedFile>& files() const { return files_; }
  /// Whether a file could not be read, or not be written.
  [[nodiscard]] bool has_failed() const { return has_failed_; }
  /// Whether a fault of cbc showed.
  [[nodiscard]] bool has_internal_error() const { return has_internal_error_; }
  /// Whether there is an error, or a warning in a file for which it counts as one.
  [[nodiscard]] bool has_found() const { return has_found_; }
  [[nodiscard]] const std::string& diff() const { return diff_; }
  /// Whether a file was mended in place.
  [[nodiscard]] bool has_mended() const { return has_mended_; }

 private:
  using CatalogPointer = std::shared_ptr<const CompiledCatalog>;
  struct Linted {
    LintedFile file;
    Catalog catalog;
    std::size_t errors = 0;  ///< whatever the settings say
    bool is_script = false;
    CatalogPointer compiled;  ///< if scripts can be checked against it
  };

  [[nodiscard]] Linted lint_text(const std::string& name, std::string text,
                                 const SeveritySettings& settings) const;
  void fix(const std::string& path, Linted& linted, const SeveritySettings& settings);
  [[nodiscard]] static bool write_fixed(const std::string& path, const std::string& before,
                                        const std::string& after);
  [[nodiscard]] CatalogPointer catalog_of(const yaml::Document& script, const std::string& given);
  [[nodiscard]] CatalogPointer catalog_at(const std::string& path);
  void lint_script_text(const std::string& path, std::string text, const std::string& catalog);
  void lint_catalog_text(const std::string& path, std::string text);
  void take_compiled(const CatalogInput& input);
  void add(LintedFile file, const SeveritySettings& settings);
  [[nodiscard]] std::string name_of(const std::string& path) const;

  const Options options_;
  std::vector<LintedFile> files_;
  std::map<std::string, CatalogPointer> catalogs_;  ///< by path
  SettingsFinder settings_;
  std::string diff_;
  bool has_failed_ = false;
  bool has_internal_error_ = false;
  bool has_found_ = false;
  bool has_mended_ = false;
};

}  // namespace cbc::cli
