#include "report/lint_summary.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "report/quantity.h"
#include "text/quote.h"
#include "text/utf8.h"

namespace cbc {
namespace {

// Columns of a terminal.
constexpr std::size_t tasks_width = 60;
constexpr std::size_t longest_name = 40;
constexpr std::size_t label_width = 20;
constexpr std::size_t number_width = 8;

// Digits of a search space that are read at a glance, and that are shown at all.
constexpr std::size_t short_number = 6;
constexpr std::size_t longest_number = 30;

struct Cut {
  std::string text;
  std::size_t columns = 0;
};

/// A name as it prints, cut if it is long.
Cut cut_name(std::string_view name) {
  const std::string whole = printable(name);
  std::size_t columns = 0;
  for (std::size_t offset = 0; offset < whole.size();) {
    const utf8::Decoded decoded = utf8::decode(whole, offset);
    const std::size_t width = utf8::display_width(decoded.character);
    if (columns + width > longest_name) return {whole.substr(0, offset) + "...", columns + 3};
    columns += width;
    offset += decoded.bytes;
  }
  return {whole, columns};
}

/// As many names as fit.
std::string list_names(const std::vector<std::string>& names) {
  std::string text;
  std::size_t columns = 0;
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

bool is_single(const Summary::Group& group) {
  return group.tasks.size() == 1 && group.constraints == 0;
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

void add_groups(Table& table, const std::vector<Summary::Group>& groups) {
  table.add("groups", groups.size());
  for (const Summary::Group& group : groups) {
    if (is_single(group)) continue;
    table.add_line(fmt::format("{}, {}: {}", quantity(group.tasks.size(), "task"),
                               quantity(group.constraints, "constraint"), list_names(group.tasks)));
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
  const Summary& summary = *file.summary;
  Table table(style);
  table.add("tasks", summary.tasks);
  table.add("behaviors", summary.behaviors);
  table.add("constraints", summary.constraints.total());
  table.add("  exclusive pairs", summary.constraints.exclusive_pairs);
  table.add("  requirements", summary.constraints.requirements);
  table.add("  task minimums", summary.constraints.task_minimums);
  add_groups(table, summary.groups);
  table.add("search space", describe_search_space(summary.search_space));
  return name + "\n" + table.text();
}

}  // namespace cbc
