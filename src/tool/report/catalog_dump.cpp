#include "report/catalog_dump.h"

#include <iterator>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "catalog/allowed_values.h"
#include "cbc/units.h"
#include "compile/numbers.h"
#include "report/sentences.h"
#include "support/json.h"

namespace cbc {
namespace {

std::string seconds(Microseconds time) { return format_decimal(time, 6) + " s"; }

class Listing {
 public:
  explicit Listing(const CompiledFile& file) : file_(file), catalog_(file.catalog) {}

  [[nodiscard]] std::string run() {
    add_file();
    const CatalogSummary summary = summarize_groups(catalog_);
    line("");
    add_numbers("", summary.total);
    line("groups: {}", summary.groups.size());
    for (std::size_t group = 0; group < summary.groups.size(); ++group) {
      line("");
      line("group {}", group);
      add_numbers("  ", summary.groups[group]);
      add_group(group);
    }
    return std::move(text_);
  }

 private:
  template <typename... Facts>
  void line(fmt::format_string<Facts...> form, Facts&&... facts) {
    fmt::format_to(std::back_inserter(text_), form, std::forward<Facts>(facts)...);
    text_ += '\n';
  }

  void add_file() {
    line("source: {}", printable(catalog_.file));
    line("source digest: {}", to_hex(file_.source));
    line("written by: cbc {}", printable(file_.written_by));
    line("format: {}", file_.format);
    line("content digest: {}", to_hex(file_.content));
    line("size: {} bytes", file_.size);
  }

  void add_numbers(std::string_view indent, const CatalogNumbers& numbers) {
    line("{}tasks: {}", indent, numbers.tasks);
    line("{}behaviors: {}", indent, numbers.behaviors);
    line("{}levels: {}", indent, numbers.levels);
    line("{}exclusive pairs: {}", indent, numbers.constraints.exclusive_pairs);
    line("{}requirements: {}", indent, numbers.constraints.requirements);
    line("{}task minimums: {}", indent, numbers.constraints.task_minimums);
    line("{}constraints: {}", indent, numbers.constraints.total());
    line("{}search space: {}", indent, numbers.search_space);
  }

  void add_group(std::size_t group) {
    for (TaskId task = catalog_.group_tasks[group]; task < catalog_.group_tasks[group + 1];
         ++task) {
      add_task(task);
    }
    for (BehaviorId behavior = catalog_.group_behaviors[group];
         behavior < catalog_.group_behaviors[group + 1]; ++behavior) {
      add_behavior(behavior);
    }
    for (const std::uint32_t clique : cliques_of_group(catalog_, group)) {
      std::string names;
      for (const TaskId task : catalog_.cliques[clique]) {
        names += (names.empty() ? "" : ", ") + printable(catalog_.name_of_task(task));
      }
      line("  mutually_exclusive: {}", names);
    }
  }

  void add_task(TaskId id) {
    const CompiledTask& task = catalog_.tasks[id];
    line("  task {}", printable(catalog_.name_of_task(id)));
    line("    level: {}", task.level);
    line("    execution_goal: {}", task.keep_running != 0 ? "keep_running" : "achieve_goal");
    line("    start_on_request: {}", task.start_on_request != 0);
    line("    reactive_start: {}", task.reactive_start != 0);
    if (task.timeout > 0) line("    timeout: {}", seconds(task.timeout));
    if (task.minimum_performance > 0) {
      line("    minimum_performance: {}", format_percent(task.minimum_performance));
    }
    for (const Parameter& parameter : parameters_of(catalog_, task.catalog_index)) {
      add_parameter(parameter);
    }
    for (const Value& value : catalog_.values[id]) {
      line("    behavior: {}, {}", printable(catalog_.name_of_behavior(value.behavior)),
           format_percent(value.suitability));
    }
  }

  void add_parameter(const Parameter& parameter) {
    std::string allowed;
    for (const std::string& value : parameter.allowed_values) {
      allowed += (allowed.empty() ? "" : ", ") + printable(value);
    }
    if (parameter.allowed_is_list) allowed = "[" + allowed + "]";
    line("    parameter: {}{}{}", printable(parameter.name), allowed.empty() ? "" : ", ", allowed);
  }

  void add_behavior(BehaviorId id) {
    const CompiledBehavior& behavior = catalog_.behaviors[id];
    line("  behavior {}", printable(catalog_.name_of_behavior(id)));
    line("    level: {}", behavior.level);
    const std::string_view package =
        catalog_.texts[catalog_.behavior_packages[behavior.catalog_index]];
    if (!package.empty()) line("    package: {}", printable(package));
    if (behavior.timeout > 0) line("    timeout: {}", seconds(behavior.timeout));
    for (const CompiledRequirement& requirement : catalog_.requirements[id]) {
      const Millionths minimum = requirement.minimum_performance;
      line("    requires: {}{}", printable(catalog_.name_of_task(requirement.task)),
           minimum > 0 ? ", at least " + format_percent(minimum) : "");
    }
  }

  const CompiledFile& file_;
  const CompiledCatalog& catalog_;
  std::string text_;
};

}  // namespace

std::string catalog_text(const CompiledFile& file) { return Listing(file).run(); }

namespace {

using Json = nlohmann::ordered_json;

/// The decimal number nearest to it is exact, and it is what is printed.
Json percent(Millionths degree) {
  if (degree % 10'000 == 0) return degree / 10'000;
  return static_cast<double>(degree) / 10'000;
}

Json percent_or_null(Millionths degree) { return degree > 0 ? percent(degree) : Json(nullptr); }

Json seconds_or_null(Microseconds time) {
  if (time == 0) return nullptr;
  if (time % second == 0) return time / second;
  return to_seconds(time);
}

Json to_json(const ConstraintCount& constraints) {
  return {{"exclusive_pairs", constraints.exclusive_pairs},
          {"requirements", constraints.requirements},
          {"task_minimums", constraints.task_minimums},
          {"total", constraints.total()}};
}

Json to_json(const Parameter& parameter) {
  Json json{{"parameter", parameter.name}, {"allowed_values", parameter.allowed_values}};
  if (!parameter.allowed_is_list) {
    json["allowed_values"] =
        parameter.allowed_values.empty() ? Json(nullptr) : Json(parameter.allowed_values.front());
  }
  return json;
}

Json task_to_json(const CompiledCatalog& catalog, TaskId id) {
  const CompiledTask& task = catalog.tasks[id];
  Json json{{"task", catalog.name_of_task(id)},
            {"level", task.level},
            {"execution_goal", task.keep_running != 0 ? "keep_running" : "achieve_goal"},
            {"start_on_request", task.start_on_request != 0},
            {"reactive_start", task.reactive_start != 0},
            {"timeout", seconds_or_null(task.timeout)},
            {"minimum_performance", percent_or_null(task.minimum_performance)},
            {"line", task.minimum_performance > 0 ? Json(task.minimum_line) : Json(nullptr)}};
  Json& parameters = json["parameters"] = Json::array();
  for (const Parameter& parameter : parameters_of(catalog, task.catalog_index)) {
    parameters.push_back(to_json(parameter));
  }
  Json& behaviors = json["behaviors"] = Json::array();
  for (const Value& value : catalog.values[id]) {
    behaviors.push_back({{"behavior", catalog.name_of_behavior(value.behavior)},
                         {"suitability", percent(value.suitability)}});
  }
  return json;
}

Json behavior_to_json(const CompiledCatalog& catalog, BehaviorId id) {
  const CompiledBehavior& behavior = catalog.behaviors[id];
  Json required = Json::array();
  for (const CompiledRequirement& requirement : catalog.requirements[id]) {
    required.push_back({{"task", catalog.name_of_task(requirement.task)},
                        {"minimum_performance", percent_or_null(requirement.minimum_performance)},
                        {"line", catalog.line_of(requirement)}});
  }
  return {{"behavior", catalog.name_of_behavior(id)},
          {"level", behavior.level},
          {"package", catalog.texts[catalog.behavior_packages[behavior.catalog_index]]},
          {"timeout", seconds_or_null(behavior.timeout)},
          {"requires", std::move(required)}};
}

Json clique_to_json(const CompiledCatalog& catalog, std::uint32_t clique) {
  Json tasks = Json::array();
  for (const TaskId task : catalog.cliques[clique]) tasks.push_back(catalog.name_of_task(task));
  return {{"tasks", std::move(tasks)}, {"line", catalog.clique_lines[clique]}};
}

std::string numbers_to_text(const CatalogNumbers& numbers) {
  return "\"levels\":" + std::to_string(numbers.levels) +
         ",\n\"constraints\":" + to_text(to_json(numbers.constraints)) + ",\n\"search_space\":\"" +
         numbers.search_space + "\"";
}

std::string group_to_text(const CompiledCatalog& catalog, std::size_t group,
                          const CatalogNumbers& numbers) {
  std::string text = "{\"group\":" + std::to_string(group) + ",\n" + numbers_to_text(numbers);
  text += ",\n\"tasks\":[";
  for (TaskId id = catalog.group_tasks[group]; id < catalog.group_tasks[group + 1]; ++id) {
    append_item(text, to_text(task_to_json(catalog, id)));
  }
  text += "],\n\"behaviors\":[";
  for (BehaviorId id = catalog.group_behaviors[group]; id < catalog.group_behaviors[group + 1];
       ++id) {
    append_item(text, to_text(behavior_to_json(catalog, id)));
  }
  text += "],\n\"exclusivity\":[";
  for (const std::uint32_t clique : cliques_of_group(catalog, group)) {
    append_item(text, to_text(clique_to_json(catalog, clique)));
  }
  return text + "]}";
}

}  // namespace

std::string catalog_json(const CompiledFile& file) {
  const CompiledCatalog& catalog = file.catalog;
  const CatalogSummary summary = summarize_groups(catalog);
  const Json source{{"file", catalog.file}, {"digest", to_hex(file.source)}};
  std::string text = R"({"schema":"cbc.catalog/1")";
  text += ",\n\"format\":" + std::to_string(file.format);
  text += ",\n\"written_by\":" + to_text(file.written_by);
  text += ",\n\"source\":" + to_text(source);
  text += ",\n\"content_digest\":\"" + to_hex(file.content) + "\"";
  text += ",\n\"size\":" + std::to_string(file.size);
  text += ",\n\"tasks\":" + std::to_string(summary.total.tasks);
  text += ",\n\"behaviors\":" + std::to_string(summary.total.behaviors);
  text += ",\n" + numbers_to_text(summary.total);
  text += ",\n\"groups\":[";
  for (std::size_t group = 0; group < summary.groups.size(); ++group) {
    append_item(text, group_to_text(catalog, group, summary.groups[group]));
  }
  return text + "]}\n";
}

}  // namespace cbc
