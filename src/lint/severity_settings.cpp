#include "lint/severity_settings.h"

#include "lint/rule_names.h"
#include "text/quote.h"

namespace cbc {
namespace {

const std::vector<std::string>& names_for(RuleSetting setting, const SeverityOptions& options) {
  switch (setting) {
    case RuleSetting::error:
      return options.error;
    case RuleSetting::warn:
      return options.warn;
    case RuleSetting::allow:
      break;
  }
  return options.allow;
}

/// "a, b" has a blank before the second name.
std::string without_blanks(const std::string& name) {
  const std::size_t begin = name.find_first_not_of(' ');
  if (begin == std::string::npos) return {};
  return name.substr(begin, name.find_last_not_of(' ') + 1 - begin);
}

std::string name_of_option(RuleSetting setting) { return "--" + std::string(name_of(setting)); }

}  // namespace

std::string_view name_of(RuleSetting setting) {
  switch (setting) {
    case RuleSetting::error:
      return "error";
    case RuleSetting::warn:
      return "warn";
    case RuleSetting::allow:
      break;
  }
  return "allow";
}

bool is_possible(const Rule& rule, RuleSetting setting) {
  return !rule.is_fixed || setting == RuleSetting::error;
}

bool is_fixed(const Diagnostic& finding) {
  const Rule& rule = *find_rule(finding.rule);
  return rule.is_fixed || (finding.severity == Severity::error && rule.severity != Severity::error);
}

void SeveritySettings::set(const Rule& rule, RuleSetting setting) {
  settings_[rule.name] = setting;
}

void SeveritySettings::override_with(const SeveritySettings& stronger) {
  for (const auto& [rule, setting] : stronger.settings_) settings_[rule] = setting;
  is_strict_ = is_strict_ || stronger.is_strict_;
}

std::optional<Severity> SeveritySettings::severity_of(const Diagnostic& finding) const {
  const auto found = settings_.find(finding.rule);
  if (found == settings_.end() || is_fixed(finding)) return finding.severity;
  switch (found->second) {
    case RuleSetting::error:
      return Severity::error;
    case RuleSetting::warn:
      return Severity::warning;
    case RuleSetting::allow:
      break;
  }
  return std::nullopt;
}

SeveritySettings settings_of_options(const SeverityOptions& options,
                                     std::vector<std::string>& errors) {
  SeveritySettings settings;
  RuleNames names;
  std::map<std::string_view, RuleSetting> given;
  for (const RuleSetting setting : rule_settings) {
    const std::string option = name_of_option(setting);
    for (const std::string& given_name : names_for(setting, options)) {
      const std::string name = without_blanks(given_name);
      const Rule* rule = find_rule(name);
      if (rule == nullptr) {
        errors.push_back(option + ": " + names.describe_unknown(name));
        continue;
      }
      const auto [first, is_new] = given.try_emplace(rule->name, setting);
      if (first->second != setting) {
        errors.push_back(option + ": rule " + quote(name) + " is given to " +
                         name_of_option(first->second) + ", too");
      } else if (!is_possible(*rule, setting)) {
        errors.push_back(option + ": " + describe_fixed(*rule));
      } else {
        settings.set(*rule, setting);
      }
    }
  }
  if (options.strict) settings.make_strict();
  return settings;
}

}  // namespace cbc
