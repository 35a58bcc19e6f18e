#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cbc/diagnostic.h"
#include "cli/catalog_input.h"
#include "cli/settings_finder.h"
#include "yaml/document.h"

namespace cbc::cli {

/// A file of a command line: YAML, or a compiled catalog.
struct InputFile {
  std::string path;
  std::unique_ptr<const yaml::Document> document;  ///< null: a compiled catalog
  CatalogInput compiled;
};

/// Reads the files of a command line, and collects what is found in them.
class InputFiles {
 public:
  InputFiles() = default;
  InputFiles(const InputFiles&) = delete;
  InputFiles& operator=(const InputFiles&) = delete;

  /// Empty if it cannot be read, which is complained of, or is no YAML, which is a finding.
  [[nodiscard]] std::optional<InputFile> read(const std::string& path);

  /// The same of a file that has to be a catalog: a script is complained of.
  [[nodiscard]] std::optional<InputFile> read_catalog(const std::string& path);

  /// The text of a YAML file.
  [[nodiscard]] const std::string& text_of(const yaml::Document& document) const {
    return texts_.at(document.file());
  }

  /// Takes over the findings about a file, but for those that its comments and settings allow.
  /// False if there are errors.
  [[nodiscard]] bool take_findings(const std::string& path, const yaml::Document& document,
                                   Diagnostics diagnostics);

  /// Prints all findings to standard error, file by file.
  void print_findings();

  /// All that was found in all files.
  [[nodiscard]] const std::vector<Diagnostic>& findings() const { return findings_; }

 private:
  std::map<std::string, std::string> texts_;  ///< by name in messages
  std::vector<Diagnostic> findings_;
  SettingsFinder settings_;
};

}  // namespace cbc::cli
