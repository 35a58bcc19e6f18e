#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/diagnostic/diagnostic.h"
#include "core/report/blocks.h"
#include "core/report/test_report.h"
#include "core/support/wording.h"
#include "lint/report/lint_report.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

/// Takes the text before the first `separator` off the front, with the separator; all of it if
/// there is none.
std::string_view take_until(std::string_view separator, std::string_view& rest) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  const std::string_view taken = rest.substr(0, end);
  rest.remove_prefix(std::min(end + separator.size(), rest.size()));
  return taken;
}

std::string paragraph(std::string_view text) { return wrap_line(text, text_width, 0) + "\n"; }

std::string example_text(std::string_view heading, std::string_view example, const Style& style) {
  return fmt::format("\n{}{}:{}\n\n{}", style.strong, heading, style.reset, indent(example));
}

}  // namespace

std::string rule_text(const Rule& rule, const Style& style) {
  std::string text =
      fmt::format("{}{}{} ({}{})\n\n", style.strong, rule.name, style.reset, name_of(rule.severity),
                  rule.is_fixed ? "; settings cannot change it" : "");
  text += paragraph(rule.summary);
  for (std::string_view rest = rule.explanation; !rest.empty();) {
    text += '\n' + paragraph(take_until("\n\n", rest));
  }
  if (!rule.settings.empty()) text += example_text("The settings", rule.settings, style);
  text += example_text(rule.is_of_scripts ? "Example, a script for the catalog below" : "Example",
                       rule.example, style);
  text +=
      fmt::format("\n{}How to fix it:{}\n\n{}", style.strong, style.reset, paragraph(rule.mending));
  text += example_text("Fixed", rule.mended, style);
  if (rule.is_of_scripts) text += example_text("The catalog", example_catalog(), style);
  return text;
}

std::string rule_list(const Style& style) {
  Table table(style, {{{}, {}, 0, 0}, {{}, {}, 7}, {}});
  for (const Severity severity : {Severity::error, Severity::warning, Severity::note}) {
    for (const Rule& rule : all_rules()) {
      if (rule.severity != severity) continue;
      table.add({{rule.name, style.strong}, name_of(severity), rule.summary});
    }
  }
  return table.text();
}

std::string lint_github(const std::vector<LintedFile>& files) {
  std::string text;
  for (const LintedFile& file : files) text += annotations_to_text(file.findings);
  return text;
}

namespace {

std::string gcc_line(const std::string& file, const Position& place, Severity severity,
                     const std::string& message) {
  return fmt::format("{}: {}: {}", format_place(printable(file), place), name_of(severity),
                     printable(message));
}

}  // namespace

std::string lint_gcc(const std::vector<LintedFile>& files) {
  std::string text;
  for (const LintedFile& file : files) {
    for (const Diagnostic& finding : file.findings) {
      text += gcc_line(finding.file, finding.range.begin, finding.severity, finding.message);
      text += fmt::format(" [{}]\n", finding.rule);
      for (const Note& note : finding.notes) {
        text += gcc_line(note.file, note.range.begin, Severity::note, note.message) + "\n";
      }
    }
  }
  return text;
}

namespace {

// Columns of a terminal.
constexpr std::size_t tasks_width = 60;
constexpr std::size_t longest_shown_name = 40;
constexpr std::size_t number_width = 8;

// Up to how many digits a search space is readable at a glance, and is shown at all.
constexpr std::size_t short_number = 6;
constexpr std::size_t longest_number = 30;

/// A printable name, shortened if it is long.
std::string shown_name(const std::string& name) {
  return shorten(printable(name), longest_shown_name);
}

/// As many names as fit. `columns`: those that are taken already.
std::string list_names(const std::vector<std::string>& names, std::size_t columns = 0) {
  std::string text;
  for (const std::string& name : names) {
    const std::string shown = shown_name(name);
    columns += width_of(shown) + 2;
    if (!text.empty() && columns > tasks_width) return text + ", ...";
    text += (text.empty() ? "" : ", ") + shown;
  }
  return text;
}

/// An integer in digits as "1.3e6", rounded.
std::string to_scientific(std::string_view digits) {
  std::size_t exponent = digits.size() - 1;
  int tenths = (digits[0] - '0') * 10 + (digits[1] - '0') + (digits[2] >= '5' ? 1 : 0);
  if (tenths == 100) {
    tenths = 10;
    ++exponent;
  }
  return fmt::format("{}.{}e{}", tenths / 10, tenths % 10, exponent);
}

std::string readable_number(const std::string& digits) {
  if (digits.size() <= short_number) return digits;
  const std::string about = to_scientific(digits);
  if (digits.size() > longest_number) return "~" + about;
  return fmt::format("{:>{}} (~{})", digits, number_width, about);
}

bool is_single(const CatalogNumbers& group) {
  return group.tasks == 1 && group.constraints.total() == 0;
}

/// The numbers, and lines of text between them.
class Summary {
 public:
  explicit Summary(const Style& style)
      : text_(style), table_(style, {{{}, {}, 20}, number_column({}, number_width, 0)}) {}

  template <typename Content>
  void add(std::string_view label, const Content& value) {
    text_.add(table_.line({{label, text_.style().faint}, value}));
  }
  void add_line(std::string_view line) { text_.line("    {}", line); }

  [[nodiscard]] std::string take() { return text_.take(); }

 private:
  Text text_;
  Table table_;
};

void add_groups(Summary& table, const std::vector<CatalogNumbers>& groups) {
  table.add("groups", groups.size());
  for (const CatalogNumbers& group : groups) {
    if (is_single(group)) continue;
    table.add_line(fmt::format("{}, {}: {}", quantity(group.tasks, "task"),
                               quantity(group.constraints.total(), "constraint"),
                               list_names(group.task_names)));
  }
  const auto singles =
      static_cast<std::size_t>(std::count_if(groups.begin(), groups.end(), is_single));
  if (singles > 0) {
    table.add_line(fmt::format("{} of one task without constraints", quantity(singles, "group")));
  }
}

}  // namespace

std::string lint_summary(const LintedFile& file, const Style& style) {
  const std::string name = style.paint(style.strong, printable(file.file));
  if (!file.summary) return name + ": no summary, as the file could not be understood\n";
  const CatalogNumbers& total = file.summary->total;
  Summary table(style);
  table.add("tasks", total.tasks);
  table.add("behaviors", total.behaviors);
  table.add("constraints", total.constraints.total());
  table.add("  exclusive pairs", total.constraints.exclusive_pairs);
  table.add("  requirements", total.constraints.requirements);
  table.add("  task minimums", total.constraints.task_minimums);
  if (total.constraints.limits > 0) table.add("  at most so many", total.constraints.limits);
  add_groups(table, file.summary->groups);
  table.add("search space", readable_number(total.search_space));
  return name + "\n" + table.take();
}

namespace {

// For findings that repeat one that is shown in full.
constexpr std::size_t most_lines = 10;

/// Findings with the same message, in the order of the file.
using Alike = std::vector<const Diagnostic*>;

/// "  and 2 more like this, on lines 9, 15"
std::string places_of_others(const Alike& alike) {
  std::vector<std::string> lines;
  std::uint32_t last = 0;
  for (std::size_t i = 1; i < alike.size() && lines.size() <= most_lines; ++i) {
    const std::uint32_t line = alike[i]->range.begin.line;
    if (line != last) lines.push_back(lines.size() == most_lines ? "..." : std::to_string(line));
    last = line;
  }
  return fmt::format("  and {} more like this, on {} {}", alike.size() - 1,
                     lines.size() == 1 ? "line" : "lines", join(lines, ", "));
}

std::string file_to_text(const LintedFile& file, const SourceTexts& sources, const Style& style) {
  std::map<std::tuple<Severity, std::string_view, std::string_view>, Alike> by_message;
  for (const Diagnostic& finding : file.findings) {
    by_message[{finding.severity, finding.rule, finding.message}].push_back(&finding);
  }
  std::string text;
  for (const Diagnostic& finding : file.findings) {
    const Alike& alike = by_message[{finding.severity, finding.rule, finding.message}];
    if (alike.front() != &finding) continue;
    text += render(finding, sources, style);
    if (alike.size() > 1) text += style.paint(style.faint, places_of_others(alike)) + "\n";
  }
  return text;
}

/// "2 catalogs, 1 script"; empty if no file was understood.
std::string count_files(const std::vector<LintedFile>& files) {
  using FileKind = LintedFile::Kind;
  static constexpr std::pair<FileKind, std::string_view> names[] = {
      {FileKind::catalog, "catalog"},
      {FileKind::script, "script"},
      {FileKind::properties, "property file"},
      {FileKind::settings, "settings file"}};
  std::vector<std::string> counts;
  for (const auto& [kind, name] : names) {
    const auto number = static_cast<std::size_t>(
        std::count_if(files.begin(), files.end(),
                      [kind = kind](const LintedFile& file) { return file.kind == kind; }));
    if (number > 0) counts.push_back(quantity(number, name));
  }
  return join(counts, ", ");
}

/// "1 file was not understood: b.yaml"
std::string list_not_understood(const std::vector<std::string>& names) {
  constexpr std::size_t most_names = 10;
  std::string text = fmt::format("{} {} not understood: ", quantity(names.size(), "file"),
                                 names.size() == 1 ? "was" : "were");
  const std::size_t shown = names.size() > most_names ? most_names - 1 : names.size();
  text += join(std::span(names).first(shown), ", ", printable);
  if (shown < names.size()) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

/// "2 errors, 1 warning in 2 catalogs, 1 script; 1 file was not understood: b.yaml"
std::string total_of(const std::vector<LintedFile>& files, std::vector<std::string> not_understood,
                     const Style& style) {
  std::vector<std::string> counts;
  for (const Severity severity : {Severity::error, Severity::warning, Severity::note}) {
    const std::size_t findings = count(files, severity);
    if (findings == 0) continue;
    counts.push_back(style.paint(style.of(severity), quantity(findings, name_of(severity))));
  }
  if (counts.empty()) counts.push_back(style.paint(style.good, "no findings"));
  std::string total = join(counts, ", ");
  const std::string understood = count_files(files);
  if (!understood.empty()) total += " in " + understood;
  // Its finding says what is wrong with the only file.
  if (files.size() < 2 && understood.empty() && not_understood.empty()) {
    return total + " in " + quantity(files.size(), "file") + "\n";
  }
  for (const LintedFile& file : files) {
    if (file.kind == LintedFile::Kind::unknown) not_understood.push_back(file.file);
  }
  std::sort(not_understood.begin(), not_understood.end());
  if (!not_understood.empty()) total += "; " + list_not_understood(not_understood);
  return total + "\n";
}

}  // namespace

std::string lint_text(const std::vector<LintedFile>& files, const Style& style,
                      const std::vector<std::string>& not_understood) {
  SourceTexts sources;
  for (const LintedFile& file : files) sources.add(file.file, file.text);
  std::string text;
  for (const LintedFile& file : files) text += file_to_text(file, sources, style);
  return text + total_of(files, not_understood, style);
}

}  // namespace cbc
