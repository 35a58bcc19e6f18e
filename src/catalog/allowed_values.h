#pragma once

#include <optional>
#include <string_view>

#include "catalog/catalog.h"

/// What a task parameter may be set to: a range of numbers ([0, 30]), a list of words ([LEFT,
/// RIGHT]), or the name of a type (string, point_list).
namespace cbc {

/// Whether the allowed values are a range that goes down, so that it contains nothing.
[[nodiscard]] bool is_empty_range(const Parameter& parameter);

/// Whether the allowed values are the name of a type that is not known.
[[nodiscard]] bool is_unknown_type(const Parameter& parameter);

/// The known type whose name is most like `name`.
[[nodiscard]] std::optional<std::string_view> nearest_type(std::string_view name);

}  // namespace cbc
