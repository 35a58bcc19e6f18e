#pragma once

#include <span>
#include <string_view>

#include "diagnostic/diagnostic.h"

namespace cbc {

/// What findings refer to: a kind of mistake, with all that is to be said about it.
struct Rule {
  std::string_view name = {};
  Severity severity = Severity::error;  ///< unless the settings say otherwise
  /// Where the rule is broken the file has no meaning, so that its severity cannot be lowered.
  bool is_fixed = false;
  bool is_of_scripts = false;  ///< the examples are event scripts, for the catalog below
  // The texts are ASCII. A paragraph is one line.
  std::string_view summary = {};      ///< one sentence: what is wrong
  std::string_view explanation = {};  ///< why it matters: paragraphs, separated by empty lines
  std::string_view example = {};      ///< a whole file that breaks this rule, and no other
  std::string_view mending = {};      ///< what to do about it: a paragraph
  std::string_view mended = {};       ///< the example as it should be
};

/// All rules, by name.
[[nodiscard]] std::span<const Rule> all_rules();

/// The rule of a name, or nullptr.
[[nodiscard]] const Rule* find_rule(std::string_view name);

/// The catalog that the examples of rules about scripts run on.
[[nodiscard]] std::string_view example_catalog();

namespace rule {

inline constexpr std::string_view conflicting_requirements = "conflicting-requirements";
inline constexpr std::string_view dead_behavior = "dead-behavior";
inline constexpr std::string_view dead_task = "dead-task";
inline constexpr std::string_view deprecated_key = "deprecated-key";
inline constexpr std::string_view duplicate_behavior = "duplicate-behavior";
inline constexpr std::string_view duplicate_exclusion = "duplicate-exclusion";
inline constexpr std::string_view duplicate_key = "duplicate-key";
inline constexpr std::string_view duplicate_parameter = "duplicate-parameter";
inline constexpr std::string_view duplicate_task = "duplicate-task";
inline constexpr std::string_view empty_range = "empty-range";
inline constexpr std::string_view exclusive_requirement = "exclusive-requirement";
inline constexpr std::string_view implicit_task = "implicit-task";
inline constexpr std::string_view impossible_expectation = "impossible-expectation";
inline constexpr std::string_view invalid_value = "invalid-value";
inline constexpr std::string_view missing_key = "missing-key";
inline constexpr std::string_view no_timeout_effect = "no-timeout-effect";
inline constexpr std::string_view on_request_and_reactive = "on-request-and-reactive";
inline constexpr std::string_view parameter_value = "parameter-value";
inline constexpr std::string_view reactive_timeout = "reactive-timeout";
inline constexpr std::string_view redundant_requirement = "redundant-requirement";
inline constexpr std::string_view required_goal = "required-goal";
inline constexpr std::string_view requirement_cycle = "requirement-cycle";
inline constexpr std::string_view requires_on_request = "requires-on-request";
inline constexpr std::string_view self_exclusion = "self-exclusion";
inline constexpr std::string_view still_available = "still-available";
inline constexpr std::string_view suspicious_minimum = "suspicious-minimum";
inline constexpr std::string_view suspicious_suitability = "suspicious-suitability";
inline constexpr std::string_view task_without_behavior = "task-without-behavior";
inline constexpr std::string_view time_order = "time-order";
inline constexpr std::string_view trivial_exclusion = "trivial-exclusion";
inline constexpr std::string_view undecided = "undecided";
inline constexpr std::string_view undeclared_parameter = "undeclared-parameter";
inline constexpr std::string_view undefined_behavior = "undefined-behavior";
inline constexpr std::string_view undefined_task = "undefined-task";
inline constexpr std::string_view unknown_key = "unknown-key";
inline constexpr std::string_view unknown_rule = "unknown-rule";
inline constexpr std::string_view unknown_type = "unknown-type";
inline constexpr std::string_view unreachable_performance = "unreachable-performance";
inline constexpr std::string_view unused_allow = "unused-allow";
inline constexpr std::string_view wrong_type = "wrong-type";
inline constexpr std::string_view yaml_syntax = "yaml-syntax";

}  // namespace rule

/// The rules, by topic: one function and one file for each.

[[nodiscard]] std::span<const Rule> attribute_rules();
[[nodiscard]] std::span<const Rule> control_rules();
[[nodiscard]] std::span<const Rule> definition_rules();
[[nodiscard]] std::span<const Rule> exclusivity_rules();
[[nodiscard]] std::span<const Rule> file_rules();
[[nodiscard]] std::span<const Rule> parameter_rules();
[[nodiscard]] std::span<const Rule> proof_rules();
[[nodiscard]] std::span<const Rule> requirement_rules();
[[nodiscard]] std::span<const Rule> script_rules();

}  // namespace cbc
