#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/report/assumptions_json.h"
#include "core/report/blocks.h"
#include "core/report/test_report.h"
#include "core/support/json_description.h"
#include "core/support/wording.h"
#include "core/words/words.h"
#include "coverage/report/coverage_report.h"
#include "runtime/base/text.h"

// Mutants as text, as annotations and as JSON.

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
  text.line("");
  text.table(table);
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
  std::string unknown;
  if (count.undecided > 0) unknown += fmt::format(", {} undecided", count.undecided);
  if (count.unjudged > 0) unknown += fmt::format(", {} not judged", count.unjudged);
  text.line("");
  text.line("mutants: {} noticed, {} survived, {} equivalent{}", count.noticed, count.survived,
            count.equivalent, unknown);
  const GoalCount score = count.score();
  std::string line = "score: " + describe_percent(score);
  if (!count.is_complete()) {
    line += fmt::format(" ({} of {}; {})", score.met, score.goals, unknown.substr(2));
  }
  text.line(line);
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

namespace {

/// A table by line, then the survivors with a mission that would notice each.
void add_mutants(const MutantsResult& result, Text& text) {
  const MutantCount count = result.count();
  text.heading(fmt::format("{}, {}, {}", printable(result.catalog->file),
                           quantity(result.mutants.size(), "mutant"),
                           quantity(result.missions.size(), "mission")));
  text.paragraph(describe_assumptions(*result.compiled, result.assumptions));
  add_table(result, text);
  add_survivors(result, text);
  add_summary(count, text);
  if (count.survived > 0 && !result.writes_scripts) {
    text.line("--scripts DIR writes the missions that would notice the survivors");
  }
}

std::vector<Diagnostic> survivors(const MutantsResult& result) {
  std::vector<Diagnostic> findings;
  for (std::size_t place = 0; place < result.mutants.size(); ++place) {
    const MutantVerdict& verdict = result.verdicts[place];
    if (verdict.result != MutantVerdict::Result::survived) continue;
    const Mutant& mutant = result.mutants[place];
    std::string message = describe(*result.catalog, mutant);
    if (verdict.script) message += "\n" + indent(*verdict.script);
    message.resize(message.find_last_not_of('\n') + 1);
    findings.push_back(notice_of_line(result.catalog->file, mutant.lines.front(),
                                      "mutants: no mission notices that", std::move(message)));
  }
  return findings;
}

}  // namespace

std::span<const ReportFormat<MutantsResult>> mutants_formats() {
  static constexpr ReportFormat<MutantsResult> formats[] = {
      {"text", as_text<add_mutants>},
      {"json", for_programs<mutants_to_json>},
      {"github", as_annotations<survivors>},
  };
  return formats;
}

namespace json::mutants {

// Mutants are places in the list of all; the context is the MutantsResult.

using Kind = Mutant::Kind;
using Result = MutantVerdict::Result;

constexpr auto mutant_at = [](std::size_t place, const MutantsResult& of) -> const Mutant& {
  return of.mutants[place];
};
constexpr auto verdict_at = [](std::size_t place, const MutantsResult& of) -> const auto& {
  return of.verdicts[place];
};

/// The name of something of the catalog, at the place that the mutant has of it.
constexpr auto name = [](std::string_view key, std::string_view meaning, auto things, auto place) {
  return member(
      key, text, meaning,
      [ things, place ](std::size_t number, const MutantsResult& of) -> const auto& {
        return (of.catalog->*things)[mutant_at(number, of).*place].name;
      });
};
constexpr auto task = [](std::string_view meaning) {
  return name("task", meaning, &Catalog::tasks, &Mutant::task);
};
constexpr auto behavior = name("behavior", "", &Catalog::behaviors, &Mutant::behavior);

constexpr auto notice =
    object("notice", "",
           member(
               "mission", text, "The script.",
               [](const Notice& of, const MutantsResult& result) -> const auto& {
                 return result.missions[of.mission];
               }),
           member("how", words(Notice::How::ended),
                  "An expectation failed, or the run ended early.", &Notice::how),
           optional("line", line_number, "Of the expectation; missing if the run ended early.",
                    [](const Notice& of) { return of.line > 0 ? &of.line : nullptr; }),
           member("message", text, "What was expected and what was found, for people.",
                  &Notice::message))
        .related(R"([{"if": {"properties": {"how": {"const": "ended"}}},
                  "then": {"properties": {"line": false}}, "else": {"required": ["line"]}}])");

constexpr auto mutant =
    variants(
        "mutant", "The catalog with one thing changed, and what became of it.", group(), "kind",
        [](std::size_t place, const MutantsResult& of) { return mutant_at(place, of).kind; },
        group(part(mutant_at,
                   group(member("lines", lines, "Lines of the catalog, ascending.", &Mutant::lines),
                         member("change", text, "What was changed, in words.",
                                [](const Mutant& of, const MutantsResult& result) {
                                  return describe(*result.catalog, of);
                                }))),
              part(verdict_at,
                   group(member("result", words(Result::unjudged), "", &MutantVerdict::result),
                         optional(
                             "reason", words(MutantVerdict::Doubt::no_script),
                             "Why it is undecided: a limit came first, or it differs between "
                             "states, which have no times, but no script that was tried shows it.",
                             [](const MutantVerdict& of) {
                               return of.result == Result::undecided ? &of.doubt : nullptr;
                             }),
                         optional("noticed_by", notice, "The first mission that notices it.",
                                  &MutantVerdict::notice),
                         optional("script", text, "Of a survivor: a mission that would notice it.",
                                  &MutantVerdict::script)))),
        variant({Kind::behavior_removed}, "", behavior),
        variant({Kind::suitability_lowered}, "", behavior, task("That it performs."),
                name("below", "The behavior that comes next.", &Catalog::behaviors, &Mutant::other),
                member("suitability", percentage, "In percent, after the change.",
                       [](std::size_t place, const MutantsResult& of) {
                         return in_percent(mutant_at(place, of).suitability);
                       })),
        variant({Kind::requirement_removed}, "", behavior, task("That it requires.")),
        variant({Kind::minimum_removed}, "",
                optional("behavior", text,
                         "That requires it; missing if it is the minimum of the task itself.",
                         [](std::size_t place, const MutantsResult& of) {
                           const std::uint32_t index = mutant_at(place, of).behavior;
                           return index != Mutant::none ? &of.catalog->behaviors[index].name
                                                        : nullptr;
                         }),
                task("")),
        variant({Kind::condition_removed}, "", behavior,
                name("variable", "", &Catalog::variables, &Mutant::variable)),
        variant({Kind::exclusion_removed}, "", task(""),
                name("other_task", "", &Catalog::tasks, &Mutant::other)),
        variant({Kind::exclusion_narrowed}, "", task("Taken out of a list of at least three.")),
        variant({Kind::timeout_removed}, "", task("Whose timeout it is."))
            .where([](std::size_t place, const MutantsResult& of) {
              return mutant_at(place, of).task != Mutant::none;
            }),
        variant({Kind::timeout_removed}, "Of its own.", behavior),
        variant({Kind::start_on_request_turned, Kind::reactive_start_turned,
                 Kind::execution_goal_turned},
                "", task("")))
        .related(R"([
      {"if": {"properties": {"result": {"const": "noticed"}}},
       "then": {"required": ["noticed_by"]}, "else": {"properties": {"noticed_by": false}}},
      {"if": {"properties": {"result": {"const": "survived"}}},
       "then": {"required": ["script"]}, "else": {"properties": {"script": false}}},
      {"if": {"properties": {"result": {"const": "undecided"}}},
       "then": {"required": ["reason"]}, "else": {"properties": {"reason": false}}}])");

constexpr auto counts = group(
    member("noticed", count, "Number of mutants that some mission notices.", &MutantCount::noticed)
        .on_line(),
    member("survived", count, "Number of those that no mission notices, although one could.",
           &MutantCount::survived),
    member("equivalent", count, "Number of those that no mission can notice. They do not count.",
           &MutantCount::equivalent),
    member("undecided", count,
           "Number of those that no mission notices, and of which it is not known whether one "
           "could. They count as not noticed.",
           &MutantCount::undecided),
    member(
        "unjudged", count,
        "Number of those that were left when a time limit or a signal ended the work. They count "
        "as not noticed.",
        &MutantCount::unjudged),
    member("percent", percentage,
           "Percentage of the mutants that are noticed, rounded down to tenths: of all but those "
           "that are equivalent. Those that are undecided or unjudged count as not noticed. 100 of "
           "none.",
           [](const MutantCount& of) { return static_cast<double>(of.score().tenths()) / 10; }));

constexpr auto report = object(
    "",
    "The output of `cbc coverage --mutants --format json` (schema cbc.mutants/1): which "
    "changes "
    "of a "
    "catalog its missions notice. docs/coverage.md says what is changed.",
    schema_member("cbc.mutants/1"),
    member(
        "catalog", text, "The catalog, as given.",
        [](const MutantsResult& of) -> const auto& { return of.catalog->file; }),
    member("missions", texts.at_least(1), "The scripts, in the order in which they ran.",
           &MutantsResult::missions)
        .on_line(),
    member("assumptions",
           scoped(
               [](const auto&, const MutantsResult& of) -> const auto& { return *of.compiled; },
               assumptions),
           "Under which no mission can notice those that are equivalent.",
           &MutantsResult::assumptions)
        .on_line(),
    part(&MutantsResult::count, counts),
    member("mutants", list(mutant).on_lines(), "All mutants, by line.",
           [](const MutantsResult& of) { return places_below(of.mutants.size()); })
        .on_line());

}  // namespace json::mutants

std::string mutants_to_json(const MutantsResult& result) {
  return json::document(json::mutants::report, result, result);
}

std::string mutants_schema() {
  return json::schema("mutants", "Mutants of a catalog", json::mutants::report);
}

}  // namespace cbc
