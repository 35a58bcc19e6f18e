#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/support/wording.h"

/// What people say about findings for whole projects: severities of rules, on the command line and
/// in settings files.
namespace cbc {

/// Explains why a name is not that of a rule, with the nearest that is.
class RuleNames {
 public:
  RuleNames();
  [[nodiscard]] std::string describe_unknown(std::string_view name);

 private:
  Suggestions suggestions_;
};

/// Why a fixed rule cannot be anything but an error.
[[nodiscard]] std::string describe_fixed(const Rule& rule);

/// What becomes of the findings of a rule; `allow`: they are not reported.
enum class RuleSetting : std::uint8_t { error, warn, note, allow };

inline constexpr std::array rule_settings = {RuleSetting::error, RuleSetting::warn,
                                             RuleSetting::note, RuleSetting::allow};

/// "error", "warn", "note", "allow": the key of a settings file, and the option.
[[nodiscard]] std::string_view name_of(RuleSetting setting);

/// Whether the severity of a finding cannot be changed, because of its rule or by itself (an
/// unknown key in a script).
[[nodiscard]] bool is_fixed(const Diagnostic& finding);

/// Tasks of which no two may be able to run at the same time, as a settings file lists them.
struct NeverTogether {
  std::string file;  ///< the settings file
  Range range;       ///< of all names
  std::vector<std::string> tasks;
  std::vector<Range> ranges;  ///< of each name
};

/// The severities that people set for findings, by rule; and what else a settings file demands.
class SeveritySettings {
 public:
  /// A fixed rule can only be set to error.
  void set(const Rule& rule, RuleSetting setting);
  /// Lets warnings count as failure. `file`: the settings file that says so; empty: the command
  /// line.
  void make_strict(std::string file) {
    is_strict_ = true;
    strict_file_ = std::move(file);
  }
  /// Adds tasks of which no two may run together.
  void add_never_together(NeverTogether tasks) { never_together_.push_back(std::move(tasks)); }

  /// Takes over what `stronger` says; where it says nothing, all stays as it is.
  void override_with(const SeveritySettings& stronger);

  /// The severity a finding is reported with, or nothing if it is not to be reported.
  [[nodiscard]] std::optional<Severity> severity_of(const Diagnostic& finding) const;
  /// Whether warnings count as failure.
  [[nodiscard]] bool is_strict() const { return is_strict_; }
  /// The settings file that says so; empty: the command line.
  [[nodiscard]] const std::string& strict_file() const { return strict_file_; }
  [[nodiscard]] const std::vector<NeverTogether>& never_together() const { return never_together_; }

  /// Whether a finding with this severity is a failure.
  [[nodiscard]] bool is_failure(Severity severity) const {
    return severity == Severity::error || (is_strict_ && severity == Severity::warning);
  }
  /// Whether there may be a failure that would be none without settings, by a rule that needs a
  /// search, by any rule.
  [[nodiscard]] bool need_search() const;
  [[nodiscard]] bool add_failures() const;

 private:
  [[nodiscard]] std::optional<Severity> severity_by(const Rule& rule) const;

  std::map<std::string_view, RuleSetting> settings_;  // by name of the rule
  bool is_strict_ = false;
  std::string strict_file_;
  std::vector<NeverTogether> never_together_;
};

/// Names of rules, as they were given on the command line.
struct SeverityOptions {
  std::vector<std::string> error = {};
  std::vector<std::string> warn = {};
  std::vector<std::string> note = {};
  std::vector<std::string> allow = {};
  bool strict = false;
};

/// Reads options. Adds a message to `errors` for each that is wrong; then the settings are not to
/// be used.
[[nodiscard]] SeveritySettings settings_of_options(const SeverityOptions& options,
                                                   std::vector<std::string>& errors);

/// The name of files with settings.
inline constexpr std::string_view settings_file_name = ".cbc.yaml";

/// Finds the settings file for a file: the one in its folder, or else in the nearest folder above
/// that has one. The file itself need not exist; of a link, its own folder counts, not the one it
/// leads to. Folders that cannot be searched are passed over. The result is relative to the current
/// folder if `file` is.
[[nodiscard]] std::optional<std::string> find_settings_file(const std::string& file);

/// Reads the text of a settings file, in which all keys may be absent:
///
///     error: [unknown-key, dead-behavior]
///     warn: [exclusive-requirement]
///     note: [dead-task]
///     allow: [required-goal]
///     strict: true
///     never_together:
///     - [LAND, FOLLOW_PATH]
///
/// Everything that is wrong with it is reported as an error, and there are no settings then.
[[nodiscard]] std::optional<SeveritySettings> read_settings(std::string_view text, std::string file,
                                                            Diagnostics& diagnostics);

/// Reports the names in `lists`, all of one settings file, that no catalog has: as an error if a
/// task with a similar name exists, so that it must be misspelt; as a warning if another task of
/// its list exists. Otherwise the list is about other catalogs. `known`: the tasks of the catalogs
/// that the settings apply to.
void check_never_together_names(const std::vector<NeverTogether>& lists,
                                const std::vector<std::string_view>& known,
                                Diagnostics& diagnostics);

}  // namespace cbc
