#pragma once

#include <string>
#include <string_view>

#include "cbc/rules.h"
#include "text/nearest.h"

namespace cbc {

/// Explains what is wrong with rules that people name.
class RuleNames {
 public:
  RuleNames();

  /// Of a name that no rule has: with the nearest that one has.
  [[nodiscard]] std::string describe_unknown(std::string_view name);

 private:
  Suggestions suggestions_;
};

/// Why a rule cannot be anything but an error.
[[nodiscard]] std::string describe_fixed(const Rule& rule);

}  // namespace cbc
