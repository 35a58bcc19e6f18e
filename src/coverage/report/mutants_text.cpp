#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/report/github.h"
#include "core/report/table_parts.h"
#include "core/report/wrap.h"
#include "core/support/wording.h"
#include "coverage/report/mutants_report.h"
#include "runtime/base/text.h"

// Mutants as text and as annotations.

namespace cbc {
namespace {

constexpr std::string_view heading_of_result = "noticed by";

/// The mission that notices it, or the result.
std::string describe_result(const MutantsResult& result, const MutantVerdict& verdict) {
  if (verdict.result == MutantVerdict::Result::survived) return "SURVIVED";
  if (!verdict.notice) return std::string(name_of(verdict.result));
  const std::string mission = printable(result.missions[verdict.notice->mission]);
  return verdict.notice->line == 0 ? mission : fmt::format("{}:{}", mission, verdict.notice->line);
}

std::string describe_lines(const Mutant& mutant) {
  std::string text;
  for (const std::uint32_t line : mutant.lines) {
    text += fmt::format("{}{}", text.empty() ? "" : ",", line);
  }
  return text;
}

std::string table_to_text(const MutantsResult& result, const Style& style, std::size_t columns) {
  std::vector<std::string> results;
  std::size_t width = heading_of_result.size();
  for (const MutantVerdict& verdict : result.verdicts) {
    width = std::max(width, results.emplace_back(describe_result(result, verdict)).size());
  }
  const std::size_t indent = 2 + 9 + 2 + width + 2;
  std::string text = fmt::format("\n  {:>9}  {:<{}}  changed\n", "line", heading_of_result, width);
  for (std::size_t place = 0; place < result.mutants.size(); ++place) {
    const bool has_survived = result.verdicts[place].result == MutantVerdict::Result::survived;
    const std::string padded = fmt::format("{:<{}}", results[place], width);
    const std::string line = fmt::format("  {:>9}  {}  {}", describe_lines(result.mutants[place]),
                                         has_survived ? style.paint(style.bad, padded) : padded,
                                         describe(*result.catalog, result.mutants[place]));
    text += wrap_line(line, columns, indent) + "\n";
  }
  return text;
}

std::string survivors_to_text(const MutantsResult& result, std::size_t columns) {
  std::string text;
  for (std::size_t place = 0; place < result.mutants.size(); ++place) {
    const MutantVerdict& verdict = result.verdicts[place];
    if (verdict.result != MutantVerdict::Result::survived) continue;
    if (text.empty()) text = "\nno mission notices that; these would\n";
    const Mutant& mutant = result.mutants[place];
    const std::string line = fmt::format("  {}:{}: {}", printable(result.catalog->file),
                                         mutant.lines.front(), describe(*result.catalog, mutant));
    text += wrap_line(line, columns, 4) + "\n";
    text += indent(*verdict.script);
  }
  return text;
}

/// What counts, and what does not.
std::string summary_to_text(const MutantCount& count, std::size_t columns) {
  std::string counts = fmt::format("mutants: {} noticed, {} survived, {} equivalent", count.noticed,
                                   count.survived, count.equivalent);
  if (count.undecided > 0) counts += fmt::format(", {} undecided", count.undecided);
  if (count.unjudged > 0) counts += fmt::format(", {} not judged", count.unjudged);
  std::string text = "\n" + wrap_line(counts, columns, 2);
  text += count.is_score_known() ? fmt::format("\nscore: {}\n", describe_percent(count.score()))
                                 : "\nscore: unknown\n";
  const auto add = [&](const std::string& line) { text += wrap_line(line, columns, 2) + "\n"; };
  if (const std::uint64_t limited = count.undecided - count.without_script; limited > 0) {
    add(
        fmt::format("undecided: a limit came before it was known whether a mission could notice "
                    "{}; see --max-states, --max-memory and --time-limit",
                    quantity(limited, "mutant")));
  }
  if (count.without_script > 0) {
    add(
        fmt::format("undecided: {} may differ from the catalog, but no mission was found that "
                    "shows it, as it may take a timeout that comes at the right time",
                    quantity(count.without_script, "mutant")));
  }
  return text;
}

}  // namespace

MutantCount MutantsResult::count() const {
  MutantCount count;
  for (const MutantVerdict& verdict : verdicts) {
    switch (verdict.result) {
      case MutantVerdict::Result::noticed:
        ++count.noticed;
        break;
      case MutantVerdict::Result::survived:
        ++count.survived;
        break;
      case MutantVerdict::Result::equivalent:
        ++count.equivalent;
        break;
      case MutantVerdict::Result::undecided:
        ++count.undecided;
        if (verdict.doubt == MutantVerdict::Doubt::no_script) ++count.without_script;
        break;
      case MutantVerdict::Result::unjudged:
        ++count.unjudged;
        break;
    }
  }
  return count;
}

std::string mutants_to_text(const MutantsResult& result, const Style& style, std::size_t columns) {
  std::string text = fmt::format("{}{}{}, {}, {}\n", style.strong, printable(result.catalog->file),
                                 style.reset, quantity(result.mutants.size(), "mutant"),
                                 quantity(result.missions.size(), "mission"));
  text += assumptions_to_text(*result.compiled, result.assumptions, columns);
  if (!result.mutants.empty()) text += table_to_text(result, style, columns);
  const std::string survivors = survivors_to_text(result, columns);
  text += survivors + summary_to_text(result.count(), columns);
  if (!survivors.empty() && !result.writes_scripts) {
    text +=
        wrap_line("--scripts DIR writes the missions that would notice the survivors", columns, 2) +
        "\n";
  }
  return text;
}

std::string mutants_to_github(const MutantsResult& result) {
  std::map<std::uint32_t, std::string> messages;  // by line
  for (std::size_t place = 0; place < result.mutants.size(); ++place) {
    const MutantVerdict& verdict = result.verdicts[place];
    if (verdict.result != MutantVerdict::Result::survived) continue;
    std::string& message = messages[result.mutants[place].lines.front()];
    if (!message.empty()) message += '\n';
    message += describe(*result.catalog, result.mutants[place]);
    if (verdict.script) message += "\n" + indent(*verdict.script);
    while (message.ends_with('\n')) message.pop_back();
  }
  std::string text;
  for (const auto& [line, message] : messages) {
    const Position begin{line, 1};
    text += github_command("notice", {result.catalog->file, Range{begin, begin}},
                           "No mission notices that", message);
  }
  return text;
}

std::span<const MutantsFormat> mutants_formats() {
  using Given = const MutantsResult&;
  static constexpr MutantsFormat formats[] = {
      {"text", mutants_to_text},
      {"json", [](Given result, const Style& /*style*/,
                  std::size_t /*columns*/) { return mutants_to_json(result); }},
      {"github", [](Given result, const Style& /*style*/,
                    std::size_t /*columns*/) { return mutants_to_github(result); }},
  };
  return formats;
}

}  // namespace cbc
