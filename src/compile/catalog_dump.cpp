#include "compile/catalog_dump.h"

#include <cstddef>
#include <optional>

#include "cbc/units.h"
#include "core/catalog/allowed_values.h"
#include "core/catalog/situation.h"
#include "core/compile/compile.h"
#include "core/report/catalog_json.h"
#include "core/report/catalog_words.h"
#include "core/support/json.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

void write_minimum(JsonWriter& json, Millionths minimum) {
  json.write_percent("minimum_performance", minimum > 0 ? std::optional(minimum) : std::nullopt);
}

void write_timeout(JsonWriter& json, Microseconds time) {
  if (time == 0) {
    json.write("timeout", nullptr);
  } else if (time % second == 0) {
    json.write("timeout", time / second);
  } else {
    json.write("timeout", to_seconds(time));
  }
}

void write_parameter(JsonWriter& json, const Parameter& parameter) {
  const std::vector<std::string>& allowed = parameter.allowed_values;
  if (parameter.allowed_is_list) {
    json.open('{');
    json.write("parameter", parameter.name);
    json.write_list("allowed_values", allowed);
    json.close('}');
  } else {
    json.write_object({{"parameter", parameter.name},
                       {"allowed_values", allowed.empty() ? JsonPlain(nullptr) : allowed.front()}});
  }
}

void write_task(JsonWriter& json, const CompiledCatalog& catalog, TaskId id) {
  const CompiledTask& task = catalog.tasks[id];
  const bool has_minimum = task.minimum_performance > 0;
  json.on_new_line().open('{');
  json.write_members({{"task", catalog.name_of_task(id)},
                      {"level", task.level},
                      {"execution_goal", task.keep_running != 0 ? "keep_running" : "achieve_goal"},
                      {"start_on_request", task.start_on_request != 0},
                      {"reactive_start", task.reactive_start != 0}});
  write_timeout(json, task.timeout);
  write_minimum(json, task.minimum_performance);
  json.write("line", has_minimum ? std::optional(task.minimum_line) : std::nullopt);
  json.write_list("parameters", parameters_of(catalog, task.catalog_index),
                  [&](const Parameter& parameter) { write_parameter(json, parameter); });
  json.write_list("behaviors", catalog.values[id], [&](const Value& value) {
    json.open('{');
    json.write("behavior", catalog.name_of_behavior(value.behavior));
    json.write_percent("suitability", value.suitability);
    json.close('}');
  });
  json.close('}');
}

void write_behavior(JsonWriter& json, const CompiledCatalog& catalog, BehaviorId id) {
  const CompiledBehavior& behavior = catalog.behaviors[id];
  json.on_new_line().open('{');
  json.write_members(
      {{"behavior", catalog.name_of_behavior(id)},
       {"level", behavior.level},
       {"package", catalog.texts[catalog.behavior_packages[behavior.catalog_index]]}});
  write_timeout(json, behavior.timeout);
  write_conditions(json, conditions_of(catalog, id));
  json.write_list("requires", catalog.requirements[id], [&](const CompiledRequirement& required) {
    json.open('{');
    json.write("task", catalog.name_of_task(required.task));
    write_minimum(json, required.minimum_performance);
    json.write("line", catalog.line_of(required));
    json.close('}');
  });
  json.close('}');
}

void write_clique(JsonWriter& json, const CompiledCatalog& catalog, std::uint32_t clique) {
  json.on_new_line().open('{');
  json.write_list("tasks", catalog.cliques[clique],
                  [&](TaskId task) { json.write(catalog.name_of_task(task)); });
  json.write("line", catalog.clique_lines[clique]);
  json.close('}');
}

void write_numbers(JsonWriter& json, const CatalogNumbers& numbers) {
  json.on_new_line().write("levels", numbers.levels);
  json.on_new_line();
  write_constraints(json, numbers.constraints);
  json.on_new_line().write("search_space", numbers.search_space);
}

void write_group(JsonWriter& json, const CompiledCatalog& catalog, std::size_t group,
                 const CatalogNumbers& numbers) {
  json.on_new_line().open('{');
  json.write("group", group);
  write_numbers(json, numbers);
  json.on_new_line().open("tasks", '[');
  for (TaskId id = catalog.group_tasks[group]; id < catalog.group_tasks[group + 1]; ++id) {
    write_task(json, catalog, id);
  }
  json.close(']');
  json.on_new_line().open("behaviors", '[');
  for (BehaviorId id = catalog.group_behaviors[group]; id < catalog.group_behaviors[group + 1];
       ++id) {
    write_behavior(json, catalog, id);
  }
  json.close(']');
  json.on_new_line().write_list("exclusivity", cliques_of_group(catalog, group),
                                [&](std::uint32_t clique) { write_clique(json, catalog, clique); });
  json.close('}');
}

}  // namespace

std::string catalog_json(const CompiledFile& file) {
  const CompiledCatalog& catalog = file.catalog;
  const CatalogSummary summary = summarize(catalog);
  return json_line([&](JsonWriter& json) {
    json.write("schema", "cbc.catalog/1");
    json.on_new_line().write("format", file.format);
    json.on_new_line().write("written_by", file.written_by);
    json.on_new_line().write_object("source",
                                    {{"file", catalog.file}, {"digest", to_hex(file.source)}});
    json.on_new_line().write("content_digest", to_hex(file.content));
    json.on_new_line().write("size", file.size);
    json.on_new_line().write("tasks", summary.total.tasks);
    json.on_new_line().write("behaviors", summary.total.behaviors);
    write_numbers(json, summary.total);
    json.on_new_line().open("variables", '[');
    for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
      write_variable(json.on_new_line(), catalog, variable);
    }
    json.close(']');
    json.on_new_line().open("groups", '[');
    for (std::size_t group = 0; group < summary.groups.size(); ++group) {
      write_group(json, catalog, group, summary.groups[group]);
    }
    json.close(']');
  });
}

}  // namespace cbc
