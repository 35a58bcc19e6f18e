#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "core/compile/catalog_json.h"
#include "core/report/assumptions_json.h"
#include "core/support/json.h"
#include "core/support/json_description.h"
#include "core/yaml/document.h"
#include "core/yaml/json_value.h"
#include "coverage/report/coverage_report.h"
#include "runtime/base/text.h"

namespace cbc {
namespace json::coverage {

// The context of goals, which are places in the list of all, is their CatalogCoverage.

constexpr auto goal_at = [](std::size_t place, const CatalogCoverage& of) -> const Goal& {
  return of.goals()[place];
};

/// A member that some goals lack.
constexpr auto task = [](std::string_view meaning) {
  return member("task", json::task, meaning, &Goal::task);
};
constexpr auto behavior = [](std::string_view meaning) {
  return member("behavior", json::behavior, meaning, &Goal::behavior);
};

using Kind = Goal::Kind;

/// What says which goal it is, and after it what else there is to say.
constexpr auto goal_with = [](auto goal, auto tail) {
  const auto about = [goal](auto... members) { return part(goal, group(members...)); };
  return variants(
      "goal", "Something that a mission can show.", group(), "kind",
      [goal](const auto& of, const auto& context) { return project(goal, of, context).kind; }, tail,
      variant(
          {Kind::task_ran, Kind::reactive_started, Kind::reactive_gave_way, Kind::reactive_returned,
           Kind::higher_displaced, Kind::lower_rejected, Kind::equal_displaced},
          "", about(task(""))),
      variant({Kind::behavior_active, Kind::behavior_succeeded, Kind::behavior_failed,
               Kind::behavior_replaced, Kind::behavior_began_to_fit, Kind::behavior_ceased_to_fit},
              "", about(behavior(""))),
      variant({Kind::requirement_used, Kind::requirement_decided}, "",
              about(behavior(""), task("That it requires."))),
      variant({Kind::minimum_decided}, "",
              about(optional("behavior", json::behavior,
                             "That requires it; missing if it is the minimum of the task itself.",
                             &Goal::behavior),
                    task(""))),
      variant({Kind::exclusion_decided}, "",
              about(task(""), member("other_task", json::task, "", &Goal::other_task))),
      variant({Kind::timeout_fired}, "", about(task("Whose timeout it is.")))
          .where([goal](const auto& of, const auto& context) {
            return project(goal, of, context).task != none;
          }),
      variant({Kind::timeout_fired}, "", about(behavior("Whose timeout it is."))),
      variant({Kind::variable_value}, "",
              about(member("variable", variable, "", &Goal::variable),
                    member("value", text, "As text.", [](const Goal& of, const auto& context) {
                      return catalog_in(context).name_of_value({of.variable, of.value});
                    }))));
};

constexpr auto identity = goal_with(std::identity(), group());

constexpr auto goal =
    goal_with(
        goal_at,
        group(member(
                  "lines", lines, "Lines of the catalog, ascending.",
                  [](std::size_t place, const CatalogCoverage& of) -> const auto& {
                    return of.goals()[place].lines;
                  }),
              optional(
                  "unreachable", always_true,
                  "With --prove: no mission can meet it under the assumptions, and so it does not "
                  "count.",
                  [](std::size_t place, const CatalogCoverage& of) {
                    return of.is_unreachable(place);
                  }),
              optional("reason", text, "Why it is unreachable, for people.",
                       [](std::size_t place, const CatalogCoverage& of) {
                         return of.is_unreachable(place) ? &of.reason_of(place) : nullptr;
                       }),
              member("met_by", names, "The missions that meet it.",
                     [](std::size_t place, const CatalogCoverage& of) {
                       return [place, &of](const auto& put) {
                         for (const std::uint32_t mission : of.missions_of(place)) {
                           put(of.missions()[mission]);
                         }
                       };
                     })))
        .related(
            R"([{"dependentRequired": {"unreachable": ["reason"], "reason": ["unreachable"]}}])");

constexpr auto numbers = group(
    member("goals", count, "Number of goals, without unreachable ones.", &GoalCount::goals),
    member("met", count, "How many of them some mission meets.", &GoalCount::met),
    member("unreachable", count,
           "With --prove: how many more are proven unreachable. They are not among the goals.",
           &GoalCount::unreachable),
    member("percent", percentage,
           "Percentage of the goals that are met, rounded down to tenths; 100 of no goals.",
           [](const GoalCount& of) { return static_cast<double>(of.tenths()) / 10; }));

using Section = std::pair<GoalSection, GoalCount>;

constexpr auto section =
    object("section", "", member("section", words(GoalSection::priorities), "", &Section::first),
           part(&Section::second, numbers));

constexpr auto catalog = object(
    "catalog", "",
    member("catalog", text, "The catalog, as given.",
           [](const CatalogCoverage& of) { return of.catalog().file; }),
    member("digest", digest, "XXH3-128 digest of its text.", &CatalogCoverage::digest),
    member("missions", names, "The scripts, in the order in which they ran.",
           &CatalogCoverage::missions)
        .on_line(),
    optional("incomplete", always_true,
             "With --prove: a limit or an interrupt ended the proof, so that goals that are not "
             "marked as unreachable may be so all the same.",
             [](const CatalogCoverage& of) { return !of.is_proved(); })
        .on_line(),
    optional("assumptions", assumptions, "With --prove: under which goals are proven unreachable.",
             &CatalogCoverage::assumptions)
        .on_line(),
    member("total", object("numbers", "", numbers), "Of all goals.", &CatalogCoverage::total)
        .on_line(),
    member("sections", list(section).on_lines(), "Of the goals of each section that has some.",
           [](const CatalogCoverage& of) {
             return [&of](const auto& put) {
               std::uint8_t place = 0;
               for (const GoalCount& goals : of.by_section()) {
                 const Section counted(static_cast<GoalSection>(place++), goals);
                 if (goals.goals + goals.unreachable > 0) put(counted);
               }
             };
           })
        .on_line(),
    member("goals", list(goal).on_lines(), "All goals: by section, and in it in catalog order.",
           [](const CatalogCoverage& of) { return places_below(of.goals().size()); })
        .on_line());

constexpr auto report =
    object("",
           "The output of `cbc coverage --format json` (schema cbc.coverage/1): which goals "
           "of catalogs the missions meet. docs/coverage.md defines the goals.",
           schema_member("cbc.coverage/1"), part(&Coverage::total, numbers),
           member("catalogs", list(scoped(std::identity(), catalog)).at_least(1).on_lines(),
                  "The catalogs, in the order of their first missions.", &Coverage::catalogs)
               .on_line());

}  // namespace json::coverage

std::string coverage_to_json(const Coverage& coverage) {
  return json::document(json::coverage::report, coverage);
}

std::string coverage_schema() {
  return json::schema("coverage", "Coverage of missions", json::coverage::report);
}

}  // namespace cbc
