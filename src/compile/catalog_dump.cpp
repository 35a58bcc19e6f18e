#include "compile/catalog_dump.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "core/catalog/allowed_values.h"
#include "core/catalog/situation.h"
#include "core/compile/catalog_json.h"
#include "core/compile/compile.h"
#include "core/support/json_description.h"
#include "core/words/words.h"

namespace cbc {
namespace json::dump {

/// A time in seconds: as a whole number where it is one.
struct PutTime {
  void operator()(JsonWriter& json, Microseconds time) const {
    if (time % second == 0) {
      json.put(time / second);
    } else {
      json.put(to_seconds(time));
    }
  }
};

constexpr auto timeout_of = [](std::string_view meaning) {
  return [meaning](auto projection) {
    return member("timeout", nullable(Number<PutTime>{std::nullopt, true, {}}), meaning,
                  [projection](auto of, const CompiledCatalog& catalog) {
                    const Microseconds& timeout = projection(of, catalog).timeout;
                    return timeout > 0 ? &timeout : nullptr;
                  });
  };
};

constexpr auto minimum = [](auto projection) {
  return member("minimum_performance", nullable(positive_percent),
                "Minimum performance in percent; null: none.",
                [projection](const auto& of, const CompiledCatalog& catalog) {
                  const Millionths& least = project(projection, of, catalog).minimum_performance;
                  return least > 0 ? &least : nullptr;
                });
};

/// A list of texts, or one text, or nothing.
struct AllowedValues {
  template <typename Context>
  void write(JsonWriter& json, const Parameter& parameter, const Context& context) const {
    if (parameter.allowed_is_list) {
      values.write(json, parameter.allowed_values, context);
    } else if (parameter.allowed_values.empty()) {
      json.put(nullptr);
    } else {
      json.put(parameter.allowed_values.front());
    }
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    choice("", values, any_text, null).put_schema(json, definitions);
  }

  static constexpr auto values = list(any_text);
};

constexpr auto parameter =
    object("parameter", "", member("parameter", text, "", &Parameter::name),
           member("allowed_values", AllowedValues(),
                  "A list of texts, the name of a type, or null if any value is allowed.",
                  std::identity()));

constexpr auto task_at = [](TaskId id, const CompiledCatalog& catalog) -> const CompiledTask& {
  return catalog.tasks[id];
};

constexpr auto task =
    object(
        "task", "", member("task", json::task, "", std::identity()),
        member("level", count, "The highest level of its behaviors.",
               [](TaskId of, const CompiledCatalog& in) { return task_at(of, in).level; }),
        member(
            "execution_goal", WordList<2>{{"achieve_goal", "keep_running"}},
            "Whether it ends by itself (achieve_goal) or runs until it is stopped (keep_running).",
            [](TaskId of, const CompiledCatalog& in) { return task_at(of, in).keep_running != 0; }),
        member("start_on_request", boolean,
               "Whether it starts only when it is requested, not because something requires it.",
               [](TaskId of, const CompiledCatalog& in) {
                 return task_at(of, in).start_on_request != 0;
               }),
        member("reactive_start", boolean, "Whether it starts by itself as soon as it can.",
               [](TaskId of, const CompiledCatalog& in) {
                 return task_at(of, in).reactive_start != 0;
               }),
        optional("requestable", boolean, "Only where false: nobody may request it.",
                 [](TaskId of, const CompiledCatalog& in) {
                   return in.rules_of(of).requestable != 0 ? std::nullopt : std::optional(false);
                 }),
        optional("reactive_priority", integer(1), "Where it is not 0.",
                 [](TaskId of, const CompiledCatalog& in) {
                   const std::int32_t priority = in.rules_of(of).reactive_priority;
                   return priority == 0 ? std::nullopt : std::optional(priority);
                 }),
        optional("improve", WordList<3>{{"at_events", "at_once", "when_started"}},
                 "When it gets a more suitable behavior, where that is not at_events.",
                 [](TaskId of, const CompiledCatalog& in) {
                   const Improve improve = in.rules_of(of).improve;
                   return improve == Improve::at_events
                              ? std::nullopt
                              : std::optional(static_cast<std::size_t>(improve));
                 }),
        optional("resume", boolean, "Only where true: its request is suspended if it is stopped.",
                 [](TaskId of, const CompiledCatalog& in) {
                   return in.rules_of(of).resume == 0 ? std::nullopt : std::optional(true);
                 }),
        timeout_of("Timeout in seconds; null: none.")(task_at), minimum(task_at),
        member("line", nullable(line_number),
               "The line of the minimum performance in the source; null without one.",
               [](TaskId of, const CompiledCatalog& in) {
                 const CompiledTask& compiled = task_at(of, in);
                 return compiled.minimum_performance > 0 ? &compiled.minimum_line : nullptr;
               }),
        member("parameters", list(parameter), "",
               [](TaskId of, const CompiledCatalog& in) {
                 return parameters_of(in, task_at(of, in).catalog_index);
               }),
        member(
            "behaviors",
            list(object(
                "", "", member("behavior", json::behavior, "", &Value::behavior),
                member("suitability", percent, "Suitability in percent.", &Value::suitability))),
            "The behaviors that perform it, in search order: best suitability first, equal ones in "
            "catalog order.",
            [](TaskId of, const CompiledCatalog& in) { return in.values[of]; }))
        .related(R"([{"if": {"properties": {"minimum_performance": {"type": "null"}}},
                  "then": {"properties": {"line": {"type": "null"}}},
                  "else": {"properties": {"line": {"type": "integer"}}}}])");

constexpr auto behavior_at = [](BehaviorId id, const CompiledCatalog& catalog) -> const auto& {
  return catalog.behaviors[id];
};

constexpr auto line = named("line", "Line in the source, from 1.", line_number);

constexpr auto behavior = object(
    "behavior", "", member("behavior", json::behavior, "", std::identity()),
    member("level", count,
           "0 if it requires nothing, otherwise one more than the highest level that it requires.",
           [](BehaviorId of, const CompiledCatalog& in) { return behavior_at(of, in).level; }),
    member("package", any_text, "The package; empty if none is given.",
           [](BehaviorId of, const CompiledCatalog& in) {
             return in.texts[in.behavior_packages[behavior_at(of, in).catalog_index]];
           }),
    timeout_of("Timeout in seconds; null: the timeout of the task.")(behavior_at),
    optional("retry", WordList<3>{{"at_events", "when_started", "after_repair"}},
             "When it is tried again after a failure, where that is not at_events.",
             [](BehaviorId of, const CompiledCatalog& in) {
               const Retry retry = in.retry_of(of);
               return retry == Retry::at_events ? std::nullopt
                                                : std::optional(static_cast<std::size_t>(retry));
             }),
    member("situation", conditions,
           "For each situation variable that it names, the values in which it fits.",
           [](BehaviorId of, const CompiledCatalog& in) {
             return by_variable(conditions_of(in, of));
           }),
    member("requires",
           list(object("", "", member("task", json::task, "", &CompiledRequirement::task),
                       minimum(std::identity()),
                       member("line", line, "",
                              [](const CompiledRequirement& of, const CompiledCatalog& in) {
                                return in.line_of(of);
                              }))),
           "", [](BehaviorId of, const CompiledCatalog& in) { return in.requirements[of]; }));

constexpr auto exclusion =
    object("exclusion", "At most one of the tasks may run.",
           member("tasks", tasks.at_least(2), "",
                  [](std::uint32_t of, const CompiledCatalog& in) { return in.cliques[of]; }),
           member("line", line, "",
                  [](std::uint32_t of, const CompiledCatalog& in) { return in.clique_lines[of]; }));

constexpr auto limit =
    object("limit", "At most so many of the tasks may run.",
           member("tasks", tasks.at_least(2), "",
                  [](std::uint32_t of, const CompiledCatalog& in) { return in.limited[of]; }),
           member("at_most", integer(2), "",
                  [](std::uint32_t of, const CompiledCatalog& in) { return in.limits[of].most; }),
           member("line", line, "",
                  [](std::uint32_t of, const CompiledCatalog& in) { return in.limits[of].line; }));

constexpr auto numbers =
    group(member("levels", count, "1 + the highest level of any task.", &CatalogNumbers::levels)
              .on_line(),
          member("constraints", constraints, "", &CatalogNumbers::constraints).on_line(),
          search_space.on_line());

/// Whole numbers from one of the numbers of a list to the one after it.
constexpr auto range_of = [](std::size_t place, const auto& begins) {
  return [first = begins[place], end = begins[place + 1]](const auto& put) {
    for (auto id = first; id < end; ++id) put(id);
  };
};

struct Group {
  std::size_t place;
  const CatalogNumbers& numbers;
};

constexpr auto group_of_tasks = object(
    "group", "",
    member("group", count, "The number of the group, from 0, as in `search` of cbc.solve/1.",
           &Group::place),
    part(
        [](const Group& of) -> const auto& { return of.numbers; }, numbers),
    member("tasks", list(task).at_least(1).on_lines(), "In catalog order.",
           [](const Group& of, const CompiledCatalog& in) {
             return range_of(of.place, in.group_tasks);
           })
        .on_line(),
    member("behaviors", list(behavior).on_lines(), "In catalog order.",
           [](const Group& of, const CompiledCatalog& in) {
             return range_of(of.place, in.group_behaviors);
           })
        .on_line(),
    member(
        "exclusivity", list(exclusion).on_lines(),
        "Lists of tasks that exclude one another, ordered by their first task.",
        [](const Group& of, const CompiledCatalog& in) { return cliques_of_group(in, of.place); })
        .on_line(),
    optional("limits", list(limit).on_lines(),
             "Lists of tasks of which several may run, if there are any.",
             [](const Group& of, const CompiledCatalog& in) {
               std::vector<std::uint32_t> limits;
               for (TaskId id = in.group_tasks[of.place]; id < in.group_tasks[of.place + 1]; ++id) {
                 const std::vector<std::uint32_t> from = limits_from(in, id);
                 limits.insert(limits.end(), from.begin(), from.end());
               }
               return limits.empty() ? std::nullopt : std::optional(limits);
             })
        .on_line());

struct Report {
  const CompiledFile& file;
  CatalogSummary summary;
};

constexpr auto report =
    object("", "The output of `cbc compile --dump` (schema cbc.catalog/1).",
           schema_member("cbc.catalog/1"),
           member("format", integer(1), "Format version of the compiled file.",
                  [](const Report& of) { return of.file.format; })
               .on_line(),
           member(
               "written_by", version_number, "Version of cbc that wrote it.",
               [](const Report& of) -> const auto& { return of.file.written_by; })
               .on_line(),
           member(
               "source",
               object("", "",
                      member("file", any_text, "The name, as given to `cbc compile`.",
                             [](const CompiledFile& of) { return of.catalog.file; }),
                      member("digest", digest, "XXH3-128 digest of its text.",
                             [](const CompiledFile& of) { return to_hex(of.source); })),
               "The YAML source.", [](const Report& of) -> const auto& { return of.file; })
               .on_line(),
           member("content_digest", digest, "XXH3-128 digest of the contents of the compiled file.",
                  [](const Report& of) { return to_hex(of.file.content); })
               .on_line(),
           member("size", integer(1), "Size of the compiled file in bytes.",
                  [](const Report& of) { return of.file.size; })
               .on_line(),
           member("tasks", count, "Number of tasks.",
                  [](const Report& of) { return of.summary.total.tasks; })
               .on_line(),
           member("behaviors", count, "Number of behaviors.",
                  [](const Report& of) { return of.summary.total.behaviors; })
               .on_line(),
           part(
               [](const Report& of) -> const auto& { return of.summary.total; }, numbers),
           member("variables", list(variable_with_values).on_lines(),
                  "The situation variables, in catalog order.",
                  [](const Report& of) {
                    return [&of](const auto& put) {
                      const std::size_t size = of.file.catalog.variables.size();
                      for (std::uint32_t place = 0; place < size; ++place) put(place);
                    };
                  })
               .on_line(),
           member("groups", list(group_of_tasks).on_lines(),
                  "Sets of tasks that constraints connect, ordered by their first task.",
                  [](const Report& of) {
                    return [&of](const auto& put) {
                      std::size_t place = 0;
                      for (const CatalogNumbers& in_group : of.summary.groups) {
                        put(Group{place++, in_group});
                      }
                    };
                  })
               .on_line());

}  // namespace json::dump

std::string catalog_json(const CompiledFile& file) {
  return json::document(json::dump::report, json::dump::Report{file, summarize(file.catalog)},
                        file.catalog);
}

std::string catalog_schema() {
  return json::schema("catalog-dump", "Contents of a compiled catalog", json::dump::report);
}

}  // namespace cbc
