#pragma once

#include <array>

#include "core/compile/catalog_json.h"
#include "core/report/reason_words.h"
#include "core/support/json_description.h"
#include "runtime/coordinator/record.h"
#include "runtime/explain/reasons.h"

namespace cbc::json {

/// What reasons are about. The context of a reason has these members.
struct ReasonContext {
  const CompiledCatalog& catalog;
  const EventRecord& record;
};

namespace reasons {

inline constexpr auto task = member("task", json::task, "", &Reason::task);
inline constexpr auto behavior = member("behavior", json::behavior, "", &Reason::behavior);
inline constexpr auto catalog_line = member(
    "line", line_number, "The line in the catalog's YAML, from 1, that says so.", &Reason::line);

/// The tasks of an exclusion.
inline constexpr auto both_tasks =
    member("tasks", list(json::task).exactly(2).unique(), "", [](const Reason& of) {
      return std::array{of.task, of.other_task};
    });

inline constexpr auto best = object(
    "", "",
    member("task", json::task, "",
           [](ValueId id, const auto& context) { return context.catalog.task_of(id); }),
    member(
        "behavior", json::behavior, "",
        [](ValueId id, const auto& context) { return context.catalog.values.items[id].behavior; }),
    member("suitability", percentage, "In percent.", [](ValueId id, const auto& context) {
      return in_percent(context.catalog.values.items[id].suitability);
    }));

}  // namespace reasons

/// One of the reasons of a conflict set.
inline constexpr auto reason = variants(
    "reason", "One of the reasons why there is no solution, or why there is no alternative.",
    group(), "kind", &Reason::kind,
    group(member("message", text, "The same as a sentence for people.",
                 [](const Reason& of, const auto& context) {
                   return describe_reason(context.catalog, context.record, of);
                 })),
    variant(
        {Reason::Kind::is_protected, Reason::Kind::priority},
        "protected: the task may not stop, since its request is stronger than the event. "
        "priority: the task of the event has a stronger request; this is the only reason, found "
        "before any search.",
        reasons::task, member("priority", priority, "Priority of the request.", &Reason::priority)),
    variant({Reason::Kind::no_behavior, Reason::Kind::on_request, Reason::Kind::stopped},
            "no_behavior: no behavior performs the task; this is the only reason. on_request: the "
            "task starts only on request, and has none. stopped: the event stops the task; only in "
            "`why`.",
            reasons::task),
    variant(
        {Reason::Kind::unavailable, Reason::Kind::situation, Reason::Kind::faulty,
         Reason::Kind::finished},
        "unavailable: a script said that it cannot be activated. situation: it does not fit the "
        "values of the situation variables, or, where this is about any situation, fits only in "
        "some. faulty: its activation failed in this event. finished: the event reports that it "
        "ended; only in `why`.",
        reasons::behavior),
    variant({Reason::Kind::exclusive}, "At most one of the two tasks may run.", reasons::both_tasks,
            reasons::catalog_line),
    variant({Reason::Kind::requires_task}, "While the behavior performs a task, `task` must run.",
            reasons::behavior, reasons::task, reasons::catalog_line),
    variant(
        {Reason::Kind::performance},
        "While the behavior performs a task, `task` must have the minimum performance; without "
        "a behavior, whenever `task` runs.",
        optional("behavior", behavior, "", &Reason::behavior), reasons::task, reasons::catalog_line,
        optional("best", list(reasons::best).at_least(1),
                 "With what the task would do best without this minimum: its behavior and those "
                 "of all tasks that it requires; their product is its performance. Absent if it "
                 "is not known.",
                 [](const Reason& of) { return of.best.empty() ? nullptr : &of.best; })));

}  // namespace cbc::json
