#include "cbc/rules.h"

#include <algorithm>
#include <array>

namespace cbc {
namespace {

constexpr bool fixed = true;

constexpr std::array rules = {
    Rule{rule::conflicting_requirements, Severity::warning},
    Rule{rule::dead_behavior, Severity::warning},
    Rule{rule::dead_task, Severity::warning},
    Rule{rule::deprecated_key, Severity::warning},
    Rule{rule::duplicate_behavior, Severity::error, fixed},
    Rule{rule::duplicate_exclusion, Severity::note},
    Rule{rule::duplicate_key, Severity::error, fixed},
    Rule{rule::duplicate_parameter, Severity::warning},
    Rule{rule::duplicate_task, Severity::warning},
    Rule{rule::empty_range, Severity::warning},
    Rule{rule::exclusive_requirement, Severity::error},
    Rule{rule::implicit_task, Severity::note},
    Rule{rule::invalid_value, Severity::error, fixed},
    Rule{rule::missing_key, Severity::error, fixed},
    Rule{rule::no_timeout_effect, Severity::note},
    Rule{rule::on_request_and_reactive, Severity::error, fixed},
    Rule{rule::parameter_value, Severity::error},
    Rule{rule::reactive_timeout, Severity::warning},
    Rule{rule::redundant_requirement, Severity::note},
    Rule{rule::required_goal, Severity::warning},
    Rule{rule::requirement_cycle, Severity::error, fixed},
    Rule{rule::requires_on_request, Severity::warning},
    Rule{rule::self_exclusion, Severity::warning},
    Rule{rule::still_available, Severity::warning},
    Rule{rule::suspicious_minimum, Severity::warning},
    Rule{rule::suspicious_suitability, Severity::warning},
    Rule{rule::task_without_behavior, Severity::warning},
    Rule{rule::time_order, Severity::error, fixed},
    Rule{rule::trivial_exclusion, Severity::note},
    Rule{rule::undecided, Severity::note},
    Rule{rule::undeclared_parameter, Severity::error},
    Rule{rule::undefined_behavior, Severity::error, fixed},
    Rule{rule::undefined_task, Severity::error, fixed},
    Rule{rule::unknown_key, Severity::warning},
    Rule{rule::unknown_rule, Severity::warning},
    Rule{rule::unknown_type, Severity::note},
    Rule{rule::unreachable_performance, Severity::warning},
    Rule{rule::unused_allow, Severity::warning},
    Rule{rule::wrong_type, Severity::error, fixed},
    Rule{rule::yaml_syntax, Severity::error, fixed},
};

}  // namespace

std::span<const Rule> all_rules() { return rules; }

const Rule* find_rule(std::string_view name) {
  const auto found = std::find_if(rules.begin(), rules.end(),
                                  [name](const Rule& rule) { return rule.name == name; });
  return found == rules.end() ? nullptr : &*found;
}

std::string_view example_catalog() { return {}; }

}  // namespace cbc
