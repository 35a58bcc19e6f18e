#include "cbc/rules.h"

#include <algorithm>
#include <vector>

#include "rules/topics.h"

namespace cbc {
namespace {

std::vector<Rule> collect_rules() {
  std::vector<Rule> rules;
  for (const auto topic :
       {attribute_rules, control_rules, definition_rules, exclusivity_rules, file_rules,
        parameter_rules, proof_rules, requirement_rules, script_rules}) {
    const std::span<const Rule> more = topic();
    rules.insert(rules.end(), more.begin(), more.end());
  }
  std::sort(rules.begin(), rules.end(),
            [](const Rule& a, const Rule& b) { return a.name < b.name; });
  return rules;
}

}  // namespace

std::span<const Rule> all_rules() {
  static const std::vector<Rule> rules = collect_rules();
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
