#pragma once

#include <string>

#include "cbc/rules.h"
#include "text/style.h"

namespace cbc {

/// All that is to be said about a rule, for a terminal of 80 columns.
[[nodiscard]] std::string rule_text(const Rule& rule, const Style& style);

/// All rules, one on a line: the most severe ones first, and by name.
[[nodiscard]] std::string rule_list(const Style& style);

}  // namespace cbc
