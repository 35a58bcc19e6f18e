#pragma once

#include <string>

#include "cbc/rules.h"

namespace cbc {

/// Everything about a rule that is more than its summary, as Markdown: why it matters, an example,
/// and how it is mended.
[[nodiscard]] std::string rule_markdown(const Rule& rule);

}  // namespace cbc
