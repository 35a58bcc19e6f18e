#include "cli/graph_options.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/input.h"
#include "cli/validators.h"
#include "cli/value_kind.h"
#include "text/nearest.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

/// The name that an unknown one may stand for.
std::string suggest(const draw::CatalogGraph& graph, const std::string& name) {
  const auto has_name = [&](const auto& one) { return one.name == name; };
  if (std::any_of(graph.behaviors.begin(), graph.behaviors.end(), has_name)) {
    return "; there is a behavior of this name";
  }
  std::vector<std::string_view> names;
  for (const auto& task : graph.tasks) names.push_back(task.name);
  return did_you_mean(nearest(name, names));
}

std::optional<std::vector<std::uint32_t>> find_tasks(const draw::CatalogGraph& graph,
                                                     const std::vector<std::string>& names) {
  std::vector<std::uint32_t> tasks;
  for (const std::string& name : names) {
    const auto found = std::find_if(graph.tasks.begin(), graph.tasks.end(),
                                    [&](const auto& task) { return task.name == name; });
    if (found == graph.tasks.end()) {
      complain(fmt::format("--task: catalog {} has no task {}{}", quote(graph.file), quote(name),
                           suggest(graph, name)));
      return std::nullopt;
    }
    tasks.push_back(static_cast<std::uint32_t>(found - graph.tasks.begin()));
  }
  return tasks;
}

std::uint32_t group_count(const draw::CatalogGraph& graph) {
  std::uint32_t groups = 0;
  for (const auto& task : graph.tasks) {
    if (task.group != none) groups = std::max(groups, task.group + 1);
  }
  return groups;
}

}  // namespace

void add_drawing_options(CLI::App& command, DrawingOptions& options) {
  constexpr std::uint32_t most = std::numeric_limits<std::uint32_t>::max();
  command
      .add_option("--view", options.view,
                  "What is drawn: full (default: tasks and behaviors), tasks (what each requires), "
                  "constraints (between tasks, one color a group), behaviors (what each requires)")
      ->option_text("VIEW")
      ->check(one_of({"full", "tasks", "constraints", "behaviors"}));
  command
      .add_option("--exclusivity", options.exclusivity,
                  "Draw lists of exclusive tasks as pairs, as hubs (a dot with a line to each "
                  "task), or none (default: up to three tasks as pairs, more as hubs; in the views "
                  "tasks and behaviors none)")
      ->option_text("STYLE")
      ->check(one_of({"pairs", "hubs", "none"}));
  command
      .add_option("--cluster", options.cluster,
                  "Draw frames around packages (of behaviors), groups (of tasks that constraints "
                  "connect), or none (default: none; in the view of the constraints groups)")
      ->option_text("KIND")
      ->check(one_of({"packages", "groups", "none"}));
  command.add_flag("--reduce", options.reduce,
                   "In the view of tasks, leave out requirements that follow from others");
  command
      .add_option("--task", options.tasks,
                  "Draw this task only, with what it requires and what requires it. Repeatable")
      ->option_text("NAME")
      ->check(stands_for(ValueKind::task))
      ->allow_extra_args(false);
  command.add_flag("--up", options.up, "Of --task: only what requires it");
  command.add_flag("--down", options.down, "Of --task: only what it requires");
  command.add_option("--depth", options.depth, "Of --task: at most N tasks away")
      ->option_text("N")
      ->check(whole_number(0, most));
  command
      .add_option("--group", options.group,
                  "Draw this group only; 'cbc compile --dump' numbers them")
      ->option_text("N")
      ->check(whole_number(0, most));
  command.add_flag("--legend", options.legend, "Add a key to the kinds of shapes and lines");
}

std::string find_misuse(const DrawingOptions& options) {
  if (!options.tasks.empty() && options.group) return "--task and --group do not go together";
  if (options.tasks.empty()) {
    if (options.up) return "--up goes with --task only";
    if (options.down) return "--down goes with --task only";
    if (options.depth) return "--depth goes with --task only";
  }
  if (options.reduce && options.view != "tasks") return "--reduce goes with --view tasks only";
  return {};
}

draw::ViewOptions view_options(const DrawingOptions& options) {
  draw::ViewOptions result;
  if (options.view == "tasks") result.view = draw::View::tasks;
  if (options.view == "constraints") result.view = draw::View::constraints;
  if (options.view == "behaviors") result.view = draw::View::behaviors;
  if (options.exclusivity == "pairs") result.exclusivity = draw::ExclusivityStyle::pairs;
  if (options.exclusivity == "hubs") result.exclusivity = draw::ExclusivityStyle::hubs;
  if (options.exclusivity == "none") result.exclusivity = draw::ExclusivityStyle::hidden;
  if (options.cluster == "packages") result.clustering = draw::Clustering::packages;
  if (options.cluster == "none") result.clustering = draw::Clustering::nothing;
  if (options.cluster == "groups") result.clustering = draw::Clustering::groups;
  result.reduce = options.reduce;
  return result;
}

std::optional<draw::Part> find_part(const draw::CatalogGraph& graph,
                                    const DrawingOptions& options) {
  if (options.group) {
    const std::uint32_t groups = group_count(graph);
    if (*options.group >= groups) {
      complain(fmt::format(
          "--group: catalog {} has no group {}; {}", quote(graph.file), *options.group,
          groups == 0 ? "it has none" : fmt::format("they count from 0 to {}", groups - 1)));
      return std::nullopt;
    }
    return part_of_group(graph, *options.group);
  }
  if (options.tasks.empty()) return whole(graph);
  const auto tasks = find_tasks(graph, options.tasks);
  if (!tasks) return std::nullopt;
  const bool is_both = options.up == options.down;
  return part_around(graph, *tasks,
                     {is_both || options.up, is_both || options.down, options.depth});
}

}  // namespace cbc::cli
