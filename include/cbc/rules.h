#pragma once

#include <string_view>

/// Names of the rules that findings refer to.
namespace cbc::rule {

inline constexpr std::string_view yaml_syntax = "yaml-syntax";
inline constexpr std::string_view unknown_key = "unknown-key";
inline constexpr std::string_view missing_key = "missing-key";
inline constexpr std::string_view wrong_type = "wrong-type";
inline constexpr std::string_view invalid_value = "invalid-value";
inline constexpr std::string_view duplicate_key = "duplicate-key";
inline constexpr std::string_view duplicate_task = "duplicate-task";
inline constexpr std::string_view duplicate_behavior = "duplicate-behavior";
inline constexpr std::string_view undefined_task = "undefined-task";
inline constexpr std::string_view undefined_behavior = "undefined-behavior";
inline constexpr std::string_view requirement_cycle = "requirement-cycle";
inline constexpr std::string_view exclusive_requirement = "exclusive-requirement";
inline constexpr std::string_view on_request_and_reactive = "on-request-and-reactive";
inline constexpr std::string_view deprecated_key = "deprecated-key";
inline constexpr std::string_view time_order = "time-order";

}  // namespace cbc::rule
