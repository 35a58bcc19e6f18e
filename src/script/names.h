#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "compiled/compiled_catalog.h"
#include "diagnostic/reporter.h"
#include "text/nearest.h"
#include "yaml/document.h"

namespace cbc {

/// Finds the tasks and behaviors that a script names, by their places in the catalog, and reports
/// names that there are not.
class NameIndex {
 public:
  /// The catalog must outlive this object.
  explicit NameIndex(const CompiledCatalog& catalog) : catalog_(catalog) {}

  /// `what` is the key that the name belongs to.
  [[nodiscard]] std::optional<std::uint32_t> find_task(const yaml::Node& node,
                                                       std::string_view what, Reporter& reporter);
  [[nodiscard]] std::optional<std::uint32_t> find_behavior(const yaml::Node& node,
                                                           std::string_view what,
                                                           Reporter& reporter);

  [[nodiscard]] const CompiledCatalog& catalog() const { return catalog_; }

 private:
  const CompiledCatalog& catalog_;
  // Made when the first unknown name is met.
  std::optional<Suggestions> tasks_;
  std::optional<Suggestions> behaviors_;
};

}  // namespace cbc
