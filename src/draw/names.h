#pragma once

#include <string>
#include <string_view>

#include "cbc/units.h"

namespace cbc::draw {

/// The id of what has this name: "task:HOVER". Different names have different ids; these are valid
/// UTF-8, without control characters, and without '#', which is free for numbers behind them.
[[nodiscard]] std::string id_of(std::string_view kind, std::string_view name);

/// A name as it is shown. One that could be overlooked stands in quotes.
[[nodiscard]] std::string label_of(std::string_view name);

/// "≥ 80 %"
[[nodiscard]] std::string at_least(Millionths degree);

}  // namespace cbc::draw
