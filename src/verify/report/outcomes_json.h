#pragma once

#include "core/report/assumptions_json.h"
#include "core/support/json_description.h"
#include "verify/report/verify_report.h"

// What events can come to, as JSON. The context is the catalog.

namespace cbc::json::verify {

constexpr auto outcome_of = [](const ReportedOutcome& of) -> const auto& { return *of.outcome; };

constexpr auto reachable_outcome = object(
    "outcome", "",
    part(outcome_of,
         group(member("running", map(task, behavior),
                      "The tasks that run, each with its behavior, in catalog order.",
                      [](const ReachableOutcome& of, const CompiledCatalog& catalog) {
                        return [&](const auto& put) {
                          for (const auto& [task, behavior] : of.running) {
                            put(catalog.task_ids[task], catalog.behavior_ids[behavior]);
                          }
                        };
                      }),
               member("situation", situation,
                      "At the end of the script: the values of the variables, and which behaviors "
                      "are available, as far as that is part of the states of the group.",
                      [](const ReachableOutcome& of, const CompiledCatalog& catalog) {
                        return entries_of_part(of.situation, catalog);
                      }),
               member("faulty", behaviors, "The behaviors that are faulty then.",
                      &ReachableOutcome::faulty),
               member("length", count, "The number of moves of `script`.",
                      [](const ReachableOutcome& of) { return of.script.size(); }))),
    member(
        "script", any_text,
        "A shortest event script that leads there: its text, or with --scripts its path.",
        [](const ReportedOutcome& of) -> const auto& {
          return of.script_path ? *of.script_path : of.witness.text;
        }));

}  // namespace cbc::json::verify
