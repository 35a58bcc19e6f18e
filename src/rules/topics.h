#pragma once

#include <span>

#include "cbc/rules.h"

/// The rules, by topic: one function and one file for each.
namespace cbc {

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
