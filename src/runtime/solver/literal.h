#pragma once

#include <cstdint>

namespace cbc {

/// A variable or its negation, in one number: 2 v says that variable v is true, 2 v + 1 that it is
/// false. The variables of a group are "the task runs", task by task, and then "the task has this
/// value", value by value.
using Literal = std::uint32_t;

[[nodiscard]] constexpr Literal negate(Literal literal) { return literal ^ 1U; }
[[nodiscard]] constexpr std::uint32_t variable_of(Literal literal) { return literal >> 1U; }
[[nodiscard]] constexpr bool is_negated(Literal literal) { return (literal & 1U) != 0; }

}  // namespace cbc
