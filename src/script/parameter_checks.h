#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "catalog/allowed_values.h"
#include "catalog/catalog.h"
#include "compiled/compiled_catalog.h"
#include "diagnostic/reporter.h"
#include "text/nearest.h"
#include "yaml/document.h"

namespace cbc {

/// Checks what tasks are started with against what they declare.
class ParameterChecks {
 public:
  /// Findings have this severity. The catalog must outlive this object.
  ParameterChecks(const CompiledCatalog& catalog, Severity severity)
      : catalog_(catalog), severity_(severity) {}

  /// Reports the parameters that the task does not declare, and values that are not allowed.
  /// `given` is a mapping.
  void check(std::uint32_t task, const yaml::Node& given, Reporter& reporter);

 private:
  /// The parameters that a task declares; of equal names the first counts.
  struct Declared {
    explicit Declared(std::vector<Parameter> declared);
    Declared(const Declared&) = delete;
    Declared& operator=(const Declared&) = delete;
    const std::vector<Parameter> parameters;
    std::unordered_map<std::string_view, AllowedValues> values;
    Suggestions suggestions;
    std::string all;  ///< for messages
  };

  [[nodiscard]] Declared& declared_by(std::uint32_t task);
  void report_undeclared(std::uint32_t task, const yaml::Node& name, Reporter& reporter);

  const CompiledCatalog& catalog_;
  Severity severity_;
  std::unordered_map<std::uint32_t, Declared> declared_;  ///< of tasks that were asked for
};

}  // namespace cbc
