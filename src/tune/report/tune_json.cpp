#include "core/compile/catalog_json.h"
#include "core/support/json_description.h"
#include "core/words/words.h"
#include "runtime/base/text.h"
#include "tune/report/tune_report.h"

namespace cbc {
namespace json::tune {

// Numbers are places in the list of all; the context is the TuneResult.

/// A value in percent, as a decimal, which is exact.
constexpr auto value_member = [](std::string_view name, std::string_view meaning, auto value) {
  return member(name, text, meaning, [value](const auto& of, const auto& context) {
    return format_decimal(project(value, of, context), 4);
  });
};
constexpr auto interval =
    group(value_member("low", "The lowest value, in percent.", &Interval::low),
          value_member("high", "The highest value, in percent.", &Interval::high));
constexpr auto mission = [](std::size_t place, const TuneResult& result) -> const std::string& {
  return result.missions[place];
};

constexpr auto failure =
    object("failure", "An expectation that fails.",
           member("mission", text, "The script.",
                  [](const Recording::Failure& of, const TuneResult& result) {
                    return mission(of.mission, result);
                  }),
           member("line", line_number, "",
                  [](const Recording::Failure& of) { return of.expectation.range.begin.line; }),
           member("message", text, "What was expected and what was found, for people.",
                  [](const Recording::Failure& of) { return of.expectation.message; }));

constexpr auto move = object(
    "move", "", member("task", task, "", &ValueChange::task),
    member("before", nullable(behavior), "Now; null: it does not run.", &ValueChange::before),
    member("now", nullable(behavior), "With the other value.", &ValueChange::now));

constexpr auto outcome_of = [](const std::optional<EventRecord>& event) {
  return event ? &event->outcome : nullptr;
};
constexpr auto instead =
    object("instead", "What is decided in place of what.",
           member("outcome", nullable(words(Outcome::unchanged)),
                  "With the other value; null: the event does not happen.",
                  [](const RunDifference& of) { return outcome_of(of.now); }),
           member("outcome_before", nullable(words(Outcome::unchanged)),
                  "Now; null: the event does not happen.",
                  [](const RunDifference& of) { return outcome_of(of.before); }),
           member("tasks", list(move), "With other behaviors, in catalog order by groups.",
                  &RunDifference::moves));

constexpr auto property =
    object("property", "", member("line", line_number, "Of the property file.", &Property::line),
           member("property", text, "In words.", [](const Property& of, const TuneResult& result) {
             return describe_property(result.catalog, of);
           }));

constexpr auto difference = object(
    "difference", "The first event that is different beyond a bound.",
    member("mission", nullable(text), "The script. Null: of a state.",
           [](const RunDifference& of, const TuneResult& result) {
             return of.in_state ? nullptr : &mission(of.mission, result);
           }),
    member(
        "line", nullable(line_number),
        "Of the event, or of the last one of the script before it; null: there is none.",
        [](const RunDifference& of) { return of.line > 0 && !of.in_state ? &of.line : nullptr; }),
    member("event", integer(1), "Its number, counting all events.", &RunDifference::event),
    member(
        "instead", instead, "", [](const RunDifference& of) -> const auto& { return of; }),
    member("fails", nullable(failure), "The first expectation that then fails.",
           &RunDifference::failure),
    optional("moves", texts.at_least(1),
             "With --all-states: a shortest way to the event, which is the last one of it, "
             "in words.",
             [](const RunDifference& of, const TuneResult& result) {
               return of.in_state ? std::optional(moves_to(result, of)) : std::nullopt;
             }),
    optional("breaks", property,
             "With --all-states: the first property that holds now, and then no more.",
             [](const RunDifference& of, const TuneResult& result) {
               return of.in_state && of.in_state->broken_property
                          ? &result.states->file.properties[*of.in_state->broken_property]
                          : nullptr;
             }));

constexpr auto repair = object(
    "repair", "Values with which all expectations hold.", part(&NumberRepair::values, interval),
    value_member("nearest", "The nearest of them, with the margin.", &NumberRepair::nearest),
    member("differs",
           list(object(
               "changed", "",
               member(
                   "mission", text, "", [](const auto& of) -> const auto& { return of.first; }),
               member(
                   "lines", lines.at_least(1), "Of the script, ascending.",
                   [](const auto& of) -> const auto& { return of.second; }))),
           "The events that are different with the nearest value.",
           [](const NumberRepair& of, const TuneResult& result) {
             return [&](const auto& put) {
               for (std::size_t place = 0; place < of.changed.size(); ++place) {
                 if (of.changed[place].empty()) continue;
                 put(std::pair(std::string_view(result.missions[place]),
                               std::span(of.changed[place])));
               }
             };
           }));

constexpr auto number_at = [](std::size_t place, const TuneResult& of) -> const TunableNumber& {
  return of.numbers[place];
};
constexpr auto tuned_at = [](std::size_t place, const TuneResult& of) -> const TunedNumber& {
  return of.tuned[place];
};

constexpr auto identity = group(
    member("kind", words(NumberPlace::Kind::minimum_performance), "", &TunableNumber::kind),
    member("behavior", nullable(text), "Null: of several or none, or the minimum of a task.",
           [](const TunableNumber& of, const TuneResult& result) {
             const std::uint32_t place = behavior_of(of);
             return place == none ? nullptr : &result.source.behaviors[place].name;
           }),
    member("task", nullable(text), "That it performs or requires. Null: of several or none.",
           [](const TunableNumber& of, const TuneResult& result) {
             const std::uint32_t place = task_of(of);
             return place == none ? nullptr : &result.source.tasks[place].name;
           }),
    member("line", nullable(line_number),
           "Of the catalog. Null: the default suitability, which stands nowhere.",
           [](const TunableNumber& of) { return of.range ? &of.range->begin.line : nullptr; }),
    value_member("value", "In percent.", &TunableNumber::value));

constexpr auto tolerance =
    group(part(&Tolerance::values, interval),
          member("below", nullable(difference), "Null: the number may be 0.", &Tolerance::below),
          member("above", nullable(difference), "Null: the number may be 100.", &Tolerance::above));

constexpr auto number = object(
    "number", "A place of the catalog with a suitability or a minimum performance.",
    part(number_at, identity), part(tuned_at, part(&TunedNumber::tolerance, tolerance)),
    member("used", boolean,
           "false: no behavior or task has the number, or no decision of any state uses it.",
           [](std::size_t place, const TuneResult& of) { return of.tuned[place].is_used; }),
    part(tuned_at,
         part(&TunedNumber::repairs,
              group(member("repairs", list(repair),
                           "Where expectations fail: with which values they hold, ascending.",
                           &Repairs::intervals),
                    optional("incomplete", always_true, "Not all values were looked at.",
                             [](const Repairs& of) { return !of.is_complete; })))));

constexpr auto report = object(
    "",
    "The output of `cbc tune --format json` (schema cbc.tune/1): how wrong each number of a "
    "catalog may be before missions go differently. docs/tuning.md explains it.",
    schema_member("cbc.tune/1"),
    member(
        "catalog", text, "The catalog, as given.",
        [](const TuneResult& of) -> const auto& { return of.source.file; }),
    optional("missions", texts.at_least(1),
             "The scripts, in the order in which they ran. With --all-states there are none.",
             [](const TuneResult& of) { return of.states ? nullptr : &of.missions; })
        .on_line(),
    optional("states",
             object("states", "",
                    member("file", nullable(text), "The property file that says what is assumed.",
                           [](const TunedStates& of) {
                             return of.file.path.empty() ? nullptr : &of.file.path;
                           }),
                    member("states", count, "", &TunedStates::states),
                    member("transitions", count, "", &TunedStates::transitions),
                    member("decisions", count, "Different ones.", &TunedStates::decisions)),
             "With --all-states: what was looked at in place of missions, of all groups.",
             &TuneResult::states)
        .on_line(),
    member("numbers", list(number).on_lines(), "In the order of the file.",
           [](const TuneResult& of) { return places_below(of.numbers.size()); })
        .on_line(),
    member(
        "expectations",
        object("expectations", "Of all missions, with the numbers as they are.",
               member("passed", count, "", &Recording::passed),
               member("failed", count, "", [](const Recording& of) { return of.failures.size(); }),
               member("failures", list(failure), "", &Recording::failures)),
        "", [](const TuneResult& of) -> const auto& { return of.present; })
        .on_line());

}  // namespace json::tune

std::string tune_to_json(const TuneResult& result) {
  return json::document(json::tune::report, result, result);
}

std::string tune_schema() {
  return json::schema("tune", "Tuning of a catalog", json::tune::report);
}

}  // namespace cbc
