#pragma once

#include <optional>

#include "core/report/assumptions_json.h"
#include "core/support/json_description.h"
#include "core/words/suitability.h"
#include "verify/report/verify_report.h"

// The effects of faults, and cut sets, as JSON. The context is the catalog.

namespace cbc::json::verify {

/// The effects on a task, with the report that they are part of.
struct EffectsOfTask {
  const ReportedEffects& report;
  const TaskEffects& of_task;
};

/// One of them.
struct EffectOnTask {
  const ReportedEffects& report;
  TaskId task;
  const Effect& effect;
};

/// The best assignment in which a task runs, of effects that are not only cut sets.
struct BestOfTask {
  bool is_known = true;
  TaskId task;
  const BestAssignment& best;
};

/// What it says: nothing where none was sought, null where the task cannot run.
template <typename Tell>
[[nodiscard]] auto told_of(const BestOfTask& of, const Tell& tell) {
  using Told = std::optional<decltype(tell(*of.best))>;
  std::optional<Told> told;
  if (of.is_known) told.emplace(of.best ? Told(tell(*of.best)) : Told());
  return told;
}

constexpr auto best_assignment = group(
    optional("behaviors", nullable(behaviors),
             "The active behaviors of the best assignment in which the task runs, in catalog "
             "order; null: it cannot run. Only with --effects.",
             [](const BestOfTask& of, const CompiledCatalog& catalog) {
               return told_of(of, [&](const Assignment& best) {
                 return behaviors_of(catalog, of.task, best);
               });
             }),
    optional("suitability", nullable(share),
             "The product of the suitabilities of all tasks that run then, from 0 to 1, as the "
             "nearest double; null: it cannot run. Only with --effects.",
             [](const BestOfTask& of, const CompiledCatalog& catalog) {
               return told_of(of, [&](const Assignment& best) {
                 return product_of(suitabilities_of(catalog, of.task, best));
               });
             }));

constexpr auto effect = object(
    "effect", "",
    member(
        "faults", behaviors, "The behaviors that are faulty, in catalog order.",
        [](const EffectOnTask& of) -> const auto& { return of.effect.faults; }),
    member("situation", situation,
           "Of a cut set the values of situation variables under which it suffices; none: in every "
           "situation. Otherwise what changes: at most one variable.",
           [](const EffectOnTask& of, const CompiledCatalog& catalog) {
             return [&](const auto& put) {
               for (const VariableValue& value : of.effect.situation) {
                 put(catalog.name_of_variable(value.variable), value);
               }
             };
           }),
    member("effect", words(Effect::Kind::unchanged),
           "lost: the task cannot run. degraded: other behaviors are active. none: the same ones.",
           [](const EffectOnTask& of) { return of.effect.kind; }),
    part(
        [](const EffectOnTask& of) {
          return BestOfTask{!of.report.are_cut_sets, of.task, of.effect.best};
        },
        best_assignment));

constexpr auto task_effects = object(
    "task_effects", "",
    member("task", task, "", [](const EffectsOfTask& of) { return of.of_task.task; }),
    part(
        [](const EffectsOfTask& of) {
          return BestOfTask{!of.report.are_cut_sets, of.of_task.task, of.of_task.best};
        },
        best_assignment),
    member("complete", boolean, "false: a limit ended the search, so effects are missing.",
           [](const EffectsOfTask& of) { return of.of_task.complete; }),
    optional(
        "complete_order", nullable(count),
        "All effects of sets up to this size are there, values counted; null if it is not even "
        "known whether the task can run without faults. Only if a limit ended the search.",
        [](const EffectsOfTask& of) {
          using Order = std::optional<std::uint32_t>;
          const std::uint32_t incomplete = of.of_task.incomplete_size;
          if (of.of_task.complete) return std::optional<Order>();
          return std::optional<Order>(std::in_place,
                                      incomplete > 0 ? Order(incomplete - 1) : Order());
        }),
    member("effects", list(effect).on_lines(),
           "Of each single fault; of several faults together, if no part of them has the same "
           "effect; with --situations of each single change. With --cut-sets only `lost`: the "
           "minimal sets in every situation, with --in-some-situation also those that suffice in "
           "some, by size, then in catalog order. Of a task that cannot run even without a fault "
           "one, without faults.",
           [](const EffectsOfTask& of, const CompiledCatalog& catalog) {
             return [&](const auto& put) {
               for (const Effect& one : of.report.all_of(catalog, of.of_task)) {
                 put(EffectOnTask{of.report, of.of_task.task, one});
               }
             };
           }));

constexpr auto effects = object(
    "effects", "",
    member("order", integer(1), "The most faults together (--order).", &ReportedEffects::order),
    member("situation", situation,
           "From which the effects are: the values of all variables, with --cut-sets those that "
           "are given; and which behaviors are available, as far as that is given.",
           [](const ReportedEffects& of, const CompiledCatalog& catalog) {
             return entries_of_part(of.situation, catalog);
           }),
    member("tasks", list(task_effects).on_lines(),
           "The tasks that can be requested, in catalog order; with --cut-sets those named.",
           [](const ReportedEffects& of) {
             return [&](const auto& put) {
               for (const TaskEffects& one : of.tasks) put(EffectsOfTask{of, one});
             };
           }));

}  // namespace cbc::json::verify
