#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/report/table.h"
#include "runtime/base/text.h"

namespace cbc {

/// A triangular matrix as text, after an empty line: numbered rows with these names, shortened
/// where they are long, and in each a sign for each pair with a name before it, under the number
/// of that name. It comes in as many parts as it takes for its columns to fit. `cell`: the sign of
/// a pair, by the places of both names; the row is greater than the column.
[[nodiscard]] std::string pair_matrix(
    std::vector<std::string> names, const Style& style,
    const std::function<Table::Cell(std::size_t row, std::size_t column)>& cell);

}  // namespace cbc
