#pragma once

#include <string>
#include <string_view>

namespace cbc {

/// A piece of input as it is shown in a message: in single quotes, on one line, without control
/// characters, and cut if it is long.
[[nodiscard]] std::string quote(std::string_view text);

/// The same without quotes and without a limit, for tables.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace cbc
