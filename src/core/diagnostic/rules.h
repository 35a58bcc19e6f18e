#pragma once

#include <span>
#include <string_view>

#include "core/diagnostic/diagnostic.h"

/// The rules of lint: the kinds of findings there are, with all that is to be said about each.
namespace cbc {

/// A kind of mistake.
struct Rule {
  std::string_view name = {};
  Severity severity = Severity::error;  ///< unless the settings say otherwise
  /// A file that breaks the rule has no meaning, so the severity cannot be lowered.
  bool is_fixed = false;
  bool is_off = false;  ///< there are no findings, unless settings ask for them
  /// It takes a search, or all other rules, so that only lint checks it always; compile and solve
  /// do only if settings let it fail.
  bool needs_search = false;
  bool is_of_scripts = false;  ///< the examples are event scripts, for the catalog below
  // The texts are ASCII. A paragraph is one line.
  std::string_view summary = {};      ///< one sentence: what is wrong
  std::string_view explanation = {};  ///< why it matters: paragraphs, separated by empty lines
  std::string_view settings = {};     ///< the settings file of the examples, if they need one
  std::string_view example = {};      ///< a whole file that breaks this rule, and no other
  std::string_view mending = {};      ///< what to do about it: a paragraph
  std::string_view mended = {};       ///< the example as it should be

  /// Findings name their rule.
  constexpr operator std::string_view() const { return name; }
};

/// All rules, in the order of their names.
[[nodiscard]] std::span<const Rule> all_rules();

/// The rule of a name, or nullptr.
[[nodiscard]] const Rule* find_rule(std::string_view name);

/// The catalog that the examples of rules about scripts run on.
[[nodiscard]] std::string_view example_catalog();

/// All rules, in the order of their names. One of the files *_rules.cpp, or rules.cpp, defines
/// each; a rule that is listed but not defined does not link.
#define CBC_RULES(RULE)          \
  RULE(blocked_reactive)         \
  RULE(can_run_together)         \
  RULE(conflicting_requirements) \
  RULE(confusable_name)          \
  RULE(dead_behavior)            \
  RULE(dead_task)                \
  RULE(deprecated_key)           \
  RULE(duplicate_behavior)       \
  RULE(duplicate_exclusion)      \
  RULE(duplicate_key)            \
  RULE(duplicate_parameter)      \
  RULE(duplicate_situation)      \
  RULE(duplicate_task)           \
  RULE(empty_range)              \
  RULE(exclusive_requirement)    \
  RULE(implicit_task)            \
  RULE(impossible_expectation)   \
  RULE(invalid_value)            \
  RULE(missing_key)              \
  RULE(never_started)            \
  RULE(no_timeout_effect)        \
  RULE(older_format)             \
  RULE(on_request_and_reactive)  \
  RULE(parameter_value)          \
  RULE(reactive_timeout)         \
  RULE(redundant_minimum)        \
  RULE(redundant_requirement)    \
  RULE(required_goal)            \
  RULE(requirement_cycle)        \
  RULE(requires_on_request)      \
  RULE(self_exclusion)           \
  RULE(situation_value)          \
  RULE(still_available)          \
  RULE(suspicious_minimum)       \
  RULE(suspicious_suitability)   \
  RULE(task_without_behavior)    \
  RULE(time_order)               \
  RULE(trivial_exclusion)        \
  RULE(undecided)                \
  RULE(undeclared_parameter)     \
  RULE(undeclared_situation)     \
  RULE(undefined_behavior)       \
  RULE(undefined_task)           \
  RULE(unknown_key)              \
  RULE(unknown_rule)             \
  RULE(unknown_type)             \
  RULE(unreachable_performance)  \
  RULE(unused_allow)             \
  RULE(unused_situation)         \
  RULE(wrong_type)               \
  RULE(yaml_syntax)

namespace rule {

#define CBC_DECLARE_RULE(name) extern const Rule name;
CBC_RULES(CBC_DECLARE_RULE)
#undef CBC_DECLARE_RULE

}  // namespace rule

}  // namespace cbc
