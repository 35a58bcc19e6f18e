#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "ask/together.h"
#include "commands.h"
#include "core/check/check.h"
#include "core/check/severity_settings.h"
#include "core/command_line/command_line.h"
#include "core/files/file_set.h"
#include "core/files/missions.h"
#include "core/files/output.h"
#include "core/script/runner.h"
#include "core/support/system.h"
#include "core/support/wording.h"
#include "graph/engine/catalog_graph.h"
#include "graph/engine/diagram.h"
#include "graph/engine/state_recorder.h"
#include "graph/report/graph_report.h"
#include "graph/report/tables.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_catalog.h"
#include "versions/difference/catalog_diff.h"

namespace cbc::cli {
namespace {

/// What `cbc graph` draws of a catalog, and how.
struct DrawingOptions {
  std::string view;
  std::string exclusivity;
  std::string cluster;
  bool reduce = false;
  bool legend = false;
  std::vector<std::string> tasks;
  bool up = false;
  bool down = false;
  std::optional<std::uint32_t> depth;
  std::optional<std::uint32_t> group;

  [[nodiscard]] bool operator==(const DrawingOptions&) const = default;
};

/// The drawable part of a catalog, and its source.
struct Drawable {
  std::shared_ptr<const CheckedCatalog> catalog;  ///< not compiled if it has errors
  draw::CatalogGraph graph;
  std::optional<draw::Moment> moment;  ///< of a state
};

/// Reads a catalog, compiled or YAML, which may have errors, and prints the findings. Null if
/// nothing can be drawn.
std::unique_ptr<Drawable> read_drawable(const std::string& path) {
  FileSet files;
  auto drawable = std::make_unique<Drawable>();
  if (const auto file = files.read_catalog(path)) {
    drawable->catalog = files.load(*file, FileSet::Purpose::drawing);
  }
  files.print_findings();
  if (drawable->catalog == nullptr) return nullptr;
  const CheckedCatalog& catalog = *drawable->catalog;
  draw::CatalogGraph& graph = drawable->graph;
  graph = catalog.compiled != nullptr ? draw::to_graph(*catalog.compiled)
                                      : draw::to_graph(catalog.reading, files.findings());
  const bool is_empty = graph.tasks.empty() && graph.behaviors.empty();
  return catalog.compiled == nullptr && is_empty ? nullptr : std::move(drawable);
}

/// A hint at the name that may have been meant.
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
      complain("--task: catalog {} has no task {}{}", quote(graph.file), quote(name),
               suggest(graph, name));
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

void add_drawing_options(Command& command, DrawingOptions& options) {
  command.group("Drawing");
  constexpr std::uint32_t most = std::numeric_limits<std::uint32_t>::max();
  command
      .option(
          "--view", options.view,
          one_of("VIEW", {"full", "tasks", "constraints", "behaviors", "together", "situation"}),
          "full, tasks, behaviors, constraints; or a table: together, situation")
      .without("full");
  command.option("--exclusivity", options.exclusivity, one_of("STYLE", {"pairs", "hubs", "none"}),
                 "Draw exclusive tasks as pairs, hubs or none");
  command.option("--cluster", options.cluster, one_of("KIND", {"packages", "groups", "none"}),
                 "Draw frames around packages, groups or none");
  command.flag("--reduce", options.reduce, "Leave out requirements that follow (--view tasks)")
      .only_with({"--view tasks"});
  command.flag("--legend", options.legend, "Add a legend");

  command.group("Part");
  command
      .option("--task", options.tasks, name_of("NAME", ValueKind::task),
              "Draw only what is around this task")
      .not_with({"--group"});
  command.flag("--up", options.up, "Only what requires that task").only_with({"--task"});
  command.flag("--down", options.down, "Only what that task requires").only_with({"--task"});
  command
      .option("--depth", options.depth, whole_number("N", 0, most),
              "Only what is at most N tasks away from it")
      .only_with({"--task"});
  command.option("--group", options.group, whole_number("N", 0, most),
                 "Draw only this group (see 'cbc compile --dump')");
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

/// The part of the catalog to draw. Empty, after a message, if it has no such tasks or group.
std::optional<draw::Part> find_part(const draw::CatalogGraph& graph,
                                    const DrawingOptions& options) {
  if (options.group) {
    const std::uint32_t groups = group_count(graph);
    if (*options.group >= groups) {
      complain("--group: catalog {} has no group {}; {}", quote(graph.file), *options.group,
               groups == 0 ? "it has none"
                           : fmt::format("the groups are numbered from 0 to {}", groups - 1));
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

std::string first_line(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "it wrote nothing" : line;
}

/// Replaces the creation date of a PDF file, so that the same catalog gives the same bytes. The
/// length stays the same, because the file has a table of byte offsets.
void remove_date(std::string& pdf) {
  constexpr std::string_view begin = "/CreationDate (D:";
  constexpr std::string_view date = "19700101000000";
  const std::size_t place = pdf.find(begin);
  if (place == std::string::npos || pdf.size() < place + begin.size() + date.size()) return;
  pdf.replace(place + begin.size(), date.size(), date);
}

/// Runs `dot`, a program of Graphviz, on a graph. Empty, after a message, if that fails.
std::optional<std::string> run_graphviz(const std::string& dot, std::string_view format) {
  const std::string format_option = fmt::format("-T{}", format);
  Filtered picture = run_filter({"dot", format_option}, dot);
  // It fails ("trouble in init_rank") at frames around some cycles, which catalogs with errors
  // have.
  if (picture.is_found && !picture.is_done) {
    picture = run_filter({"dot", "-Gnewrank=true", format_option}, dot);
  }
  if (!picture.is_found) {
    complain("{} needs Graphviz (Debian: apt install graphviz): cannot run 'dot': {}", format,
             picture.error_output);
    return std::nullopt;
  }
  if (!picture.is_done || picture.output.empty()) {
    complain("Graphviz cannot draw it as {}: {}", format,
             printable(first_line(picture.error_output)));
    return std::nullopt;
  }
  if (format == "pdf") remove_date(picture.output);
  return std::move(picture.output);
}

/// The state of a mission that `cbc graph` draws.
struct StateOptions {
  std::optional<std::string> script;  ///< empty: the catalog is drawn without a state
  std::optional<std::uint64_t> after;
  std::string at;
};

/// A script with its catalog.
std::optional<Mission> load_mission(const std::string& catalog, const std::string& script) {
  std::vector<std::string> paths;
  if (!catalog.empty()) paths.push_back(catalog);
  paths.push_back(script);
  for (const std::string& path : paths) {
    if (!is_folder(path)) continue;
    complain("cannot read {}: it is a folder", quote(path));
    return std::nullopt;
  }
  std::optional<std::vector<Mission>> missions = MissionLoader().load(paths);
  if (!missions) return std::nullopt;
  if (missions->size() > 1) {
    complain("{} is a script; expected a catalog here (a script goes after --script)",
             quote(display_name(catalog)));
    return std::nullopt;
  }
  return std::move(missions->front());
}

Microseconds end_of(const Script& script) {
  Microseconds end = 0;
  for (const Step& step : script.steps) end = step.time.value_or(end);
  return end;
}

WantedState wanted_state(const StateOptions& options) {
  WantedState wanted;
  wanted.index = options.after;
  if (!options.at.empty()) wanted.time = parse_seconds(options.at).value;
  return wanted;
}

/// Why a complete run has no such state; empty if it has.
std::string find_miss(const Script& script, const WantedState& wanted, std::uint64_t events) {
  if (wanted.index && *wanted.index > events) {
    return fmt::format("--after: script {} makes {} {} in all", quote(script.file), events,
                       events == 1 ? "event" : "events");
  }
  if (wanted.time && *wanted.time > end_of(script)) {
    return fmt::format("--at: script {} ends at {} s", quote(script.file),
                       format_decimal(end_of(script), 6));
  }
  return {};
}

void add_state_options(Command& command, StateOptions& options) {
  command.group("State");
  command
      .option("--script", options.script, input("SCRIPT", ValueKind::script),
              "Run this event script, and mark what runs at its end")
      .not_with({"--diff"});
  command
      .option("--after", options.after, whole_number("N", 0),
              "Mark what runs after the Nth event of it")
      .only_with({"--script"})
      .not_with({"--at"});
  command.option("--at", options.at, seconds(0), "Mark what runs after this time of it")
      .only_with({"--script"});
}

/// Runs the script on the catalog, or on the one that it names if `catalog` is empty. Null if there
/// is no such state: the reason is printed, and `status` is set.
std::unique_ptr<Drawable> read_state(const std::string& catalog, const StateOptions& options,
                                     int& status) {
  status = exit_unusable;
  std::optional<Mission> mission = load_mission(catalog, *options.script);
  if (!mission) return nullptr;
  const WantedState wanted = wanted_state(options);
  const CoordinatorOptions coordination;
  StateRecorder recorder(*mission->catalog, mission->script, wanted);
  const RunResult result = run_script(*mission->catalog, mission->script, coordination, recorder);
  if (!recorder.has_passed()) {
    std::string problem = describe_end(result, coordination);
    if (problem.empty()) problem = find_miss(mission->script, wanted, recorder.events());
    if (!problem.empty()) {
      complain(problem);
      status = std::max<int>(exit_unusable, status_of(result));
      return nullptr;
    }
  }
  auto state = std::make_unique<Drawable>();
  state->graph = draw::to_graph(*mission->catalog);
  draw::mark_state(state->graph, recorder.state());
  state->moment = recorder.moment();
  state->catalog = std::move(mission->source);
  return state;
}

/// Two catalogs, their differences, and a graph of both.
struct ComparedCatalogs {
  std::shared_ptr<const CompiledCatalog> before;
  std::shared_ptr<const CompiledCatalog> after;
  CatalogDiff diff;
  draw::CatalogGraph graph;            ///< not of a text
  std::vector<FittingChange> fitting;  ///< of a text
};

/// Reads two catalogs, compiled or YAML. Null, after a message, if one of them cannot be used.
std::unique_ptr<ComparedCatalogs> read_both(const std::string& before, const std::string& after) {
  auto compared = std::make_unique<ComparedCatalogs>();
  FileSet files;
  const auto old_catalog = files.load(before);
  const auto new_catalog = files.load(after);
  files.print_findings();
  if (old_catalog == nullptr || new_catalog == nullptr) return nullptr;
  compared->before = old_catalog->compiled;
  compared->after = new_catalog->compiled;
  return compared;
}

/// For a text: what was renamed is told as such. Programs and drawings have it by both names.
/// Returns whether what the command line says of it can be used.
bool compare_for_people(const std::vector<std::string>& renamed, ComparedCatalogs& compared) {
  const CompiledCatalog& before = *compared.before;
  const CompiledCatalog& after = *compared.after;
  Renames renames;
  for (const std::string& entry : renamed) {
    const std::size_t equals = entry.find('=');
    const std::string old_name = entry.substr(0, equals);
    const std::string new_name = entry.substr(equals + 1);
    const std::string fault = add_rename(before, after, old_name, new_name, renames);
    if (!fault.empty()) {
      complain("--renamed: {}", fault);
      return false;
    }
    const bool is_taken =
        (task_called(before, old_name) && task_called(before, new_name)) ||
        (behavior_called(before, old_name) && behavior_called(before, new_name)) ||
        (variable_called(before, old_name) && variable_called(before, new_name));
    if (is_taken) {
      complain("--renamed: {} has both {} and {}", quote(before.file), quote(old_name),
               quote(new_name));
      return false;
    }
  }
  renames = find_renames(before, after, renames);
  compared.diff = compare_catalogs(before, after, renames);
  compared.fitting = compare_fitting(before, after, renames);
  return true;
}

constexpr const char* graph_examples =
    "  cbc graph robot.yaml -o robot.svg         or .png, .pdf, .mmd, .json, .dot\n"
    "  cbc graph robot.yaml --task DRIVE --down  what DRIVE requires\n"
    "  cbc graph robot.yaml --view together      which tasks can run at the same time\n"
    "  cbc graph --diff old.yaml new.yaml        what has changed\n";

constexpr const char* graph_footer =
    "Exit status: 0 success, or the catalog has errors but was drawn, 1 the catalogs of --diff "
    "differ, 2 nothing could be drawn, a file could not be read or written, or the usage is wrong, "
    "3 an internal error.\n"
    "\n"
    "Read more: man cbc-graph";

constexpr std::size_t most_mermaid_edges = 500;  // by default

struct GraphCommand {
  std::vector<std::string> catalogs;
  bool is_diff = false;
  std::vector<std::string> renamed;  ///< OLD=NEW
  std::optional<std::string> output;
  std::string format;
  DrawingOptions drawing;
  StateOptions state;
};

/// The format of differences and tables for people.
constexpr std::string_view text_format = "text";

/// Whether the view is a table, not a drawing.
bool is_table(const GraphCommand& command) {
  return command.drawing.view == "together" || command.drawing.view == "situation";
}

/// The name of the format, which the suffix of the output may tell; empty if it tells none.
std::string format_of(const GraphCommand& command) {
  if (!command.format.empty()) return command.format;
  std::string suffix = std::filesystem::path(command.output.value_or("")).extension();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  if (suffix.empty()) {
    return std::string(is_table(command) ? text_format : graph_formats().front().name);
  }
  if (suffix == ".txt") return std::string(text_format);
  for (const GraphFormat& format : graph_formats()) {
    if (suffix == format.suffixes[0] || suffix == format.suffixes[1]) {
      return std::string(format.name);
    }
  }
  return {};
}

/// The same for a table.
std::string find_misuse_of_table(const GraphCommand& command) {
  const std::string& view = command.drawing.view;
  if (command.is_diff) return fmt::format("--view {} cannot be used with --diff", view);
  if (command.state.script) {
    return fmt::format("--view {} cannot be used with --script", view);
  }
  if (!command.drawing.tasks.empty() || command.drawing.group) {
    return fmt::format("{} cannot be used with --view {}: the table is of the whole catalog",
                       command.drawing.group ? "--group" : "--task", view);
  }
  DrawingOptions drawing;
  drawing.view = view;
  if (command.drawing != drawing) {
    return fmt::format("other options of the drawing cannot be used with --view {}", view);
  }
  const std::string format = format_of(command);
  if (format == text_format || format == "json") return {};
  return fmt::format("--view {} cannot be written as {}; expected text or json", view, format);
}

/// Says what is wrong with the format or the number of catalogs; empty if nothing is.
std::string find_misuse(const GraphCommand& command) {
  const std::string format = format_of(command);
  const std::size_t catalogs = command.catalogs.size();
  if (format.empty()) {
    return fmt::format(
        "the suffix of {} names no format; expected one like .dot or .svg, or --format",
        quote(*command.output));
  }
  if (command.is_diff && catalogs != 2) {
    return fmt::format("expected two catalogs to compare, found {}", catalogs);
  }
  if (!command.is_diff && catalogs > 1) {
    return fmt::format("expected one catalog, found {}; --diff compares two", catalogs);
  }
  if (catalogs == 0 && !command.state.script) return "expected a catalog";
  if (is_table(command)) return find_misuse_of_table(command);
  if (!command.renamed.empty() && format != text_format) {
    return "--renamed can only be used with --format text";
  }
  if (!command.is_diff && format == text_format) {
    return "--format text can only be used with --diff or a --view that is a table";
  }
  if (format == text_format || (command.is_diff && format == "json")) {
    if (command.drawing != DrawingOptions()) {
      return fmt::format("options of the drawing cannot be used with --diff --format {}", format);
    }
  } else if (command.drawing.legend && format == "json") {
    return "--legend cannot be used with --format json";
  }
  return {};
}

std::string output_of(const GraphCommand& command) { return command.output.value_or("-"); }

/// Whether the output can be written to its place. If not, prints why.
bool can_write(const GraphCommand& command) {
  const GraphFormat* const format = find_named(graph_formats(), format_of(command));
  if (format == nullptr || !format->is_binary || output_of(command) != "-" ||
      isatty(STDOUT_FILENO) == 0)
    return true;
  complain("{} is not written to a terminal; expected -o OUT or a pipe", format->name);
  return false;
}

int draw(const draw::CatalogGraph& graph, const std::optional<draw::Moment>& moment,
         const GraphCommand& command) {
  const std::optional<draw::Part> part = find_part(graph, command.drawing);
  if (!part) return exit_unusable;
  draw::Diagram diagram = make_diagram(graph, *part, view_options(command.drawing));
  diagram.moment = moment;
  if (command.drawing.legend) add_legend(diagram);
  const GraphFormat& format = *find_named(graph_formats(), format_of(command));
  if (format.name == "mermaid" && diagram.edges.size() > most_mermaid_edges) {
    complain(
        "the picture has {} lines; by default Mermaid draws at most {} "
        "(maxEdges); --task and --group draw less",
        diagram.edges.size(), most_mermaid_edges);
  }
  std::optional<std::string> content = format.write(diagram);
  if (format.is_by_graphviz) content = run_graphviz(*content, format.name);
  return content ? write_output(output_of(command), *content) : exit_unusable;
}

std::string pairs_to_text(const CompiledCatalog& catalog, const SeveritySettings& settings,
                          bool is_json, const Style& style) {
  TogetherOptions options;
  for (const NeverTogether& list : settings.never_together()) {
    options.never_together.push_back(list.tasks);
  }
  const TogetherTable table = make_together_table(catalog, options);
  return is_json ? together_json(catalog, table) : together_text(catalog, table, style);
}

int write_table(const GraphCommand& command) {
  const std::string& catalog = command.catalogs.front();
  const bool is_of_pairs = command.drawing.view == "together";
  const std::unique_ptr<Drawable> drawable = read_drawable(catalog);
  if (drawable == nullptr) return exit_unusable;
  const std::optional<SeveritySettings> settings = SettingsFinder().find(catalog);
  if (!settings) return exit_unusable;
  if (drawable->catalog->compiled == nullptr) {
    return complain("catalog {} has errors, so it is not known {}", quote(drawable->graph.file),
                    is_of_pairs ? "which tasks can run together" : "which behaviors fit");
  }
  const CompiledCatalog& compiled = *drawable->catalog->compiled;
  const std::size_t tasks = is_of_pairs ? count_tasks_in_pairs(compiled) : 0;
  if (tasks > most_tasks_in_pairs) {
    return complain(
        "catalog {} has too many tasks for a table of their pairs: {}; expected at most {}",
        quote(compiled.file), tasks, most_tasks_in_pairs);
  }
  const bool is_json = format_of(command) == "json";
  const Style style = style_for(output_of(command));
  if (is_of_pairs) {
    return write_output(output_of(command), pairs_to_text(compiled, *settings, is_json, style));
  }
  return write_output(output_of(command),
                      is_json ? situation_json(compiled) : situation_text(compiled, style));
}

int draw_catalog(const GraphCommand& command) {
  const std::string catalog = command.catalogs.empty() ? std::string() : command.catalogs.front();
  int status = exit_unusable;
  const std::unique_ptr<Drawable> drawable =
      command.state.script ? read_state(catalog, command.state, status) : read_drawable(catalog);
  if (drawable == nullptr) return status;
  return draw(drawable->graph, drawable->moment, command);
}

int show_diff(const ComparedCatalogs& compared, const GraphCommand& command) {
  const CatalogDiff& diff = compared.diff;
  const std::string format = format_of(command);
  if (format == text_format) {
    const Style style = style_for(output_of(command));
    return write_output(output_of(command),
                        diff_text(diff, style) + fitting_text(compared.fitting, style));
  }
  if (format == "json") {
    return write_output(output_of(command),
                        diff_json(diff, compared.before->file, compared.after->file));
  }
  if (diff.further_exclusions > 0) {
    complain("{} further differences of exclusions are not marked", diff.further_exclusions);
  }
  return draw(compared.graph, std::nullopt, command);
}

int draw_diff(const GraphCommand& command) {
  const auto compared = read_both(command.catalogs.front(), command.catalogs.back());
  if (compared == nullptr) return exit_unusable;
  if (format_of(command) == text_format) {
    if (!compare_for_people(command.renamed, *compared)) return exit_unusable;
  } else {
    compared->diff = compare_catalogs(*compared->before, *compared->after);
    compared->graph = draw::to_graph(*compared->before, *compared->after, compared->diff);
  }
  const int status = show_diff(*compared, command);
  return status == exit_ok && compared->diff.size() > 0 ? exit_no : status;
}

int run_graph(const GraphCommand& command) {
  if (const std::string misuse = find_misuse(command); !misuse.empty())
    return usage_error("graph", misuse);
  if (!can_write(command)) return exit_unusable;
  if (is_table(command)) return write_table(command);
  return command.is_diff ? draw_diff(command) : draw_catalog(command);
}

}  // namespace

void add_graph_command(Program& program) {
  std::vector<std::string> formats = names_in(graph_formats());
  formats.emplace_back(text_format);
  const auto options = std::make_shared<GraphCommand>();
  Command& command = program.add_command(
      "graph", "Draws the tasks and behaviors of a catalog.",
      {{"[OPTION...] [CATALOG]", "--diff [OPTION...] OLD NEW"}, graph_examples, graph_footer});
  command.argument("CATALOG", options->catalogs, input("", ValueKind::catalog),
                   "The catalog: YAML or compiled, or - for standard input");
  command.flag("--diff", options->is_diff, "Show the differences between two catalogs");
  command
      .option("--renamed", options->renamed, old_and_new_name(),
              "With --diff: OLD is called NEW now")
      .only_with({"--diff"});
  command.output_option(options->output);
  command.option("--format", options->format, one_of("FORMAT", formats), join_with_or(formats))
      .without("by the suffix of OUT");
  command.add_confinement();
  add_drawing_options(command, options->drawing);
  add_state_options(command, options->state);
  command.action([options] { return run_graph(*options); });
}

}  // namespace cbc::cli
