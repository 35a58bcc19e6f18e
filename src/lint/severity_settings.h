#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cbc/diagnostic.h"
#include "cbc/rules.h"

namespace cbc {

/// What becomes of the findings of a rule; `allow`: they are not reported.
enum class RuleSetting : std::uint8_t { error, warn, allow };

inline constexpr std::array rule_settings = {RuleSetting::error, RuleSetting::warn,
                                             RuleSetting::allow};

/// "error", "warn", "allow": the key of a settings file, and the option.
[[nodiscard]] std::string_view name_of(RuleSetting setting);

/// Whether a rule may have a setting: a fixed one stays an error.
[[nodiscard]] bool is_possible(const Rule& rule, RuleSetting setting);

/// Whether a finding stays what it is: its rule is fixed, or it is an error though its rule is not
/// (an unknown key of a script).
[[nodiscard]] bool is_fixed(const Diagnostic& finding);

/// What people want of the severities of findings, by rule.
class SeveritySettings {
 public:
  /// The setting must be possible for this rule.
  void set(const Rule& rule, RuleSetting setting);
  /// Lets warnings count as failure.
  void make_strict() { is_strict_ = true; }

  /// Takes over what `stronger` says; where it says nothing, all stays as it is.
  void override_with(const SeveritySettings& stronger);

  /// The severity a finding is reported with, or nothing if it is not to be reported.
  [[nodiscard]] std::optional<Severity> severity_of(const Diagnostic& finding) const;
  /// Whether warnings count as failure.
  [[nodiscard]] bool is_strict() const { return is_strict_; }

 private:
  std::map<std::string_view, RuleSetting> settings_;  // names of the table of rules
  bool is_strict_ = false;
};

/// Names of rules, as they were given on the command line.
struct SeverityOptions {
  std::vector<std::string> error;
  std::vector<std::string> warn;
  std::vector<std::string> allow;
  bool strict = false;
};

/// Understands options. A message for each that is wrong is added to `errors`; the settings are
/// not to be used then.
[[nodiscard]] SeveritySettings settings_of_options(const SeverityOptions& options,
                                                   std::vector<std::string>& errors);

}  // namespace cbc
