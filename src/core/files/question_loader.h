#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "core/files/file_set.h"
#include "core/property/properties.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc::cli {

/// The files of a command line that asks about a catalog, checked before anything is explored.
struct CheckedInput {
  std::shared_ptr<const CheckedCatalog> catalog;  ///< compiled
  std::vector<std::unique_ptr<const PropertyFile>> files;
  std::shared_ptr<const CompiledCatalog> old_catalog;  ///< to compare with, or null
};

/// Reads the files of a command line. Findings and other problems go to standard error.
class QuestionLoader {
 public:
  /// `paths`: a catalog, which may be missing if the property files name theirs, then property
  /// files; "-" is standard input. `old_catalog`: to compare with. Empty if anything is wrong.
  [[nodiscard]] std::optional<CheckedInput> load(const std::vector<std::string>& paths,
                                                 const std::optional<std::string>& old_catalog);

  /// The findings about the files.
  [[nodiscard]] const std::vector<Diagnostic>& findings() const { return files_.findings(); }

 private:
  void add_first(const std::string& path);
  void add_path(const std::string& path);
  void add_properties(const InputFile& file);
  void take_catalog(const std::shared_ptr<const CheckedCatalog>& catalog);
  [[nodiscard]] bool find_catalog(const InputFile& file);
  void refuse(const InputFile& file, const char* what);

  FileSet files_;
  CheckedInput input_;
  bool is_given_ = false;                     ///< the catalog, on the command line
  std::optional<std::string> named_catalog_;  ///< path of the one that the property files name
  bool has_failed_ = false;
};

}  // namespace cbc::cli
