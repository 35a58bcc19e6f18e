#include <array>
#include <string>

#include "core/report/explanation_json.h"
#include "core/support/json_description.h"
#include "graph/report/tables.h"

namespace cbc {
namespace json::together {

/// A member for each answer: how many pairs have it.
struct Numbers {
  template <typename Take>
  static void for_each_answer(const Take& take) {
    for (int answer = 0; answer <= static_cast<int>(Together::undecided); ++answer) {
      take(static_cast<Together>(answer));
    }
  }

  template <typename Context>
  void write(JsonWriter& json, const TogetherTable& table, const Context& /*context*/) const {
    for_each_answer([&](Together answer) { json.write(name_of(answer), table.count(answer)); });
  }
  void put_property(JsonWriter& json, Definitions& definitions) const {
    for_each_answer([&](Together answer) {
      member(name_of(answer), count, "Number of such pairs.", &TogetherTable::count)
          .put_property(json, definitions);
    });
  }
  void put_required(JsonWriter& json) const {
    for_each_answer([&](Together answer) { json.write(name_of(answer)); });
  }
};

constexpr auto pair = object(
    "pair", "",
    member("tasks", list(task).exactly(2).unique(), "",
           [](const TaskPair& of) {
             return std::array{of.first, of.second};
           }),
    member(
        "together", words(Together::undecided),
        "possible: some assignment that satisfies all constraints runs both. excluded: an "
        "exclusivity list has both. excluded_indirectly: no assignment runs both, though no list "
        "has both. excluded_in_each_situation: the constraints allow both, but not with "
        "behaviors that fit in one situation, though there are situations in which either task "
        "can run. excluded_by_situation: the same, and there is no situation in which either can "
        "run. undecided: there is too much to search.",
        &TaskPair::together),
    member("forbidden", boolean,
           "Whether they can run together, though `never_together` in the settings forbids it.",
           &TaskPair::is_forbidden),
    member("reasons", list(reason),
           "Why they never run together: a minimal set of constraints, from what the first task "
           "requires to what the second one requires; if the situation is part of it, with the "
           "conditions of behaviors, which are of the kind `situation`. Empty if they can run "
           "together, or if it takes too long to find.",
           &TaskPair::reasons));

constexpr auto report = object(
    "",
    "The output of `cbc graph --view together --format json` (schema cbc.together/1): for each two "
    "tasks that start on request (of all tasks if none does), whether they can run at the same "
    "time. A search decides this, with every behavior available that fits in the situation, which "
    "may be any.",
    schema_member("cbc.together/1"),
    member("catalog", any_text, "The catalog, as given.",
           [](const auto&, const ReasonContext& context) { return context.catalog.file; }),
    member("all_tasks", boolean,
           "Whether no task starts on request, so that all tasks are taken in place of those that "
           "do.",
           &TogetherTable::is_of_all_tasks),
    member("tasks", tasks, "The tasks that start on request and can run, in catalog order.",
           &TogetherTable::tasks),
    member("never_run", tasks,
           "The tasks that start on request but can never run, in catalog order. They are in no "
           "pair.",
           &TogetherTable::never_run),
    Numbers(),
    member("forbidden", count,
           "Number of the possible pairs that `never_together` in the settings forbids.",
           &TogetherTable::count_forbidden),
    member("pairs", list(pair).on_lines(),
           "All pairs of `tasks`, ordered by the first task and then by the second one.",
           &TogetherTable::pairs));

}  // namespace json::together

std::string together_json(const CompiledCatalog& catalog, const TogetherTable& table) {
  const EventRecord nothing{};
  return json::document(json::together::report, table, json::ReasonContext{catalog, nothing});
}

std::string together_schema() {
  return json::schema("together", "Tasks that can run together", json::together::report);
}

}  // namespace cbc
