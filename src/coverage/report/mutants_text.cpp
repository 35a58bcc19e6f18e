#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/report/layout.h"
#include "core/report/table.h"
#include "core/report/test_report.h"
#include "core/report/words.h"
#include "core/support/wording.h"
#include "coverage/report/coverage_report.h"
#include "runtime/base/text.h"

// Mutants as text and as annotations.

namespace cbc {
namespace {

/// The mission that notices it, or the result.
std::string noticed_by(const MutantsResult& result, const MutantVerdict& verdict) {
  if (verdict.result == MutantVerdict::Result::survived) return "SURVIVED";
  if (!verdict.notice) return std::string(name_of(verdict.result));
  const std::string mission = printable(result.missions[verdict.notice->mission]);
  return verdict.notice->line == 0 ? mission : fmt::format("{}:{}", mission, verdict.notice->line);
}

void add_table(const MutantsResult& result, Text& text) {
  if (result.mutants.empty()) return;
  Table table(text.style(), {number_column("line", 9), {"noticed by"}, {"changed"}},
              {.columns = text.columns()});
  for (std::size_t place = 0; place < result.mutants.size(); ++place) {
    const Mutant& mutant = result.mutants[place];
    const MutantVerdict& verdict = result.verdicts[place];
    const bool has_survived = verdict.result == MutantVerdict::Result::survived;
    table.add({join(mutant.lines, ",", [](std::uint32_t line) { return std::to_string(line); }),
               {noticed_by(result, verdict), has_survived ? text.style().bad : std::string_view()},
               describe(*result.catalog, mutant)});
  }
  text.add("\n" + table.text());
}

void add_survivors(const MutantsResult& result, Text& text) {
  bool is_first = true;
  for (std::size_t place = 0; place < result.mutants.size(); ++place) {
    const MutantVerdict& verdict = result.verdicts[place];
    if (verdict.result != MutantVerdict::Result::survived) continue;
    if (is_first) text.add("\nno mission notices that; these would\n");
    is_first = false;
    const Mutant& mutant = result.mutants[place];
    text.line("  {}:{}: {}", printable(result.catalog->file), mutant.lines.front(),
              describe(*result.catalog, mutant));
    text.add(indent(*verdict.script));
  }
}

/// What counts, and what does not.
void add_summary(const MutantCount& count, Text& text) {
  std::string counts = fmt::format("mutants: {} noticed, {} survived, {} equivalent", count.noticed,
                                   count.survived, count.equivalent);
  if (count.undecided > 0) counts += fmt::format(", {} undecided", count.undecided);
  if (count.unjudged > 0) counts += fmt::format(", {} not judged", count.unjudged);
  text.line("");
  text.line(counts);
  text.line("score: {}", count.is_score_known() ? describe_percent(count.score()) : "unknown");
  if (const std::uint64_t limited = count.undecided - count.without_script; limited > 0) {
    text.line(
        "undecided: a limit came before it was known whether a mission could notice {}; see "
        "--max-states, --max-memory and --time-limit",
        quantity(limited, "mutant"));
  }
  if (count.without_script > 0) {
    text.line(
        "undecided: {} may differ from the catalog, but no mission was found that shows it, as it "
        "may take a timeout that comes at the right time",
        quantity(count.without_script, "mutant"));
  }
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
  Text text(style, columns);
  const MutantCount count = result.count();
  text.add(fmt::format("{}, {}, {}\n", style.paint(style.strong, printable(result.catalog->file)),
                       quantity(result.mutants.size(), "mutant"),
                       quantity(result.missions.size(), "mission")));
  text.add(assumptions_to_text(*result.compiled, result.assumptions, columns));
  add_table(result, text);
  add_survivors(result, text);
  add_summary(count, text);
  if (count.survived > 0 && !result.writes_scripts) {
    text.line("--scripts DIR writes the missions that would notice the survivors");
  }
  return text.take();
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
  TestSuite suite{result.catalog->file};
  for (const auto& [line, message] : messages) {
    suite.cases.push_back(notice_of_line(line, "No mission notices that", message));
  }
  return github_format.suite(suite);
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
