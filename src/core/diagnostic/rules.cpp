#include "core/diagnostic/rules.h"

#include <algorithm>

#include "rule_texts.h"

namespace cbc {

std::string_view example_catalog() {
  return R"(behaviors:
- behavior: ROTATE_WITH_PID
  task: ROTATE
  requires:
  - task: LOCALIZE
- behavior: GPS
  task: LOCALIZE
- behavior: VISUAL_ODOMETRY
  task: LOCALIZE
  suitability: 80
tasks:
- task: ROTATE
  parameters:
  - parameter: angle
    allowed_values: [-360, 360]
- task: LOCALIZE
  execution_goal: keep_running
  start_on_request: FALSE
)";
}

std::span<const Rule> all_rules() {
#define CBC_COPY_RULE(name) rule::name,
  static const Rule rules[] = {CBC_RULES(CBC_COPY_RULE)};
#undef CBC_COPY_RULE
  return rules;
}

const Rule* find_rule(std::string_view name) {
  const std::span<const Rule> rules = all_rules();
  const auto found = std::lower_bound(
      rules.begin(), rules.end(), name,
      [](const Rule& rule, std::string_view wanted) { return rule.name < wanted; });
  return found == rules.end() || found->name != name ? nullptr : &*found;
}

}  // namespace cbc
