#include "core/check/controls.h"

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

#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/support/wording.h"
#include "core/yaml/document.h"
#include "core/yaml/source.h"
#include "core/yaml/values.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

std::vector<std::string_view> names_of_rules() {
  std::vector<std::string_view> names;
  for (const Rule& rule : all_rules()) names.push_back(rule.name);
  return names;
}

/// Explains why a name is not that of a rule, with the nearest that is.
class RuleNames {
 public:
  RuleNames() : suggestions_(names_of_rules()) {}

  std::string describe_unknown(std::string_view name) {
    return "there is no rule " + quote(name) + did_you_mean(suggestions_.nearest(name));
  }

 private:
  Suggestions suggestions_;
};

/// Whether a rule may have a setting: a fixed one stays an error.
bool is_possible(const Rule& rule, RuleSetting setting) {
  return !rule.is_fixed || setting == RuleSetting::error;
}

/// Why a rule cannot be anything but an error.
std::string describe_fixed(const Rule& rule) {
  return quote(rule.name) + " is always an error: a file that breaks this rule has no meaning";
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

namespace {

constexpr std::string_view comment_mark = "cbc:";
constexpr std::string_view allow_verb = "allow";
constexpr std::string_view reason_mark = "--";

/// Lines, counted from 1, the last one included.
struct Lines {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// One rule in a comment.
struct Allow {
  const Rule* rule = nullptr;
  Range range;  ///< of its name
  Lines lines;  ///< on which findings are allowed
  bool is_used = false;
};

/// Tells which lines the comments of a text are about.
class Scopes {
 public:
  explicit Scopes(const std::vector<yaml::SourceLine>& lines)
      : lines_(lines), last_content_(lines.size() + 1), entries_(lines.size() + 1) {
    for (std::size_t number = 1; number <= lines.size(); ++number) {
      last_content_[number] = lines[number - 1].has_content ? number : last_content_[number - 1];
    }
    find_entries();
  }

  /// Those that the comment of a line is about. Any two results are disjoint, or one contains the
  /// other.
  [[nodiscard]] Lines of_comment(std::size_t number) const {
    if (lines_[number - 1].has_content) return {number, number};
    // Comments above are about the same entry, and this one can allow findings about them.
    return {last_content_[number] + 1, std::max(number, entries_[number])};
  }

 private:
  /// An entry ends before the next one that is not deeper.
  void find_entries() {
    struct Entry {
      std::size_t depth = 0;
      std::size_t number = 0;
    };
    std::vector<Entry> below;  // the entries that end the ones above, the nearest last
    std::size_t last_line = 0;
    for (std::size_t number = lines_.size(); number > 0; --number) {
      entries_[number] = last_line;
      const std::optional<std::size_t> depth = lines_[number - 1].depth;
      if (!depth) continue;
      while (!below.empty() && below.back().depth > *depth) below.pop_back();
      last_line = last_content_[below.empty() ? lines_.size() : below.back().number - 1];
      below.push_back({*depth, number});
    }
  }

  const std::vector<yaml::SourceLine>& lines_;
  // By line, which count from 1:
  std::vector<std::size_t> last_content_;  ///< the last line up to this one with content, or 0
  std::vector<std::size_t> entries_;       ///< the last line of the entry that begins below, or 0
};

/// Reads the comments of a file that are for this program, in order.
class CommentReader {
 public:
  CommentReader(std::string_view text, Reporter& reporter)
      : text_(text), positions_(text), reporter_(reporter) {}

  std::vector<Allow> read(const yaml::Document* document) {
    // Most files have no such comment, and need no closer look.
    if (text_.find(comment_mark) == std::string_view::npos) return {};
    const std::vector<yaml::SourceLine> lines = yaml::split_lines(text_, document);
    const Scopes scopes(lines);
    for (std::size_t number = 1; number <= lines.size(); ++number) {
      const yaml::SourceLine& line = lines[number - 1];
      if (line.comment) read_comment(*line.comment, line.end, scopes.of_comment(number));
    }
    return std::move(allows_);
  }

 private:
  void read_comment(std::size_t begin, std::size_t end, const Lines& lines) {
    next_ = begin + 1;
    end_ = end;
    skip_blanks();
    if (!rest().starts_with(comment_mark)) return;
    next_ += comment_mark.size();
    skip_blanks();
    const std::string_view word = next_word();
    if (word != allow_verb) {
      report_other_word(word, begin);
    } else if (!read_rules(lines)) {
      report(range_of(text_.substr(begin, end - begin)),
             "the comment names no rule: expected 'cbc: allow RULE'");
    }
  }

  /// Returns whether there were any names.
  bool read_rules(const Lines& lines) {
    for (bool is_first = true;; is_first = false) {
      while (next_ < end_ && (is_blank(text_[next_]) || text_[next_] == ',')) ++next_;
      if (is_at_end()) return !is_first;
      const std::string_view name = next_word();
      const Rule* rule = find_rule(name);
      if (rule == nullptr) {
        report(range_of(name), names_.describe_unknown(name));
      } else {
        allows_.push_back({rule, range_of(name), lines});
      }
      skip_blanks();
      if (is_at_end()) return true;
      if (text_[next_] == ',') continue;
      // After an unknown name, one finding is enough.
      const std::string_view other = next_word();
      if (rule != nullptr) {
        report(range_of(other),
               "expected ',' and another rule, or '-- ' and a reason, found " + quote(other));
      }
      return true;
    }
  }

  void report_other_word(std::string_view word, std::size_t begin) {
    if (word.empty()) {
      report(range_of(text_.substr(begin, end_ - begin)),
             "the comment is empty: expected 'cbc: allow RULE'");
      return;
    }
    const std::string_view known[] = {allow_verb};
    std::string message = "expected 'allow' after 'cbc:', found " + quote(word);
    if (nearest(word, known)) message += "; did you mean 'allow'?";
    report(range_of(word), std::move(message));
  }

  void report(const Range& range, std::string message) {
    reporter_.report(rule::unknown_rule, range, std::move(message));
  }

  static bool is_blank(char byte) { return byte == ' ' || byte == '\t'; }

  [[nodiscard]] std::string_view rest() const { return text_.substr(next_, end_ - next_); }

  [[nodiscard]] bool is_at_end() const { return next_ == end_ || rest().starts_with(reason_mark); }

  void skip_blanks() {
    while (next_ < end_ && is_blank(text_[next_])) ++next_;
  }

  /// The word that begins here, up to a blank or a comma; empty if there is none.
  std::string_view next_word() {
    const std::size_t begin = next_;
    while (next_ < end_ && !is_blank(text_[next_]) && text_[next_] != ',') ++next_;
    return text_.substr(begin, next_ - begin);
  }

  [[nodiscard]] Range range_of(std::string_view piece) const {
    const auto begin = static_cast<std::size_t>(piece.data() - text_.data());
    return {positions_.at(begin), positions_.at(begin + piece.size())};
  }

  std::string_view text_;
  PositionMap positions_;
  Reporter& reporter_;
  RuleNames names_;
  std::vector<Allow> allows_;
  std::size_t next_ = 0;  // in the comment that is being read
  std::size_t end_ = 0;
};

/// Moves the findings that no comment allows from one collection to another.
void filter(Diagnostics& findings, std::vector<Allow>& allows, Diagnostics& kept) {
  findings.sort();
  std::unordered_map<const Rule*, std::vector<Allow*>> open;  // by rule, the innermost last
  auto next = allows.begin();
  for (Diagnostic& finding : findings.release()) {
    const std::size_t line = finding.range.begin.line;
    for (; next != allows.end() && next->lines.first <= line; ++next) {
      open[next->rule].push_back(&*next);
    }
    const Rule* rule = find_rule(finding.rule);
    std::vector<Allow*>& candidates = open[rule];
    while (!candidates.empty() && candidates.back()->lines.last < line) candidates.pop_back();
    if (candidates.empty() || is_fixed(finding)) {
      kept.add(std::move(finding));
    } else {
      candidates.back()->is_used = true;
    }
  }
}

}  // namespace

std::vector<Diagnostic> apply_allow_comments(std::vector<Diagnostic> findings,
                                             const CommentedFile& file) {
  Diagnostics found;
  for (Diagnostic& finding : findings) found.add(std::move(finding));
  Diagnostics kept;
  Reporter reporter(file.file, kept);
  CommentReader reader(utf8::without_byte_order_mark(file.text), reporter);
  std::vector<Allow> allows = reader.read(file.document);
  filter(found, allows, kept);
  for (const Allow& allow : allows) {
    if (allow.rule->is_fixed) {
      reporter.report(rule::unused_allow, allow.range, describe_fixed(*allow.rule));
    } else if (!allow.is_used && file.is_complete) {
      reporter.report(rule::unused_allow, allow.range,
                      "no finding of rule " + quote(allow.rule->name) + " needs this comment");
    }
  }
  kept.sort();
  return kept.release();
}

std::vector<Diagnostic> control_findings(std::vector<Diagnostic> findings, CommentedFile file,
                                         const SeveritySettings& settings) {
  // Past the node limit, the finding that a comment allows may just not have been found.
  file.is_complete = file.is_complete &&
                     std::none_of(findings.begin(), findings.end(), [](const Diagnostic& finding) {
                       return finding.rule == rule::undecided;
                     });
  std::vector<Diagnostic> reported;
  for (Diagnostic& finding : apply_allow_comments(std::move(findings), file)) {
    const std::optional<Severity> severity = settings.severity_of(finding);
    if (!severity) continue;
    finding.severity = *severity;
    reported.push_back(std::move(finding));
  }
  return reported;
}

}  // namespace cbc
