#pragma once

#include <cstddef>

#include "core/report/assumptions_json.h"
#include "core/support/json_description.h"
#include "verify/report/verify_report.h"

// Who gives way to whom, as JSON. The context is the catalog.

namespace cbc::json::verify {

/// Two requests, by the places of their tasks in the matrix.
struct PairOfRequests {
  const OverrideMatrix& matrix;
  std::size_t first = 0;
  std::size_t second = 0;

  [[nodiscard]] const Override& with(PriorityOfSecond priority) const {
    return matrix.at(first, second)[static_cast<std::size_t>(priority)];
  }
};

constexpr auto changed_behavior =
    object("changed_behavior", "", member("task", task, "", &Override::Change::task),
           member("alone", behavior, "With which it runs if it alone is requested.",
                  &Override::Change::alone),
           member("now", behavior, "With which it runs now.", &Override::Change::now));

constexpr auto override_result = object(
    "override", "",
    member("result", words(Override::Kind::not_started),
           "both: both run, each with the behavior that it has alone. other: both run, one with "
           "another behavior than alone, none with a worse one. worse: both run, one with a less "
           "suitable behavior than alone. stops: the first one stops. rejected: the second one is "
           "rejected. not_started: the first one is rejected already.",
           &Override::kind),
    member("changes", list(changed_behavior), "Of other and worse: what differs.",
           &Override::changes));

constexpr auto pair_of_requests = object(
    "pair_of_requests", "",
    member("first", task, "The task that is requested first, from idle.",
           [](const PairOfRequests& of) { return of.matrix.tasks[of.first]; }),
    member("second", task, "The task that is requested then.",
           [](const PairOfRequests& of) { return of.matrix.tasks[of.second]; }),
    member(
        "same", override_result, "If the second request has the same priority.",
        [](const PairOfRequests& of) -> const auto& { return of.with(PriorityOfSecond::same); }),
    member(
        "higher", override_result, "If it has a higher one.",
        [](const PairOfRequests& of) -> const auto& { return of.with(PriorityOfSecond::higher); }),
    member(
        "lower", override_result, "If it has a lower one.",
        [](const PairOfRequests& of) -> const auto& { return of.with(PriorityOfSecond::lower); }));

constexpr auto overrides = object(
    "overrides", "",
    member("situation", situation,
           "The values of all variables, and which behaviors are available, as far as that is "
           "given.",
           [](const ReportedOverrides& of, const CompiledCatalog& catalog) {
             return entries_of_part(of.situation, catalog);
           }),
    member("complete", boolean, "false: a limit ended the search, so pairs are missing.",
           [](const ReportedOverrides& of) { return of.matrix.complete; }),
    member("pairs", list(pair_of_requests).on_lines(),
           "The ordered pairs of tasks that can be requested, in catalog order.",
           [](const ReportedOverrides& of) {
             return [&matrix = of.matrix](const auto& put) {
               for (std::size_t first = 0; first < matrix.row_count(); ++first) {
                 for (std::size_t second = 0; second < matrix.tasks.size(); ++second) {
                   if (first != second) put(PairOfRequests{matrix, first, second});
                 }
               }
             };
           }));

}  // namespace cbc::json::verify
