#pragma once

#include <cstddef>
#include <string_view>

namespace cbc {

/// How deep the arrays and objects of a JSON text are nested: 0 of a number, 1 of `[]`. Takes any
/// text, and no memory: a reader of JSON takes a hundred bytes for each level.
[[nodiscard]] std::size_t nesting_of(std::string_view json);

}  // namespace cbc
