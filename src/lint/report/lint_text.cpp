#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/diagnostic/diagnostic.h"
#include "core/report/wrap.h"
#include "core/support/wording.h"
#include "lint/report/lint_report.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

constexpr std::size_t line_width = 80;

/// Takes the text before the first `separator` off the front, with the separator; all of it if
/// there is none.
std::string_view take_until(std::string_view separator, std::string_view& rest) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  const std::string_view taken = rest.substr(0, end);
  rest.remove_prefix(std::min(end + separator.size(), rest.size()));
  return taken;
}

/// Breaks a paragraph of ASCII into lines of at most 80 characters, unless a word is longer.
std::string wrap(std::string_view paragraph) {
  std::string text;
  std::size_t used = 0;
  while (!paragraph.empty()) {
    const std::string_view word = take_until(" ", paragraph);
    if (used > 0 && used + 1 + word.size() > line_width) {
      text += '\n';
      used = 0;
    }
    if (used > 0) {
      text += ' ';
      ++used;
    }
    text += word;
    used += word.size();
  }
  return text + '\n';
}

std::string example_text(std::string_view heading, std::string_view example, const Style& style) {
  return fmt::format("\n{}{}:{}\n\n{}", style.strong, heading, style.reset, indent(example));
}

}  // namespace

std::string rule_text(const Rule& rule, const Style& style) {
  std::string text =
      fmt::format("{}{}{} ({}{})\n\n", style.strong, rule.name, style.reset, name_of(rule.severity),
                  rule.is_fixed ? "; settings cannot change it"
                  : rule.is_off ? "; off unless settings ask for it"
                                : "");
  text += wrap(rule.summary);
  for (std::string_view rest = rule.explanation; !rest.empty();) {
    text += '\n' + wrap(take_until("\n\n", rest));
  }
  if (!rule.settings.empty()) text += example_text("The settings", rule.settings, style);
  text += example_text(rule.is_of_scripts ? "Example, a script for the catalog below" : "Example",
                       rule.example, style);
  text += fmt::format("\n{}How to fix it:{}\n\n{}", style.strong, style.reset, wrap(rule.mending));
  text += example_text("Fixed", rule.mended, style);
  if (rule.is_of_scripts) text += example_text("The catalog", example_catalog(), style);
  return text;
}

std::string rule_list(const Style& style) {
  std::size_t width = 0;
  for (const Rule& rule : all_rules()) width = std::max(width, rule.name.size());
  std::string text;
  for (const Severity severity : {Severity::error, Severity::warning, Severity::note}) {
    for (const Rule& rule : all_rules()) {
      if (rule.severity != severity) continue;
      text += fmt::format("{}{:<{}}{}  {:<7}  {}\n", style.strong, rule.name, width, style.reset,
                          rule.is_off ? "off" : name_of(severity), rule.summary);
    }
  }
  return text;
}

namespace {

std::string describe(const std::string& file, const Position& place, Severity severity,
                     const std::string& message) {
  return fmt::format("{}: {}: {}", format_place(printable(file), place), name_of(severity),
                     printable(message));
}

}  // namespace

std::string lint_gcc(const std::vector<LintedFile>& files) {
  std::string text;
  for (const LintedFile& file : files) {
    for (const Diagnostic& finding : file.findings) {
      text += describe(finding.file, finding.range.begin, finding.severity, finding.message);
      text += fmt::format(" [{}]\n", finding.rule);
      for (const Note& note : finding.notes) {
        text += describe(note.file, note.range.begin, Severity::note, note.message) + "\n";
      }
    }
  }
  return text;
}

namespace {

// Columns of a terminal.
constexpr std::size_t tasks_width = 60;
constexpr std::size_t longest_shown_name = 40;
constexpr std::size_t label_width = 20;
constexpr std::size_t number_width = 8;

// Up to how many digits a search space is readable at a glance, and is shown at all.
constexpr std::size_t short_number = 6;
constexpr std::size_t longest_number = 30;

struct Cut {
  std::string text;
  std::size_t columns = 0;
};

/// A printable name, cut if it is long.
Cut cut_name(std::string_view name) {
  const std::string whole = printable(name);
  std::size_t columns = 0;
  for (std::size_t offset = 0; offset < whole.size();) {
    const utf8::Decoded decoded = utf8::decode(whole, offset);
    const std::size_t width = utf8::display_width(decoded.character);
    if (columns + width > longest_shown_name) return {whole.substr(0, offset) + "...", columns + 3};
    columns += width;
    offset += decoded.bytes;
  }
  return {whole, columns};
}

/// As many names as fit. `columns`: those that are taken already.
std::string list_names(const std::vector<std::string>& names, std::size_t columns = 0) {
  std::string text;
  for (const std::string& name : names) {
    const Cut cut = cut_name(name);
    columns += cut.columns + 2;
    if (!text.empty() && columns > tasks_width) return text + ", ...";
    text += (text.empty() ? "" : ", ") + cut.text;
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

std::string describe_search_space(const std::string& digits) {
  if (digits.size() <= short_number) return digits;
  const std::string about = to_scientific(digits);
  if (digits.size() > longest_number) return "~" + about;
  return fmt::format("{:>{}} (~{})", digits, number_width, about);
}

bool is_single(const CatalogNumbers& group) {
  return group.tasks == 1 && group.constraints.total() == 0;
}

class Table {
 public:
  explicit Table(const Style& style) : style_(style) {}

  void add(std::string_view label, std::uint64_t number) { add(label, std::to_string(number)); }
  void add(std::string_view label, std::string_view value) {
    text_ += style_.paint(style_.faint, fmt::format("  {:<{}}", label, label_width));
    text_ += fmt::format("{:>{}}\n", value, number_width);
  }
  void add_line(std::string_view line) { text_ += fmt::format("    {}\n", line); }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  const Style& style_;
  std::string text_;
};

void add_groups(Table& table, const std::vector<CatalogNumbers>& groups) {
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
  Table table(style);
  table.add("tasks", total.tasks);
  table.add("behaviors", total.behaviors);
  table.add("constraints", total.constraints.total());
  table.add("  exclusive pairs", total.constraints.exclusive_pairs);
  table.add("  requirements", total.constraints.requirements);
  table.add("  task minimums", total.constraints.task_minimums);
  add_groups(table, file.summary->groups);
  table.add("search space", describe_search_space(total.search_space));
  return name + "\n" + table.text();
}

namespace {

// For findings that repeat one that is shown in full.
constexpr std::size_t most_lines = 10;

/// Findings with the same message, in the order of the file.
using Alike = std::vector<const Diagnostic*>;

/// "  and 2 more like this, on lines 9, 15"
std::string describe_others(const Alike& alike) {
  std::string lines;
  std::size_t count = 0;
  std::uint32_t last = 0;
  for (std::size_t i = 1; i < alike.size(); ++i) {
    const std::uint32_t line = alike[i]->range.begin.line;
    if (line == last) continue;
    last = line;
    if (++count > most_lines) {
      lines += ", ...";
      break;
    }
    lines += (count > 1 ? ", " : "") + std::to_string(line);
  }
  return "  and " + std::to_string(alike.size() - 1) + " more like this, on " +
         (count == 1 ? "line " : "lines ") + lines;
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
    if (alike.size() > 1) text += style.paint(style.faint, describe_others(alike)) + "\n";
  }
  return text;
}

/// "2 catalogs, 1 script"
std::string describe_files(const std::vector<LintedFile>& files) {
  using FileKind = LintedFile::Kind;
  static constexpr std::pair<FileKind, std::string_view> names[] = {
      {FileKind::catalog, "catalog"},
      {FileKind::script, "script"},
      {FileKind::properties, "property file"},
      {FileKind::settings, "settings file"},
      {FileKind::unknown, "file"}};
  if (files.empty()) return "0 files";
  std::string text;
  for (const auto& [kind, name] : names) {
    const auto number = static_cast<std::size_t>(
        std::count_if(files.begin(), files.end(),
                      [kind = kind](const LintedFile& file) { return file.kind == kind; }));
    if (number > 0) text += (text.empty() ? "" : ", ") + quantity(number, name);
  }
  return text;
}

/// "2 errors, 1 warning in 2 catalogs, 1 script"
std::string describe_total(const std::vector<LintedFile>& files, const Style& style) {
  std::string text;
  for (const Severity severity : {Severity::error, Severity::warning, Severity::note}) {
    const std::size_t findings = count(files, severity);
    if (findings == 0) continue;
    if (!text.empty()) text += ", ";
    text += style.paint(style.of(severity), quantity(findings, name_of(severity)));
  }
  if (text.empty()) text = style.paint(style.good, "no findings");
  return text + " in " + describe_files(files) + "\n";
}

}  // namespace

std::string lint_text(const std::vector<LintedFile>& files, const Style& style) {
  SourceTexts sources;
  for (const LintedFile& file : files) sources.add(file.file, file.text);
  std::string text;
  for (const LintedFile& file : files) text += file_to_text(file, sources, style);
  return text + describe_total(files, style);
}

}  // namespace cbc
