#pragma once

#include <string_view>

namespace cbc {

/// Escape sequences for a terminal, or empty texts elsewhere.
struct Style {
  std::string_view good;
  std::string_view bad;
  std::string_view strong;
  std::string_view faint;
  std::string_view reset;
};

[[nodiscard]] constexpr Style plain_style() { return {}; }
[[nodiscard]] constexpr Style color_style() {
  return {"\x1b[32m", "\x1b[31m", "\x1b[1m", "\x1b[2m", "\x1b[0m"};
}

}  // namespace cbc
