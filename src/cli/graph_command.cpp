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

#include "catalog/reader.h"
#include "cli/exit_status.h"
#include "cli/graph_diff.h"
#include "cli/graph_options.h"
#include "cli/graphviz.h"
#include "cli/input.h"
#include "cli/input_files.h"
#include "cli/terminal.h"
#include "compiled/compile.h"
#include "draw/catalog_graph.h"
#include "draw/view.h"
#include "file/atomic_file.h"
#include "report/diff_json.h"
#include "report/diff_text.h"
#include "report/graph_dot.h"
#include "report/graph_json.h"
#include "report/graph_mermaid.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

constexpr const char* graph_footer =
    "Examples:\n"
    "  cbc graph quadrotor.yaml | dot -Tx11            in a window\n"
    "  cbc graph quadrotor.yaml -o quadrotor.svg       or .png, .pdf, .mmd, .json, .dot\n"
    "  cbc graph quadrotor.yaml --task HOVER --down    what HOVER requires\n"
    "  cbc graph quadrotor.yaml --view tasks --reduce  which task requires which\n"
    "  cbc graph quadrotor.cbc --view constraints      what hangs together\n"
    "  cbc graph quadrotor.yaml --format mermaid       for a README file, a pull request\n"
    "  cbc graph --diff old.yaml new.yaml --format text   what has changed\n"
    "\n"
    "Tasks are ellipses, behaviors are rectangles. A solid line says which behavior performs a\n"
    "task, and how well; a dashed arrow what it requires, and the minimum performance; a dotted\n"
    "line that tasks exclude one another. A catalog with errors is drawn as far as it is\n"
    "understood, with the faults in red. svg, png and pdf need Graphviz.\n"
    "\n"
    "With --diff, what is new is green (+), what is gone red and dashed (-), what has changed\n"
    "orange. In the format text a line says what; json is for programs (schema cbc.diff/1).\n"
    "\n"
    "Exit status: 0 all is well, or the catalog has errors but was drawn, 1 the catalogs of\n"
    "--diff differ, 2 nothing could be drawn, a file could not be read or written, or the usage\n"
    "is wrong, 3 an internal error.";

struct GraphCommand {
  std::vector<std::string> catalogs;
  bool is_diff = false;
  std::optional<std::string> output;
  std::string format;
  DrawingOptions drawing;
};

/// The format that the suffix of the output names.
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
  const std::string suffix = std::filesystem::path(command.output.value_or("")).extension();
  for (const auto& [known, format] : formats) {
    if (suffix == known) return std::string(format);
  }
  return "dot";
}

bool is_binary(std::string_view format) { return format == "png" || format == "pdf"; }

/// What is wrong with the combination of options; empty if nothing is.
std::string find_misuse(const GraphCommand& command) {
  const std::string format = format_of(command);
  const std::size_t catalogs = command.catalogs.size();
  if (command.output == "") return "expected the name of a file after -o";
  if (command.is_diff && catalogs != 2) {
    return fmt::format("expected two catalogs to compare, found {}", catalogs);
  }
  if (!command.is_diff && catalogs != 1) {
    return fmt::format("expected one catalog, found {}; two can be compared with --diff", catalogs);
  }
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
  return find_misuse(command.drawing);
}

/// What can be drawn of a catalog, and what it was made of.
struct Drawable {
  CompiledCatalog compiled;  ///< of a catalog without errors
  CatalogReading reading;    ///< of another one
  draw::CatalogGraph graph;
};

std::unique_ptr<Drawable> from_compiled(CompiledCatalog catalog) {
  auto drawable = std::make_unique<Drawable>();
  drawable->compiled = std::move(catalog);
  drawable->graph = draw::to_graph(drawable->compiled);
  return drawable;
}

bool has_errors(const std::vector<Diagnostic>& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const Diagnostic& finding) { return finding.severity == Severity::error; });
}

/// Null if nothing can be drawn.
std::unique_ptr<Drawable> from_text(InputFiles& files, const InputFile& file) {
  Diagnostics diagnostics;
  CatalogReading reading = understand_catalog(*file.document, diagnostics);
  if (files.take_findings(file.path, *file.document, std::move(diagnostics))) {
    return from_compiled(compile(reading.catalog));
  }
  // Without an error it is the settings that could not be read.
  if (!has_errors(files.findings())) return nullptr;
  auto drawable = std::make_unique<Drawable>();
  drawable->reading = std::move(reading);
  drawable->graph = draw::to_graph(drawable->reading, files.findings());
  const draw::CatalogGraph& graph = drawable->graph;
  if (graph.tasks.empty() && graph.behaviors.empty()) return nullptr;
  return drawable;
}

/// Prints what is wrong with it. Null if nothing can be drawn.
std::unique_ptr<Drawable> read(const std::string& path) {
  InputFiles files;
  std::unique_ptr<Drawable> drawable;
  if (const std::optional<InputFile> file = files.read(path)) {
    if (file->document != nullptr) {
      drawable = from_text(files, *file);
    } else if (std::optional<CompiledFile> compiled = load(file->compiled)) {
      drawable = from_compiled(std::move(compiled->catalog));
    }
  }
  files.print_findings();
  return drawable;
}

/// The diagram in the format. Empty if it could not be made, which is complained of.
std::optional<std::string> write(const draw::Diagram& diagram, const std::string& format) {
  if (format == "json") return graph_json(diagram);
  if (format == "mermaid") return graph_mermaid(diagram);
  std::string dot = graph_dot(diagram);
  if (format == "dot") return dot;
  return run_graphviz(dot, format);
}

int deliver(const std::optional<std::string>& output, const std::string& content) {
  if (!output || *output == "-") {
    std::fwrite(content.data(), 1, content.size(), stdout);
    return exit_ok;
  }
  if (const auto error = write_atomically(*output, content)) {
    complain(fmt::format("cannot write {}: {}", quote(*output), *error));
    return exit_unusable;
  }
  return exit_ok;
}

bool is_to_stdout(const GraphCommand& command) { return !command.output || *command.output == "-"; }

/// Whether the output can be written where it shall be. If not, this is complained of.
bool can_write(const GraphCommand& command) {
  const std::string format = format_of(command);
  if (is_to_stdout(command)) {
    if (!is_binary(format) || isatty(STDOUT_FILENO) == 0) return true;
    complain(fmt::format("{} is not written to a terminal; expected -o OUT or a pipe", format));
    return false;
  }
  for (const std::string& catalog : command.catalogs) {
    std::error_code ignored;
    if (!std::filesystem::equivalent(catalog, *command.output, ignored)) continue;
    usage_error("graph",
                fmt::format("the output {} is the catalog itself", quote(*command.output)));
    return false;
  }
  return true;
}

int draw(const draw::CatalogGraph& graph, const GraphCommand& command) {
  const std::optional<draw::Part> part = find_part(graph, command.drawing);
  if (!part) return exit_unusable;
  draw::Diagram diagram = make_diagram(graph, *part, view_options(command.drawing));
  if (command.drawing.legend) add_legend(diagram);
  const std::optional<std::string> content = write(diagram, format_of(command));
  return content ? deliver(command.output, *content) : exit_unusable;
}

int draw_catalog(const GraphCommand& command) {
  const std::unique_ptr<Drawable> drawable = read(command.catalogs.front());
  return drawable == nullptr ? exit_unusable : draw(drawable->graph, command);
}

int show_diff(const ComparedCatalogs& compared, const GraphCommand& command) {
  const CatalogDiff& diff = compared.diff;
  const std::string format = format_of(command);
  if (format == "text") {
    const Style style = is_to_stdout(command) ? style_for(stdout) : plain_style();
    return deliver(command.output, diff_text(diff, style));
  }
  if (format == "json") {
    return deliver(command.output, diff_json(diff, compared.before->file, compared.after->file));
  }
  if (diff.further_exclusions > 0) {
    complain(fmt::format("{} further differences of exclusions are not marked",
                         diff.further_exclusions));
  }
  return draw(compared.graph, command);
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
  command->footer(graph_footer);
  command
      ->add_option("CATALOG", options->catalogs,
                   "The catalog: YAML or a compiled one, or - for standard input;\n"
                   "with --diff two of them, the older one first")
      ->option_text(" ")
      ->required();
  command->add_flag("--diff", options->is_diff,
                    "Show what two catalogs do not have in common, whatever their order\n"
                    "and layout; exit status 1 if there is anything");
  command
      ->add_option("-o,--output", options->output,
                   "The file to write, or - for standard output (default)")
      ->option_text("OUT");
  command
      ->add_option("--format", options->format,
                   "dot, mermaid, json, svg, png or pdf, with --diff also text (default:\n"
                   "by the suffix of OUT, else dot)")
      ->option_text("FORMAT")
      ->check(CLI::IsMember({"dot", "mermaid", "json", "svg", "png", "pdf", "text"}));
  add_drawing_options(*command, options->drawing);
  command->callback([options, &status] { status = run_graph(*options); });
}

}  // namespace cbc::cli
