#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/catalog/name_place.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"
#include "runtime/compiled/compiled_catalog.h"

/// Situation variables, and the conditions of behaviors on them: how they are read, and what they
/// are called in pictures, lists and comparisons.
namespace cbc {

/// Reads the situation variables of a catalog, and the conditions of behaviors on them, with
/// findings about all that is wrong (docs/semantics.md, "Situation variables").
class SituationReader {
 public:
  /// Notes in `names` where names of variables stand.
  SituationReader(std::vector<NamePlace>& names, Reporter& reporter)
      : names_(names), reporter_(reporter) {}

  /// The section `situation:` of the catalog; null if there is none.
  [[nodiscard]] std::vector<Variable> read_variables(const yaml::Node* section);

  /// The `situation:` of a behavior; null if there is none. To be called after read_variables.
  [[nodiscard]] std::vector<Condition> read_conditions(const yaml::Node* node,
                                                       std::string_view behavior);

  /// Reports variables that have the name of a behavior, and those that no behavior names.
  void check_names(const std::vector<Behavior>& behaviors);

 private:
  void read_variable(const yaml::Node& entry);
  void read_values(const yaml::Node& node, Variable& variable);
  [[nodiscard]] std::optional<std::uint32_t> find_variable(const yaml::Node& name,
                                                           const yaml::Node& conditions,
                                                           std::string_view behavior);
  [[nodiscard]] Condition read_condition(std::uint32_t variable, const yaml::Node& key,
                                         const yaml::Node& value);
  void report_all_values(const Condition& condition);

  std::vector<NamePlace>& names_;
  Reporter& reporter_;
  std::vector<Variable> variables_;
  std::unordered_map<std::string_view, std::uint32_t> places_;  ///< of the variables, by name
  bool lacks_variables_ = false;  ///< some could not be read: an unknown name is no finding
};

/// The text of the value of a situation variable that a node gives: what is written, or, for a
/// variable without values of its own, "true" or "false" for any of YAML's booleans, quoted or not.
/// Nothing if the node gives none.
[[nodiscard]] std::optional<std::string_view> value_text(const yaml::Node& node, bool is_boolean);

/// Reports a value that a variable does not have.
void report_unknown_value(const yaml::Node& node, std::string_view variable,
                          std::span<const std::string_view> values, Reporter& reporter,
                          std::vector<Note> notes = {});

/// The values of a situation variable in which a behavior fits. The names are views of the catalog.
struct NamedCondition {
  std::string_view variable;
  bool is_boolean = false;               ///< the variable was declared without values
  std::vector<std::string_view> values;  ///< in catalog order; empty only in a bad catalog

  bool operator==(const NamedCondition&) const = default;
};

/// The conditions of a behavior, in the order of the variables.
[[nodiscard]] std::vector<NamedCondition> conditions_of(const CompiledCatalog& catalog,
                                                        BehaviorId behavior);
[[nodiscard]] std::vector<NamedCondition> conditions_of(const Catalog& catalog,
                                                        const Behavior& behavior);

/// "TARGET: near, far"; "GPS" or "not GPS" for a variable without values of its own.
[[nodiscard]] std::string describe(const NamedCondition& condition);

}  // namespace cbc
