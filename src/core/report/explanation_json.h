#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ask/conflict/reasons.h"
#include "core/compile/catalog_json.h"
#include "core/support/json_description.h"
#include "core/words/explanation_words.h"
#include "core/words/failure_explanation.h"
#include "core/words/layout.h"
#include "core/words/reason_words.h"
#include "core/words/suitability.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "why/alternatives.h"

// Why an event was decided as it was, as JSON. The context is that of a Decision.

namespace cbc::json {

/// An event, and the state after it.
struct Decision {
  const CompiledCatalog& catalog;
  const ExplainedRecord& record;
  const State& state;

  [[nodiscard]] TaskId first_task() const { return catalog.group_tasks[record.search->group]; }
};

/// A set of reasons, for a List; `questioned`: the tasks in question.
[[nodiscard]] inline auto in_order(std::span<const Reason> conflict,
                                   std::span<const TaskId> questioned, const Decision& of) {
  std::vector<TaskId> roots(questioned.begin(), questioned.end());
  if (of.record.task != none) roots.push_back(of.record.task);
  return order_reasons(of.catalog, conflict, roots);
}

/// Objectives with the suitability, which they do not have.
struct Objective {
  const ObjectiveValues& values;
  double suitability = 0;
};

inline constexpr auto objective = object(
    "objective",
    "The objective values of the configuration, over the whole catalog. The best configuration has "
    "the most satisfied requests; among equal ones the highest suitability, then the highest idle, "
    "then the fewest changes.",
    member("satisfied", count, "Number of active requests whose task runs.",
           [](const Objective& of) { return of.values.satisfied; }),
    member("requests", count,
           "Number of active requests: those of the tasks that ran and of the task to start, "
           "without that of the task to stop or of a task that is done.",
           [](const Objective& of) { return of.values.requests; }),
    member("suitability", share,
           "The product of the suitabilities of all running tasks, from 0 to 1, as the nearest "
           "double (the search compares exactly).",
           &Objective::suitability),
    member(
        "idle", share,
        "The share of the tasks without start_on_request that do not run; 1 if there are no such "
        "tasks.",
        [](const Objective& of) { return idle_share(of.values); }),
    member("changes", count, "Number of behaviors to activate and to deactivate.",
           [](const Objective& of) { return of.values.changes; }));

inline constexpr auto configuration = object(
    "configuration", "",
    member("running", map(task, behavior),
           "The running tasks of the group, in catalog order, each with its behavior.",
           [](const Configuration& of, const Decision& in) {
             return [&](const auto& put) {
               TaskId id = in.first_task();
               for (const std::uint32_t index : of.assignment) {
                 if (index != none) put(id, in.catalog.values[id][index].behavior);
                 ++id;
               }
             };
           }),
    member("objective", objective, "", [](const Configuration& of, const Decision& in) {
      return Objective{of.objective, total_suitability(in.catalog, in.state,
                                                       in.record.search->group, of.assignment)};
    }));

/// Two assignments of the group, and a task that they give different values.
struct DifferentTask {
  TaskId task;
  const WhyNot& why_not;

  [[nodiscard]] const Value* chosen(const Decision& in) const {
    return value(in, in.record.explanation.chosen.assignment);
  }
  [[nodiscard]] const Value* alternative(const Decision& in) const {
    return value(in, why_not.alternative->assignment);
  }

 private:
  [[nodiscard]] const Value* value(const Decision& in, const Assignment& assignment) const {
    const std::uint32_t index = assignment[task - in.first_task()];
    return index == none ? nullptr : &in.catalog.values[task][index];
  }
};

inline constexpr auto value_of_task =
    named("value",
          "The behavior of a task, with its suitability in percent; null if the task does not run.",
          nullable(object("", "", member("behavior", behavior, "", &Value::behavior),
                          member("suitability", percentage, "",
                                 [](const Value& of) { return in_percent(of.suitability); }))));

inline constexpr auto differences = named(
    "differences",
    "The tasks of the group with another value in the alternative, in catalog order. Where "
    "suitability decides, these are the factors that differ; a task that does not run has none. "
    "Empty without an alternative.",
    list(object("", "", member("task", task, "", &DifferentTask::task),
                member("chosen", value_of_task, "", &DifferentTask::chosen),
                member("alternative", value_of_task, "", &DifferentTask::alternative))));

namespace losses {

/// The members "chosen" and "alternative", which say the same of both configurations.
inline constexpr auto both = [](auto type, auto of_configuration) {
  return group(
      member("chosen", type, "",
             [of_configuration](const WhyNot&, const Decision& in) {
               return of_configuration(in.record.explanation.chosen, in);
             }),
      member("alternative", type, "", [of_configuration](const WhyNot& of, const Decision& in) {
        return of_configuration(*of.alternative, in);
      }));
};

inline constexpr auto performer = [](const WhyNot& of, const Decision& in,
                                     const Configuration& configuration) {
  const TaskId id = of.difference.task;
  const std::uint32_t index = configuration.assignment[id - in.first_task()];
  return index == none ? none : in.catalog.values[id][index].behavior;
};

}  // namespace losses

/// Where the alternative is worse, if there is one.
inline constexpr auto loss = variants(
    "loss",
    "The first objective in which the chosen configuration and the alternative differ, with both "
    "exact values.",
    group(), "objective", [](const WhyNot& of) { return of.difference.criterion; }, group(),
    variant({Criterion::requests}, "Satisfied requests, more are better.",
            losses::both(count, [](const Configuration& of,
                                   const Decision&) { return of.objective.satisfied; })),
    variant({Criterion::changes}, "Fewer are better.",
            losses::both(count, [](const Configuration& of,
                                   const Decision&) { return of.objective.changes; })),
    variant({Criterion::request_order},
            "Equally many but different requests: for each side, the strongest request that only "
            "this side satisfies; null where that is one that waits, or of a task that started by "
            "itself, and the other side has none.",
            member("chosen", task, "", [](const WhyNot& of) { return of.difference.task; }),
            member("alternative", nullable(task), "",
                   [](const WhyNot& of) { return of.difference.other_task; })),
    variant({Criterion::asked},
            "Where a task runs that started by itself with priority 0: the product of the "
            "suitabilities of what was asked for, and of what that requires. Higher is better.",
            losses::both(matching("^(0|1|0\\.[0-9]*[1-9])$"),
                         [](const Configuration& of, const Decision& /*in*/) {
                           return exact_product(of.asked.degrees);
                         })),
    variant({Criterion::suitability},
            "Higher is better. A suitability of 0 outside the group is left out. Decimal numbers "
            "from 0 to 1.",
            losses::both(matching("^(0|1|0\\.[0-9]*[1-9])$"),
                         [](const Configuration& of, const Decision& in) {
                           return exact_suitability(in.catalog, in.state, in.record.search->group,
                                                    of.assignment);
                         })),
    variant({Criterion::idle},
            "Higher is better: the tasks that do not run, out of all tasks without "
            "start_on_request.",
            losses::both(matching("^(0|[1-9][0-9]*)/[1-9][0-9]*$"),
                         [](const Configuration& of, const Decision&) {
                           const ObjectiveValues& values = of.objective;
                           return std::to_string(values.idle_total - values.idle_running) + "/" +
                                  std::to_string(values.idle_total);
                         })),
    variant({Criterion::canonical},
            "All objectives are equal; a fixed order of the behaviors of a task decides. `task` is "
            "the first one that differs.",
            member("task", task, "", [](const WhyNot& of) { return of.difference.task; }),
            member("chosen", nullable(behavior), "The behavior of the task.",
                   [](const WhyNot& of, const Decision& in) {
                     return losses::performer(of, in, in.record.explanation.chosen);
                   }),
            member("alternative", nullable(behavior), "", [](const WhyNot& of, const Decision& in) {
              return losses::performer(of, in, *of.alternative);
            })));

/// What was not chosen, and where it is worse.
inline constexpr auto why_not = [](std::string_view alternative) {
  return group(
      member("limit_reached", boolean,
             "There is no answer, since the proof would have taken too long.", &WhyNot::is_cut),
      member("alternative", nullable(configuration), alternative, &WhyNot::alternative),
      member("loses", nullable(loss),
             "Where the alternative is worse; null without an alternative.",
             [](const WhyNot& of) { return of.alternative ? &of : nullptr; }),
      member("differences", differences, "", [](const WhyNot& of, const Decision& in) {
        return [&](const auto& put) {
          if (!of.alternative) return;
          for (const TaskId id : differing_tasks(in.catalog, in.record.search->group,
                                                 in.record.explanation.chosen.assignment,
                                                 of.alternative->assignment)) {
            put(DifferentTask{id, of});
          }
        };
      }));
};

/// Sentences as one text.
[[nodiscard]] inline std::string message_of(const Sentences& sentences) {
  std::string message = sentences.first;
  for (std::size_t place = 0; place < sentences.more.size(); ++place) {
    message += place == 0 || message.ends_with(':') ? " " : "; ";
    message += without_indentation(sentences.more[place]);
  }
  return message;
}

inline constexpr std::string_view sentence = "The same as a sentence for people.";

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
    variant(
        {Reason::Kind::no_behavior, Reason::Kind::on_request, Reason::Kind::stopped,
         Reason::Kind::makes_worse},
        "no_behavior: no behavior performs the task; this is the only reason. on_request: the "
        "task starts only on request, and has none. stopped: the event stops the task; only in "
        "`why`. makes_worse: nobody asked for the task, and for it what was asked for would run "
        "worse; this is the only reason.",
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
    variant({Reason::Kind::limited}, "At most so many of the tasks may run.",
            member("tasks", list(json::task).at_least(2).unique(), "",
                   [](const Reason& of, const auto& context) {
                     return context.catalog.limited[of.limit];
                   }),
            member("at_most", integer(2), "",
                   [](const Reason& of, const auto& context) {
                     return context.catalog.limits[of.limit].most;
                   }),
            reasons::catalog_line),
    variant({Reason::Kind::not_retried},
            "The behavior failed before, and is not tried again yet; see `retry` in a catalog.",
            reasons::behavior,
            member("failed_at", seconds, "When it failed, in seconds on the clock.", &Reason::time),
            reasons::catalog_line),
    variant({Reason::Kind::not_improved},
            "The task gets a more suitable behavior than this one only when it is started.",
            reasons::task, reasons::behavior, reasons::catalog_line),
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
