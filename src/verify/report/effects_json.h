#pragma once

#include <optional>

#include "core/report/assumptions_json.h"
#include "core/support/json_description.h"
#include "core/words/suitability.h"
#include "verify/report/verify_report.h"

// The effects of faults, as JSON. The context is the catalog.

namespace cbc::json::verify {

/// The effects on a task, with the report that they are part of.
struct EffectsOfTask {
  const ReportedEffects& report;
  const TaskEffects& of_task;
};

/// One of them.
struct EffectOnTask {
  TaskId task;
  const Effect& effect;
};

/// The best assignment in which a task runs.
struct BestOfTask {
  TaskId task;
  const BestAssignment& best;
};

constexpr auto best_assignment = group(
    member("behaviors", nullable(behaviors),
           "The active behaviors of the best assignment in which the task runs, in catalog order; "
           "null: it cannot run.",
           [](const BestOfTask& of, const CompiledCatalog& catalog) {
             std::optional<BehaviorSet> active;
             if (of.best) active = behaviors_of(catalog, of.task, *of.best);
             return active;
           }),
    member("suitability", nullable(share),
           "The product of the suitabilities of all tasks that run then, from 0 to 1, as the "
           "nearest double; null: it cannot run.",
           [](const BestOfTask& of, const CompiledCatalog& catalog) {
             std::optional<double> suitability;
             if (of.best) suitability = product_of(suitabilities_of(catalog, of.task, *of.best));
             return suitability;
           }));

constexpr auto effect = object(
    "effect", "",
    member(
        "faults", behaviors, "The behaviors that are faulty, in catalog order.",
        [](const EffectOnTask& of) -> const auto& { return of.effect.faults; }),
    member("situation", situation, "What changes in the situation: at most one variable.",
           [](const EffectOnTask& of, const CompiledCatalog& catalog) {
             return [&](const auto& put) {
               const auto& change = of.effect.change;
               if (change) put(catalog.name_of_variable(change->variable), *change);
             };
           }),
    member("effect", words(Effect::Kind::unchanged),
           "lost: the task cannot run. degraded: other behaviors are active. none: the same ones.",
           [](const EffectOnTask& of) { return of.effect.kind; }),
    part(
        [](const EffectOnTask& of) {
          return BestOfTask{of.task, of.effect.best};
        },
        best_assignment));

constexpr auto task_effects = object(
    "task_effects", "",
    member("task", task, "", [](const EffectsOfTask& of) { return of.of_task.task; }),
    part(
        [](const EffectsOfTask& of) {
          return BestOfTask{of.of_task.task, of.of_task.best};
        },
        best_assignment),
    member("complete", boolean, "false: a limit ended the search, so effects are missing.",
           [](const EffectsOfTask& of) { return of.of_task.complete; }),
    member("effects", list(effect).on_lines(),
           "Of each single fault; of several faults together, if no part of them has the same "
           "effect; with --situations of each single change. Of a task that cannot run even "
           "without a fault one, without faults.",
           [](const EffectsOfTask& of, const CompiledCatalog& catalog) {
             return [&](const auto& put) {
               for (const Effect& one : of.report.all_of(catalog, of.of_task)) {
                 put(EffectOnTask{of.of_task.task, one});
               }
             };
           }));

constexpr auto effects = object(
    "effects", "",
    member("order", integer(1), "The most faults together (--order).", &ReportedEffects::order),
    member("situation", situation,
           "From which the effects are: the values of all variables, and which behaviors are "
           "available, as far as that is given.",
           [](const ReportedEffects& of, const CompiledCatalog& catalog) {
             return entries_of_part(of.situation, catalog);
           }),
    member("tasks", list(task_effects).on_lines(),
           "The tasks that can be requested, in catalog order.", [](const ReportedEffects& of) {
             return [&](const auto& put) {
               for (const TaskEffects& one : of.tasks) put(EffectsOfTask{of, one});
             };
           }));

}  // namespace cbc::json::verify
