#include "cli/validators.h"

#include <charconv>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "text/decimal.h"
#include "text/quote.h"

namespace cbc::cli {
CLI::Validator whole_number(std::int64_t least, std::int64_t most) {
  const auto check = [least, most](const std::string& text) -> std::string {
    std::int64_t number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error == std::errc() && stop == end && number >= least && number <= most) {
      return {};
    }
    if (stop != end || error == std::errc::invalid_argument) {
      return fmt::format("expected a whole number, found {}", quote(text));
    }
    if (error == std::errc() && most == std::numeric_limits<std::int64_t>::max()) {
      return fmt::format("expected a whole number from {} on, found {}", least, quote(text));
    }
    return fmt::format("expected a whole number from {} to {}, found {}", least, most, quote(text));
  };
  return {check, ""};
}

CLI::Validator seconds(Microseconds least) {
  const auto check = [least](const std::string& text) -> std::string {
    const Decimal time = parse_seconds(text);
    if (time.error == DecimalError::no_error && time.value >= least) return {};
    return fmt::format("expected seconds, from {} to 1000000000, found {}",
                       format_decimal(least, 6), quote(text));
  };
  return {check, ""};
}

}  // namespace cbc::cli
