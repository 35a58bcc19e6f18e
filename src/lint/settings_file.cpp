#include "lint/settings_file.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "cbc/rules.h"
#include "diagnostic/reporter.h"
#include "lint/rule_names.h"
#include "text/quote.h"
#include "yaml/document.h"
#include "yaml/fields.h"
#include "yaml/values.h"

namespace cbc {
namespace {

namespace fs = std::filesystem;

constexpr yaml::Key settings_keys[] = {{"error"}, {"warn"}, {"allow"}, {"strict"}};
constexpr yaml::Shape settings_shape{"the settings", settings_keys};

/// The folder of a file as it is to be searched from: without links and "..", where possible.
fs::path folder_of(const fs::path& file) {
  std::error_code error;
  const fs::path folder = fs::absolute(fs::path(".") / file, error).parent_path();
  const fs::path resolved = fs::weakly_canonical(folder, error);
  return error ? folder.lexically_normal() : resolved;
}

/// Reads one settings file.
class SettingsReader {
 public:
  explicit SettingsReader(Reporter& reporter) : reporter_(reporter) {}

  SeveritySettings read(const yaml::Node& root) {
    yaml::Fields fields(root, settings_shape, reporter_);
    for (const RuleSetting setting : rule_settings) {
      if (const yaml::Node* rules = fields.find(name_of(setting))) read_rules(*rules, setting);
    }
    if (const yaml::Node* strict = fields.find("strict")) {
      if (yaml::read_boolean(*strict, "strict", reporter_).value_or(false)) settings_.make_strict();
    }
    fields.report_unknown(Severity::error);
    return settings_;
  }

 private:
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
      // Not a warning, as it is in a catalog: settings that are not understood are of no use.
      reporter_.report_as(Severity::error, rule::unknown_rule, range,
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
  Reporter reporter(std::move(file), diagnostics);
  if (root.kind != yaml::Kind::mapping) {
    reporter.report(rule::wrong_type, root.range,
                    "settings must be a mapping with the keys 'error', 'warn', 'allow' and "
                    "'strict', found " +
                        yaml::describe(root));
    return std::nullopt;
  }
  SeveritySettings settings = SettingsReader(reporter).read(root);
  if (reporter.errors() > 0) return std::nullopt;
  return settings;
}

}  // namespace cbc
