#pragma once

#include <string_view>

namespace cbc::test {

/// A small catalog with something of everything: several groups, tasks and behaviors of all kinds,
/// requirements and minimums, exclusivity, parameters, packages, timeouts.
extern const std::string_view rich_catalog;

}  // namespace cbc::test
