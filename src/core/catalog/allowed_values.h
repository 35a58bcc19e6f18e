#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/support/wording.h"
#include "core/yaml/document.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_catalog.h"

/// What a task parameter may be set to: a range of numbers ([0, 30]), a list of words ([LEFT,
/// RIGHT]), or the name of a type (string, point_list).
///
/// A type is string, boolean, integer, number or point (a list of 2 or 3 numbers, or a mapping of
/// x, y and perhaps z), or a list of these: point_list, list_of_points. Other usual names are known
/// as well: bool, int, float, text.
namespace cbc {

struct NumberRange {
  Number lowest;
  Number highest;
};

/// The range of numbers that the allowed values are, if they are one.
[[nodiscard]] std::optional<NumberRange> range_of(const Parameter& parameter);

/// Whether the allowed values are a range that goes down, so that it contains nothing.
[[nodiscard]] bool is_empty_range(const Parameter& parameter);

/// Whether the allowed values are the name of a type that is not known.
[[nodiscard]] bool is_unknown_type(const Parameter& parameter);

/// The known type whose name is most like `name`.
[[nodiscard]] std::optional<std::string> nearest_type(std::string_view name);

/// Why a value is not allowed.
struct ValueFault {
  const yaml::Node* node = nullptr;  ///< the value, or what in it is wrong
  std::string message;               ///< "expected a number from 0 to 30, found '31'"
};

/// The allowed values of a parameter, to check values against.
class AllowedValues {
 public:
  /// `parameter` must outlive this object.
  explicit AllowedValues(const Parameter& parameter);

  /// The first thing that is wrong with a value. Null counts as not given; without allowed values,
  /// or if their type is unknown, any value will do.
  [[nodiscard]] std::optional<ValueFault> find_fault(const yaml::Node& value);

 private:
  enum class Form : std::uint8_t { anything, range, choice, type };

  [[nodiscard]] std::optional<ValueFault> check_range(const yaml::Node& value) const;
  [[nodiscard]] std::optional<ValueFault> check_choice(const yaml::Node& value);

  const Parameter& parameter_;
  Form form_ = Form::anything;
  Number lowest_;
  Number highest_;
  std::unordered_set<std::string_view> texts_;  ///< of a choice
  std::unordered_set<std::string> numbers_;     ///< of a choice: those that are, by value
  Suggestions suggestions_;
  std::string expected_;
};

/// The parameters that a task declares, `task` being its place in the catalog. Ranges are empty: a
/// compiled catalog does not say where its parameters stand.
[[nodiscard]] std::vector<Parameter> parameters_of(const CompiledCatalog& catalog,
                                                   std::uint32_t task);

/// A value in quotes if it could be taken for several values, or for none.
[[nodiscard]] std::string spell_value(std::string_view value);

/// What a parameter may be set to, "[0, 30]"; the same for the same words in another order, and
/// empty if anything is allowed.
[[nodiscard]] std::string describe_allowed(Parameter parameter);

}  // namespace cbc
