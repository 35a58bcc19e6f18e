#pragma once

#include <string>
#include <string_view>

namespace cbc {

/// Whether a character would do something else on a terminal than print: control characters, and
/// those that break lines or turn the direction of what follows.
[[nodiscard]] bool is_control(char32_t character);

/// A piece of input as it is shown in a message: in single quotes, on one line, without control
/// characters, and cut if it is long.
[[nodiscard]] std::string quote(std::string_view text);

/// The same without quotes and without a limit, for tables.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace cbc
