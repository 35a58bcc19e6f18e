#pragma once

#include <string>
#include <string_view>

#include "cbc/diagnostic.h"

namespace cbc {

/// Escape sequences for a terminal, or empty texts elsewhere.
struct Style {
  std::string_view good;
  std::string_view bad;
  std::string_view strong;
  std::string_view faint;
  std::string_view error;
  std::string_view warning;
  std::string_view note;
  std::string_view caret;
  std::string_view reset;

  [[nodiscard]] constexpr std::string_view of(Severity severity) const {
    switch (severity) {
      case Severity::error:
        return error;
      case Severity::warning:
        return warning;
      case Severity::note:
        break;
    }
    return note;
  }

  /// `text` between `sequence`, which is one of the above, and the reset.
  [[nodiscard]] std::string paint(std::string_view sequence, std::string_view text) const {
    std::string painted(sequence);
    painted += text;
    return painted += reset;
  }
};

[[nodiscard]] constexpr Style plain_style() { return {}; }
[[nodiscard]] constexpr Style color_style() {
  return {.good = "\x1b[32m",
          .bad = "\x1b[31m",
          .strong = "\x1b[1m",
          .faint = "\x1b[2m",
          .error = "\x1b[1;31m",
          .warning = "\x1b[1;35m",
          .note = "\x1b[1;36m",
          .caret = "\x1b[1;32m",
          .reset = "\x1b[0m"};
}

}  // namespace cbc
