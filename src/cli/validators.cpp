#include "cli/validators.h"

#include <charconv>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "text/decimal.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

std::string check_seconds(const std::string& text) {
  const Decimal time = parse_seconds(text);
  if (time.error == DecimalError::no_error && time.value > 0) return {};
  return fmt::format("expected seconds, from 0.000001 to 1000000000, found {}", quote(text));
}

}  // namespace

CLI::Validator whole_number(std::int64_t least, std::int64_t most) {
  const auto check = [least, most](const std::string& text) -> std::string {
    std::int64_t number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error == std::errc() && stop == end && number >= least && number <= most) {
      return {};
    }
    return fmt::format("expected a whole number from {} to {}, found {}", least, most, quote(text));
  };
  return {check, ""};
}

CLI::Validator seconds() { return {check_seconds, ""}; }

}  // namespace cbc::cli
