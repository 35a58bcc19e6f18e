#include "core/check/severity_settings.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <system_error>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/yaml/document.h"
#include "core/yaml/values.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

std::vector<std::string_view> names_of_rules() {
  std::vector<std::string_view> names;
  for (const Rule& rule : all_rules()) names.push_back(rule.name);
  return names;
}

/// Whether a rule may have a setting: a fixed one stays an error.
bool is_possible(const Rule& rule, RuleSetting setting) {
  return !rule.is_fixed || setting == RuleSetting::error;
}

/// By setting.
constexpr std::vector<std::string> SeverityOptions::*names_for[] = {
    &SeverityOptions::error, &SeverityOptions::warn, &SeverityOptions::note,
    &SeverityOptions::allow};

/// Of "a, b", the second name begins with a blank.
std::string without_blanks(const std::string& name) {
  const std::size_t begin = name.find_first_not_of(' ');
  if (begin == std::string::npos) return {};
  return name.substr(begin, name.find_last_not_of(' ') + 1 - begin);
}

std::string name_of_option(RuleSetting setting) { return "--" + std::string(name_of(setting)); }

}  // namespace

RuleNames::RuleNames() : suggestions_(names_of_rules()) {}

std::string RuleNames::describe_unknown(std::string_view name) {
  return "there is no rule " + quote(name) + did_you_mean(suggestions_.nearest(name));
}

std::string describe_fixed(const Rule& rule) {
  return quote(rule.name) + " is always an error: a file that breaks this rule has no meaning";
}

std::string_view name_of(RuleSetting setting) {
  constexpr std::string_view names[] = {"error", "warn", "note", "allow"};
  return names[static_cast<std::size_t>(setting)];
}

bool is_fixed(const Diagnostic& finding) {
  return finding.is_fixed || find_rule(finding.rule)->is_fixed;
}

void SeveritySettings::set(const Rule& rule, RuleSetting setting) {
  settings_[rule.name] = setting;
}

void SeveritySettings::override_with(const SeveritySettings& stronger) {
  for (const auto& [rule, setting] : stronger.settings_) settings_[rule] = setting;
  if (stronger.is_strict_) make_strict(stronger.strict_file_);
  never_together_.insert(never_together_.end(), stronger.never_together_.begin(),
                         stronger.never_together_.end());
}

std::optional<Severity> SeveritySettings::severity_of(const Diagnostic& finding) const {
  const auto found = settings_.find(finding.rule);
  if (is_fixed(finding)) return finding.severity;
  if (found == settings_.end()) {
    return finding.is_off ? std::nullopt : std::optional(finding.severity);
  }
  switch (found->second) {
    case RuleSetting::error:
      return Severity::error;
    case RuleSetting::warn:
      return Severity::warning;
    case RuleSetting::note:
      return Severity::note;
    case RuleSetting::allow:
      break;
  }
  return std::nullopt;
}

std::optional<Severity> SeveritySettings::severity_by(const Rule& rule) const {
  if (rule.name == rule::can_run_together.name && never_together_.empty()) return std::nullopt;
  Diagnostic finding;
  finding.rule = rule.name;
  finding.severity = rule.severity;
  finding.is_fixed = rule.is_fixed;
  return severity_of(finding);
}

bool SeveritySettings::need_search() const {
  const std::span<const Rule> rules = all_rules();
  return std::any_of(rules.begin(), rules.end(), [this](const Rule& rule) {
    const std::optional<Severity> severity = severity_by(rule);
    return rule.needs_search && severity && is_failure(*severity);
  });
}

bool SeveritySettings::add_failures() const {
  const std::span<const Rule> rules = all_rules();
  return std::any_of(rules.begin(), rules.end(), [this](const Rule& rule) {
    const std::optional<Severity> severity = severity_by(rule);
    const bool is_of_settings = rule.name == rule::can_run_together.name;
    return (rule.severity != Severity::error || is_of_settings) && severity &&
           is_failure(*severity);
  });
}

SeveritySettings settings_of_options(const SeverityOptions& options,
                                     std::vector<std::string>& errors) {
  SeveritySettings settings;
  RuleNames names;
  std::map<std::string_view, RuleSetting> given;
  for (const RuleSetting setting : rule_settings) {
    const std::string option = name_of_option(setting);
    for (const std::string& given_name : options.*names_for[static_cast<std::size_t>(setting)]) {
      const std::string name = without_blanks(given_name);
      const Rule* rule = find_rule(name);
      if (rule == nullptr) {
        errors.push_back(option + ": " + names.describe_unknown(name));
        continue;
      }
      const auto [first, is_new] = given.try_emplace(rule->name, setting);
      if (first->second != setting) {
        errors.push_back(option + ": rule " + quote(name) + " is also given to " +
                         name_of_option(first->second));
      } else if (!is_possible(*rule, setting)) {
        errors.push_back(option + ": " + describe_fixed(*rule));
      } else {
        settings.set(*rule, setting);
      }
    }
  }
  if (options.strict) settings.make_strict({});
  return settings;
}

namespace {

namespace fs = std::filesystem;

constexpr yaml::Key settings_keys[] = {{"error"}, {"warn"},   {"note"},
                                       {"allow"}, {"strict"}, {"never_together"}};
constexpr yaml::Shape settings_shape{"the settings", settings_keys};

/// The folder of a file, where the search begins: without links and "..", where possible.
fs::path folder_of(const fs::path& file) {
  std::error_code error;
  const fs::path folder = fs::absolute(fs::path(".") / file, error).parent_path();
  const fs::path resolved = fs::weakly_canonical(folder, error);
  return error ? folder.lexically_normal() : resolved;
}

/// Reads one settings file.
class SettingsReader {
 public:
  SettingsReader(std::string file, Reporter& reporter)
      : file_(std::move(file)), reporter_(reporter) {}

  SeveritySettings read(const yaml::Node& root) {
    yaml::Fields fields(root, settings_shape, reporter_);
    for (const RuleSetting setting : rule_settings) {
      if (const yaml::Node* rules = fields.find(name_of(setting))) read_rules(*rules, setting);
    }
    if (const yaml::Node* strict = fields.find("strict")) {
      if (yaml::read_boolean(*strict, "strict", reporter_).value_or(false))
        settings_.make_strict(file_);
    }
    if (const yaml::Node* lists = fields.find(never_together)) read_never_together(*lists);
    fields.report_unknown(yaml::UnknownKeys::refused);
    return settings_;
  }

 private:
  static constexpr std::string_view never_together = "never_together";

  void read_never_together(const yaml::Node& lists) {
    constexpr std::string_view expected = "a list of lists of names of tasks";
    if (yaml::read_list(lists, never_together, expected, reporter_) == nullptr) return;
    for (const yaml::Node* list : lists.items) {
      if (yaml::read_list(*list, never_together, expected, reporter_) == nullptr) continue;
      NeverTogether tasks{file_, list->range, {}, {}};
      std::unordered_map<std::string_view, Range> first_ranges;
      for (const yaml::Node* item : list->items) {
        const auto name = yaml::read_name(*item, never_together, expected, reporter_);
        if (!name) continue;
        const auto [first, is_new] = first_ranges.try_emplace(*name, item->range);
        if (!is_new) {
          reporter_.report(rule::invalid_value, item->range,
                           "task " + quote(*name) + " is given twice",
                           {reporter_.note(first->second, "first given here")});
          continue;
        }
        tasks.tasks.emplace_back(*name);
        tasks.ranges.push_back(item->range);
      }
      if (!tasks.ranges.empty()) {
        tasks.range = {tasks.ranges.front().begin, tasks.ranges.back().end};
      }
      if (list->items.size() < 2) {
        reporter_.report(rule::invalid_value, list->range,
                         "a list of 'never_together' must have at least two tasks");
      }
      settings_.add_never_together(std::move(tasks));
    }
  }

  void read_rules(const yaml::Node& rules, RuleSetting setting) {
    constexpr std::string_view expected = "a list of names of rules";
    const std::string_view key = name_of(setting);
    if (yaml::read_list(rules, key, expected, reporter_) == nullptr) return;
    for (const yaml::Node* item : rules.items) {
      if (const auto name = yaml::read_name(*item, key, expected, reporter_)) {
        read_rule(*name, item->range, setting);
      }
    }
  }

  void read_rule(std::string_view name, const Range& range, RuleSetting setting) {
    const Rule* rule = find_rule(name);
    if (rule == nullptr) {
      // An error, though a warning in a catalog: settings that are not understood are of no use.
      reporter_.report_as({Severity::error, true}, rule::unknown_rule, range,
                          names_.describe_unknown(name));
      return;
    }
    const auto [other, is_new] = given_.try_emplace(rule->name, range);
    if (!is_new) {
      // The lists may stand in any order.
      reporter_.report(rule::invalid_value, std::max(range, other->second),
                       "rule " + quote(name) + " is given twice",
                       {reporter_.note(std::min(range, other->second), "first given here")});
      other->second = std::min(range, other->second);
    } else if (!is_possible(*rule, setting)) {
      reporter_.report(rule::invalid_value, range, describe_fixed(*rule));
    } else {
      settings_.set(*rule, setting);
    }
  }

  std::string file_;
  Reporter& reporter_;
  RuleNames names_;
  std::unordered_map<std::string_view, Range> given_;
  SeveritySettings settings_;
};

}  // namespace

std::optional<std::string> find_settings_file(const std::string& file) {
  const fs::path path(file);
  fs::path folder = folder_of(path);
  for (;;) {
    const fs::path candidate = folder / settings_file_name;
    std::error_code error;
    if (fs::is_regular_file(candidate, error)) {
      if (path.is_absolute()) return candidate.string();
      const fs::path here = fs::canonical(".", error);
      return error ? candidate.string() : candidate.lexically_relative(here).string();
    }
    fs::path above = folder.parent_path();
    if (above == folder) return std::nullopt;
    folder = std::move(above);
  }
}

std::optional<SeveritySettings> read_settings(std::string_view text, std::string file,
                                              Diagnostics& diagnostics) {
  const std::unique_ptr<const yaml::Document> document = yaml::parse(text, file, diagnostics);
  if (document == nullptr) return std::nullopt;
  const yaml::Node& root = document->root();
  if (root.kind == yaml::Kind::null) return SeveritySettings{};
  Reporter reporter(file, diagnostics);
  if (root.kind != yaml::Kind::mapping) {
    reporter.report(rule::wrong_type, root.range,
                    "settings must be a mapping with the keys 'error', 'warn', 'note', 'allow', "
                    "'strict' and 'never_together', found " +
                        yaml::describe(root));
    return std::nullopt;
  }
  SeveritySettings settings = SettingsReader(std::move(file), reporter).read(root);
  if (reporter.errors() > 0) return std::nullopt;
  return settings;
}

void check_never_together_names(const std::vector<NeverTogether>& lists,
                                const std::vector<std::string_view>& known,
                                Diagnostics& diagnostics) {
  const std::unordered_set<std::string_view> names(known.begin(), known.end());
  Suggestions suggestions(known);
  const auto is_known = [&](const std::string& name) { return names.contains(name); };
  for (const NeverTogether& list : lists) {
    Reporter reporter(list.file, diagnostics);
    const bool has_known = std::any_of(list.tasks.begin(), list.tasks.end(), is_known);
    const std::unordered_set<std::string_view> listed(list.tasks.begin(), list.tasks.end());
    for (std::size_t i = 0; i < list.tasks.size(); ++i) {
      if (is_known(list.tasks[i])) continue;
      const auto meant = suggestions.nearest(
          list.tasks[i], [&listed](std::string_view other) { return listed.contains(other); });
      if (!meant && !has_known) continue;
      reporter.report_as({meant ? Severity::error : Severity::warning}, rule::undefined_task,
                         list.ranges[i],
                         "no catalog has task " + quote(list.tasks[i]) + did_you_mean(meant));
    }
  }
}

}  // namespace cbc
