#include "cli/graph_command.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/drawable.h"
#include "cli/exit_status.h"
#include "cli/graph_diff.h"
#include "cli/graph_options.h"
#include "cli/graph_state.h"
#include "cli/graphviz.h"
#include "cli/help_format.h"
#include "cli/input.h"
#include "cli/output.h"
#include "cli/terminal.h"
#include "cli/value_kind.h"
#include "draw/catalog_graph.h"
#include "draw/view.h"
#include "report/diff_json.h"
#include "report/diff_text.h"
#include "report/graph_dot.h"
#include "report/graph_json.h"
#include "report/graph_mermaid.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

constexpr const char* graph_examples =
    "  cbc graph robot.yaml -o robot.svg         or .png, .pdf, .mmd, .json, .dot\n"
    "  cbc graph robot.yaml --task HOVER --down  what HOVER requires\n"
    "  cbc graph --diff old.yaml new.yaml --format text\n"
    "                                            what has changed\n";

constexpr const char* graph_footer =
    "More examples:\n"
    "  cbc graph robot.yaml | dot -Tx11          in a window\n"
    "  cbc graph robot.yaml --view tasks --reduce  which task requires which\n"
    "  cbc graph robot.cbc --view constraints    what hangs together\n"
    "  cbc graph robot.yaml --format mermaid     for a README file, a pull request\n"
    "  cbc graph robot.yaml --script mission.yaml --after 5\n"
    "                                            what runs after the 5th event\n"
    "\n"
    "Tasks are ellipses, behaviors are rectangles. A solid line says which behavior performs a "
    "task, and how well; a dashed arrow what it requires, and the minimum performance; a dotted "
    "line that tasks exclude one another. A catalog with errors is drawn as far as it is "
    "understood, with the faults in red. svg, png and pdf need Graphviz.\n"
    "\n"
    "With --diff, what is new is green (+), what is gone red and dashed (-), what has changed "
    "orange. In the format text a line says what; json is for programs (schema cbc.diff/1).\n"
    "\n"
    "Exit status: 0 all is well, or the catalog has errors but was drawn, 1 the catalogs of "
    "--diff differ, 2 nothing could be drawn, a file could not be read or written, or the usage "
    "is wrong, 3 an internal error.\n"
    "\n"
    "Read more: man cbc-graph";

constexpr std::size_t most_mermaid_edges = 500;  // by default

struct GraphCommand {
  std::vector<std::string> catalogs;
  bool is_diff = false;
  std::optional<std::string> output;
  std::string format;
  DrawingOptions drawing;
  StateOptions state;
};

/// The format that the suffix of the output names; empty if there is none of this name.
std::string format_of(const GraphCommand& command) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 9> formats = {
      {{".dot", "dot"},
       {".gv", "dot"},
       {".mmd", "mermaid"},
       {".mermaid", "mermaid"},
       {".json", "json"},
       {".svg", "svg"},
       {".png", "png"},
       {".pdf", "pdf"},
       {".txt", "text"}}};
  if (!command.format.empty()) return command.format;
  std::string suffix = std::filesystem::path(command.output.value_or("")).extension();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  if (suffix.empty()) return "dot";
  for (const auto& [known, format] : formats) {
    if (suffix == known) return std::string(format);
  }
  return {};
}

bool is_binary(std::string_view format) { return format == "png" || format == "pdf"; }

/// What is wrong with the combination of options; empty if nothing is.
std::string find_misuse(const GraphCommand& command) {
  const std::string format = format_of(command);
  const std::size_t catalogs = command.catalogs.size();
  if (command.output == "") return "expected the name of a file after -o";
  if (format.empty()) {
    return fmt::format(
        "the suffix of {} names no format; expected one like .dot or .svg, or --format",
        quote(*command.output));
  }
  if (command.is_diff && catalogs != 2) {
    return fmt::format("expected two catalogs to compare, found {}", catalogs);
  }
  if (!command.is_diff && catalogs > 1) {
    return fmt::format("expected one catalog, found {}; two can be compared with --diff", catalogs);
  }
  if (catalogs == 0 && !command.state.script) return "expected a catalog";
  if (command.is_diff && command.state.script) return "--diff and --script do not go together";
  if (std::count(command.catalogs.begin(), command.catalogs.end(), "-") > 1) return stdin_only_once;
  if (!command.is_diff && format == "text") return "the format text goes with --diff only";
  if (format == "text" || (command.is_diff && format == "json")) {
    if (command.drawing != DrawingOptions()) {
      return fmt::format("what is drawn, and how, does not go with --diff in the format {}",
                         format);
    }
  } else if (command.drawing.legend && format == "json") {
    return "--legend is for pictures; it does not go with json";
  }
  if (std::string misuse = find_misuse(command.state); !misuse.empty()) return misuse;
  return find_misuse(command.drawing);
}

/// The diagram in the format. Empty if it could not be made, which is complained of.
std::optional<std::string> write(const draw::Diagram& diagram, const std::string& format) {
  if (format == "json") return graph_json(diagram);
  if (format == "mermaid") return graph_mermaid(diagram);
  std::string dot = graph_dot(diagram);
  if (format == "dot") return dot;
  return run_graphviz(dot, format);
}

std::string output_of(const GraphCommand& command) { return command.output.value_or("-"); }

bool is_output(const std::string& input, const GraphCommand& command) {
  return is_same_file(input, output_of(command));
}

int refuse_output(const GraphCommand& command, std::string_view input) {
  return usage_error("graph",
                     fmt::format("the output {} is the {} itself", quote(*command.output), input));
}

/// Whether the output can be written where it shall be. If not, this is complained of.
bool can_write(const GraphCommand& command) {
  const std::string format = format_of(command);
  if (output_of(command) == "-") {
    if (!is_binary(format) || isatty(STDOUT_FILENO) == 0) return true;
    complain(fmt::format("{} is not written to a terminal; expected -o OUT or a pipe", format));
    return false;
  }
  const bool is_catalog =
      std::any_of(command.catalogs.begin(), command.catalogs.end(),
                  [&](const std::string& catalog) { return is_output(catalog, command); });
  const bool is_script = command.state.script && is_output(*command.state.script, command);
  if (!is_catalog && !is_script) return true;
  refuse_output(command, is_catalog ? "catalog" : "script");
  return false;
}

int draw(const draw::CatalogGraph& graph, const std::optional<draw::Moment>& moment,
         const GraphCommand& command) {
  const std::optional<draw::Part> part = find_part(graph, command.drawing);
  if (!part) return exit_unusable;
  draw::Diagram diagram = make_diagram(graph, *part, view_options(command.drawing));
  diagram.moment = moment;
  if (command.drawing.legend) add_legend(diagram);
  const std::string format = format_of(command);
  if (format == "mermaid" && diagram.edges.size() > most_mermaid_edges) {
    complain(
        fmt::format("the picture has {} lines; Mermaid draws {} if it is not told otherwise "
                    "(maxEdges); --task and --group draw less",
                    diagram.edges.size(), most_mermaid_edges));
  }
  const std::optional<std::string> content = write(diagram, format);
  return content ? write_output(output_of(command), *content) : exit_unusable;
}

int draw_catalog(const GraphCommand& command) {
  const std::string catalog = command.catalogs.empty() ? std::string() : command.catalogs.front();
  int status = exit_unusable;
  const std::unique_ptr<Drawable> drawable =
      command.state.script ? read_state(catalog, command.state, status) : read_drawable(catalog);
  if (drawable == nullptr) return status;
  if (drawable->named_catalog && is_output(*drawable->named_catalog, command)) {
    return refuse_output(command, "catalog");
  }
  return draw(drawable->graph, drawable->moment, command);
}

int show_diff(const ComparedCatalogs& compared, const GraphCommand& command) {
  const CatalogDiff& diff = compared.diff;
  const std::string format = format_of(command);
  if (format == "text") {
    const Style style = output_of(command) == "-" ? style_for(stdout) : plain_style();
    return write_output(output_of(command), diff_text(diff, style));
  }
  if (format == "json") {
    return write_output(output_of(command),
                        diff_json(diff, compared.before->file, compared.after->file));
  }
  if (diff.further_exclusions > 0) {
    complain(fmt::format("{} further differences of exclusions are not marked",
                         diff.further_exclusions));
  }
  return draw(compared.graph, std::nullopt, command);
}

int draw_diff(const GraphCommand& command) {
  const auto compared = read_and_compare(command.catalogs.front(), command.catalogs.back());
  if (compared == nullptr) return exit_unusable;
  const int status = show_diff(*compared, command);
  return status == exit_ok && compared->diff.size() > 0 ? exit_no : status;
}

int run_graph(const GraphCommand& command) {
  if (const std::string misuse = find_misuse(command); !misuse.empty())
    return usage_error("graph", misuse);
  if (!can_write(command)) return exit_unusable;
  return command.is_diff ? draw_diff(command) : draw_catalog(command);
}

}  // namespace

void add_graph_command(CLI::App& program, int& status) {
  const auto options = std::make_shared<GraphCommand>();
  CLI::App* const command =
      program.add_subcommand("graph", "Draws the tasks and behaviors of a catalog.");
  set_help(*command,
           {{"[OPTION...] [CATALOG]", "--diff [OPTION...] OLD NEW"}, graph_examples, graph_footer});
  command
      ->add_option("CATALOG", options->catalogs,
                   "The catalog: YAML or a compiled one, or - for standard input; with --diff two "
                   "of them, the older one first")
      ->option_text(" ")
      ->check(stands_for(ValueKind::catalog));
  command->add_flag("--diff", options->is_diff,
                    "Show what two catalogs do not have in common, whatever their order and "
                    "layout; exit status 1 if there is anything");
  command
      ->add_option("-o,--output", options->output,
                   "The file to write, or - for standard output (default)")
      ->option_text("OUT")
      ->check(stands_for(ValueKind::file));
  command
      ->add_option("--format", options->format,
                   "dot, mermaid, json, svg, png or pdf, with --diff also text (default: by the "
                   "suffix of OUT; without one dot)")
      ->option_text("FORMAT")
      ->check(one_of({"dot", "mermaid", "json", "svg", "png", "pdf", "text"}));
  add_drawing_options(*command, options->drawing);
  add_state_options(*command, options->state);
  command->callback([options, &status] { status = run_graph(*options); });
}

}  // namespace cbc::cli
