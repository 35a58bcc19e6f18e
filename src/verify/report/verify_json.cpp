#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/report/explanation_json.h"
#include "core/support/json_description.h"
#include "verify/report/effects_json.h"
#include "verify/report/outcomes_json.h"
#include "verify/report/overrides_json.h"
#include "verify/report/verify_report.h"

namespace cbc {
namespace json::verify {

// The context is the catalog.

constexpr auto result_word = named(
    "result",
    "proved; violated: `script` shows how, or no state is such a one; undecided: a limit ended "
    "the exploration before.",
    words(Verdict::Result::undecided));

/// A task or a behavior, by its place in the catalog.
struct TaskPlaces : TaskNames {
  using Number = std::uint32_t;
  static std::string_view name(const CompiledCatalog& catalog, std::uint32_t place) {
    return catalog.task_names[place];
  }
};
struct BehaviorPlaces : BehaviorNames {
  using Number = std::uint32_t;
  static std::string_view name(const CompiledCatalog& catalog, std::uint32_t place) {
    return catalog.behavior_names[place];
  }
};
constexpr Name<TaskPlaces> task_at;
constexpr Name<BehaviorPlaces> behavior_at;

/// An exploration with the part that it belongs to.
struct Explored {
  const VerifyResult& result;
  const VerifyPart& part;
  std::size_t place = 0;  ///< in Verification::explorations
  const Exploration& exploration = part.verification.explorations[place];
};

constexpr auto exploration_of = [](const Explored& of) -> const auto& { return of.exploration; };

constexpr auto tasks_of = [](const Exploration& of, const CompiledCatalog& catalog) {
  return [&](const auto& put) {
    for (const TaskId id : catalog.task_ids) {
      const auto group = std::find(of.groups.begin(), of.groups.end(), catalog.tasks[id].group);
      if (group != of.groups.end()) put(id);
    }
  };
};

constexpr auto exploration = object(
    "exploration", "",
    optional("file", any_text,
             "The property file that the exploration is for; only if there are several.",
             [](const Explored& of) {
               return of.result.parts.size() > 1 ? &of.part.file->path : nullptr;
             }),
    part(
        exploration_of,
        group(
            member("group", count,
                   "The group, or the first one of several that are explored together.",
                   [](const Exploration& of) { return of.groups.front(); }),
            optional(
                "groups", list(count).at_least(2).unique(),
                "All groups that are explored together; only if there are several.",
                [](const Exploration& of) { return of.groups.size() > 1 ? &of.groups : nullptr; }),
            member("tasks", tasks, "All tasks, in catalog order.", tasks_of),
            member("complete", boolean,
                   "Whether every reachable state was visited; false: a limit ended the "
                   "exploration, or all properties were decided before.",
                   &Exploration::complete),
            optional(
                "decided", always_true,
                "The exploration ended as soon as all its properties were decided; what is said "
                "of it is what it had visited.",
                &Exploration::decided),
            optional("left_out", always_true,
                     "There were moves after which more requests would be suspended than 'assume' "
                     "lets; they were left out.",
                     &Exploration::has_left_out),
            member("states", integer(1), "Number of states that were found.", &Exploration::states),
            member("transitions", count, "Number of pairs of a visited state and a move in it.",
                   &Exploration::transitions),
            member("depth", count,
                   "The length of the longest shortest path to a state; of an incomplete "
                   "exploration, the depth up to which every state was visited.",
                   &Exploration::depth),
            optional(
                "states_at_depth", list(count),
                "Only if it is not complete: the number of states at depth 0, 1 "
                "and so on, as far as it is known.",
                [](const Exploration& of) { return of.complete ? nullptr : &of.states_at_depth; }),
            member("runs", map(task_at, count),
                   "The tasks that run in some state, with the least number of moves to one, in "
                   "catalog order.",
                   &Exploration::runs),
            member("active", map(behavior_at, count),
                   "The behaviors that are active in some state, likewise.", &Exploration::active),
            member("start_refused", map(task_at, count),
                   "The tasks with start_on_request that do not run in some state in which a start "
                   "with priority 1 would be rejected, likewise.",
                   &Exploration::start_refused),
            member("together",
                   list(row(item(task_at, &Exploration::Together::a),
                            item(task_at, &Exploration::Together::b),
                            item(count, &Exploration::Together::depth))),
                   "The pairs of tasks that run in one state, with the least number of moves to "
                   "one, in catalog order.",
                   &Exploration::together))),
    optional("outcomes", list(reachable_outcome).on_lines(),
             "Only with --outcomes: the distinct sets of running tasks and their behaviors in "
             "states with nothing in the queue, those with shorter scripts first, then in catalog "
             "order; of an incomplete exploration, up to `depth`.",
             [](const Explored& of) {
               return of.part.outcomes.empty() ? nullptr : &of.part.outcomes[of.place];
             }));

/// The script that shows an answer: `length_of` and `text_of` have a pointer to a value, or null.
constexpr auto script = [](std::string_view meaning, auto length_of, auto text_of) {
  return group(member("length", nullable(count),
                      "The number of moves of `script`; null if there is none.", length_of),
               member("script", nullable(any_text), meaning, text_of));
};

/// A property with the part that it belongs to.
struct Answered {
  const VerifyPart& part;
  const ReportedAnswer& reported;
  const PropertyAnswer& answer = *reported.answer;
  const Property& property = *answer.property;
};

/// JSON already.
struct Conflict {
  void write(JsonWriter& json, std::string_view value, const auto& /*context*/) const {
    json.put_json(value);
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    list(reason).put_schema(json, definitions);
  }
};

constexpr auto property =
    object(
        "property", "",
        member(
            "file", any_text, "The property file.",
            [](const Answered& of) -> const auto& { return of.part.file->path; }),
        member("line", line_number, "The line of the property in the file.",
               [](const Answered& of) { return of.property.line; }),
        member(
            "kind", words(Property::Kind::always_possible),
            "can_start: wherever the task does not run, its start is accepted. always: the "
            "condition holds in every state. never: it holds in none. reachable: it holds in some "
            "state. keeps_running: no move ends the task while it is requested. always_possible: "
            "from every state one can be reached in which the condition holds. Where there is "
            "`when`, only states count in which that holds.",
            [](const Answered& of) { return of.property.kind; }),
        member("name", nullable(text), "The name; null if it has none.",
               [](const Answered& of) {
                 return of.property.name.empty() ? nullptr : &of.property.name;
               }),
        member("result", result_word, "",
               [](const Answered& of) { return of.answer.verdict.result; }),
        optional("vacuous", always_true,
                 "Proved only since `when` or `after` holds in no reachable state.",
                 [](const Answered& of) { return of.answer.verdict.is_vacuous; }),
        optional("by_constraints", always_true,
                 "Proved by the constraints alone: no state was visited for it, unless to find out "
                 "whether it is vacuous.",
                 [](const Answered& of) { return of.answer.verdict.by_constraints; }),
        script(
            "A shortest event script that breaks the property, or, for reachable, leads to such a "
            "state: its text, or with --scripts its path.",
            [](const Answered& of) {
              return of.answer.witness ? std::optional(of.answer.verdict.script.size())
                                       : std::nullopt;
            },
            [](const Answered& of) {
              if (!of.answer.witness) return static_cast<const std::string*>(nullptr);
              return of.reported.script_path ? &*of.reported.script_path : &of.answer.witness->text;
            }),
        member("conflict", Conflict(), "Of a violated can_start: why the start is rejected.",
               [](const Answered& of) -> std::string_view {
                 const bool is_refused =
                     of.property.kind == Property::Kind::can_start && of.reported.replay;
                 return is_refused ? std::string_view(of.reported.replay->conflict) : "[]";
               }))
        .related(R"([
      {"$comment": "A counterexample, or of reachable a witness.",
       "if": {"anyOf": [
         {"properties": {"kind": {"enum": ["can_start", "always", "never", "keeps_running",
                                           "always_possible"]},
                         "result": {"const": "violated"}}},
         {"properties": {"kind": {"const": "reachable"}, "result": {"const": "proved"}}}]},
       "then": {"properties": {"length": {"type": "integer"}, "script": {"type": "string"}}},
       "else": {"properties": {"length": {"type": "null"}, "script": {"type": "null"}}}},
      {"if": {"properties": {"kind": {"const": "can_start"}, "result": {"const": "violated"}}},
       "then": {"properties": {"conflict": {"type": "array", "minItems": 1}}},
       "else": {"properties": {"conflict": {"type": "array", "maxItems": 0}}}}])");

/// Of a reported difference: the text of its script, or its path; in the names of the old catalog
/// null if they are the same.
constexpr auto script_of = [](const ReportedDifference& of) {
  return of.script_path ? &*of.script_path : &of.difference->witness.text;
};
constexpr auto old_script_of = [](const ReportedDifference& of) -> const std::string* {
  if (of.old_script_path) return &*of.old_script_path;
  return of.difference->old_text ? &*of.difference->old_text : nullptr;
};

constexpr auto task_difference = object(
    "task_difference", "",
    member("task", text, "Its name, in this catalog if it has the task.", &TaskDifference::task),
    member("aspect", words(TaskDifference::Aspect::queue),
           "outcome: of the event. running: the task runs in one of them only, or with another "
           "behavior. event, change, stop: something happens on the way in one of them only, or in "
           "another order. queue: it is about to start, or waits, in one of them only.",
           &TaskDifference::aspect),
    member("message", text, "What differs, on one line.", &TaskDifference::line));

constexpr auto event_difference =
    object("event_difference", "",
           member("length", integer(1), "The number of moves of `script`.",
                  [](const ReportedDifference& of) { return of.difference->moves.size(); }),
           member(
               "script", any_text,
               "A shortest event script whose last event is decided differently: its text, or with "
               "--scripts its path.",
               [](const ReportedDifference& of) -> const auto& { return *script_of(of); }),
           member("old_script", nullable(text),
                  "The same events in the names of the other catalog; null if these are the same.",
                  old_script_of),
           member(
               "tasks", list(task_difference).at_least(1),
               "The tasks about which this is the first difference, in catalog order.",
               [](const ReportedDifference& of) -> const auto& { return of.difference->tasks; }));

/// Groups that were compared, and where their differences are.
struct Compared {
  const ReportedComparison& of;
  const GroupComparison& groups;
  std::size_t first_difference = 0;  ///< in ReportedComparison::differences
};

constexpr auto compared_groups = object(
    "compared_groups", "",
    member(
        "groups", list(count).unique(), "Of this catalog.",
        [](const Compared& of) -> const auto& { return of.groups.new_groups; }),
    member(
        "old_groups", list(count).unique(), "Of the other catalog.",
        [](const Compared& of) -> const auto& { return of.groups.old_groups; }),
    member(
        "tasks", texts, "Their tasks.",
        [](const Compared& of) -> const auto& { return of.groups.tasks; }),
    member("result", result_word, "proved: every reachable event is decided alike.",
           [](const Compared& of) { return of.groups.result; }),
    member("compared", boolean, "Whether a start, stop or finish was made in both catalogs.",
           [](const Compared& of) { return of.groups.is_compared; }),
    member("complete", boolean, "false: a limit ended the exploration.",
           [](const Compared& of) { return !of.groups.end; }),
    member("states", count, "Number of pairs of states that were found.",
           [](const Compared& of) { return of.groups.states; }),
    member("transitions", count, "Number of moves that were made in them.",
           [](const Compared& of) { return of.groups.transitions; }),
    member("depth", count, "As in `groups`.", [](const Compared& of) { return of.groups.depth; }),
    member("differences", list(event_difference).on_lines(),
           "Shortest ones, for each task that is decided differently.", [](const Compared& of) {
             return [of](const auto& put) {
               for (std::size_t place = 0; place < of.groups.differences.size(); ++place) {
                 put(of.of.differences[of.first_difference + place]);
               }
             };
           }));

constexpr auto direct_difference = object(
    "direct_difference", "",
    member("kind", words(DirectDifference::Kind::parameter),
           "task: it can be requested in one of them only. behavior: it can be active in one of "
           "them only. variable, value: a behavior depends on it in one of them only. Otherwise "
           "what of a task or behavior differs.",
           &DirectDifference::kind),
    member("message", text, "What differs, on one line.", &DirectDifference::line));

constexpr auto compared = [](const ReportedComparison& of) -> const auto& { return of.comparison; };

/// The first of all differences; null: none.
constexpr auto first_of = [](const ReportedComparison& of) -> const ReportedDifference* {
  const EventDifference* const first = of.comparison.first_difference();
  const auto found =
      std::find_if(of.differences.begin(), of.differences.end(),
                   [&](const ReportedDifference& one) { return one.difference == first; });
  return found == of.differences.end() ? nullptr : &*found;
};

constexpr auto comparison =
    object(
        "comparison", "",
        member("old", text, "The other catalog, as given.",
               [](const ReportedComparison& of) { return of.old_catalog->file; }),
        member("result", result_word,
               "proved: every reachable event is decided alike, and nothing else differs. "
               "undecided also if nothing was compared.",
               [](const ReportedComparison& of) { return compared(of).result; }),
        member("states", count, "Number of pairs of states that were found.",
               [](const ReportedComparison& of) { return compared(of).states; }),
        script(
            "A shortest event script whose last event is decided differently: its text, or with "
            "--scripts its path.",
            [](const ReportedComparison& of) {
              const ReportedDifference* const first = first_of(of);
              return first != nullptr ? std::optional(first->difference->moves.size())
                                      : std::nullopt;
            },
            [](const ReportedComparison& of) {
              const ReportedDifference* const first = first_of(of);
              return first != nullptr ? script_of(*first) : nullptr;
            }),
        member(
            "only_old", names, "What only the other catalog has, in words.",
            [](const ReportedComparison& of) -> const auto& {
              return compared(of).names.only_old;
            }),
        member(
            "only_new", names, "What only this catalog has, in words.",
            [](const ReportedComparison& of) -> const auto& {
              return compared(of).names.only_new;
            }),
        member(
            "renamed", names, "What is the same by --renamed, in words.",
            [](const ReportedComparison& of) -> const auto& { return compared(of).names.renamed; }),
        member("compared", boolean, "Whether a start, stop or finish was made in both catalogs.",
               [](const ReportedComparison& of) { return compared(of).is_compared; }),
        member(
            "direct", list(direct_difference).on_lines(), "What differs whatever happens.",
            [](const ReportedComparison& of) -> const auto& { return compared(of).direct; }),
        member("groups", list(compared_groups).on_lines(),
               "The explorations: groups of both catalogs that have names in common.",
               [](const ReportedComparison& of) {
                 return [&of](const auto& put) {
                   std::size_t first = 0;
                   for (const GroupComparison& groups : compared(of).groups) {
                     put(Compared{of, groups, first});
                     first += groups.differences.size();
                   }
                 };
               }))
        .related(R"([
      {"$comment": "A script, or a difference that no script shows.",
       "if": {"properties": {"result": {"const": "violated"}}},
       "then": {"anyOf": [
         {"properties": {"length": {"type": "integer"}, "script": {"type": "string"}}},
         {"properties": {"length": {"type": "null"}, "script": {"type": "null"},
                         "direct": {"type": "array", "minItems": 1}}}]},
       "else": {"properties": {"length": {"type": "null"}, "script": {"type": "null"},
                               "direct": {"type": "array", "maxItems": 0}}}}])");

constexpr auto report = object(
    "",
    "The output of `cbc verify --format json` (schema cbc.verify/1): what can happen on a catalog "
    "under the assumptions of its property files, and whether the properties in them hold.",
    schema_member("cbc.verify/1"),
    member("catalog", any_text,
           "The catalog, as given; for a compiled catalog, the name of its source.",
           [](const VerifyResult& of) { return of.catalog->file; }),
    member("groups", list(exploration).on_lines(),
           "The explorations, in their order. Without properties each group is explored by itself; "
           "groups that one property is about are explored together.",
           [](const VerifyResult& of) {
             return [&of](const auto& put) {
               for (const VerifyPart& in_part : of.parts) {
                 const auto& explorations = in_part.verification.explorations;
                 for (std::size_t place = 0; place < explorations.size(); ++place) {
                   // A property may be about variables alone that no behavior names.
                   if (!explorations[place].groups.empty()) put(Explored{of, in_part, place});
                 }
               }
             };
           }),
    member("properties", list(property).on_lines(), "The properties, in the order of the files.",
           [](const VerifyResult& of) {
             return [&of](const auto& put) {
               for (const VerifyPart& in_part : of.parts) {
                 for (const ReportedAnswer& reported : in_part.answers) {
                   put(Answered{in_part, reported});
                 }
               }
             };
           }),
    member("same_as", nullable(comparison),
           "The comparison with another catalog; null if none was asked for.",
           &VerifyResult::same_as),
    optional("effects", effects, "With --effects or --cut-sets: what faults do to each task.",
             &VerifyResult::effects),
    optional("overrides", overrides,
             "With --overrides: what becomes of two tasks that are requested one after the other.",
             &VerifyResult::overrides));

}  // namespace json::verify

std::string verify_to_json(const VerifyResult& result) {
  return json::document(json::verify::report, result, *result.catalog);
}

std::string verify_schema() {
  return json::schema("verify", "Result of a verification", json::verify::report);
}

}  // namespace cbc
