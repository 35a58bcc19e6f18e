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
#include "cli/graph_options.h"
#include "cli/graphviz.h"
#include "cli/input.h"
#include "cli/input_files.h"
#include "compiled/compile.h"
#include "draw/catalog_graph.h"
#include "draw/view.h"
#include "file/atomic_file.h"
#include "report/graph_dot.h"
#include "report/graph_json.h"
#include "report/graph_mermaid.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

constexpr const char* footer =
    "Examples:\n"
    "  cbc graph quadrotor.yaml | dot -Tx11            in a window\n"
    "  cbc graph quadrotor.yaml -o quadrotor.svg       or .png, .pdf, .mmd, .json, .dot\n"
    "  cbc graph quadrotor.yaml --task HOVER --down    what HOVER requires\n"
    "  cbc graph quadrotor.yaml --view tasks --reduce  which task requires which\n"
    "  cbc graph quadrotor.cbc --view constraints      what hangs together\n"
    "  cbc graph quadrotor.yaml --format mermaid       for a README file, a pull request\n"
    "\n"
    "Tasks are ellipses, behaviors are rectangles. A solid line says which behavior performs a\n"
    "task, and how well; a dashed arrow what it requires, and the minimum performance; a dotted\n"
    "line that tasks exclude one another. A catalog with errors is drawn as far as it is\n"
    "understood, with the faults in red. svg, png and pdf need Graphviz.\n"
    "\n"
    "Exit status: 0 all is well, or the catalog has errors but was drawn, 2 nothing could be\n"
    "drawn, a file could not be read or written, or the usage is wrong, 3 an internal error.";

struct GraphCommand {
  std::string catalog;
  std::optional<std::string> output;
  std::string format;
  DrawingOptions drawing;
};

int usage_error(const std::string& message) {
  complain(message + "\nSee 'cbc graph --help'.");
  return exit_unusable;
}

/// The format that the suffix of the output names.
std::string format_of(const GraphCommand& command) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 8> formats = {
      {{".dot", "dot"},
       {".gv", "dot"},
       {".mmd", "mermaid"},
       {".mermaid", "mermaid"},
       {".json", "json"},
       {".svg", "svg"},
       {".png", "png"},
       {".pdf", "pdf"}}};
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
  if (command.output == "") return "expected the name of a file after -o";
  if (command.drawing.legend && format_of(command) == "json") {
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

int run_graph(const GraphCommand& command) {
  if (const std::string misuse = find_misuse(command); !misuse.empty()) return usage_error(misuse);
  const std::string format = format_of(command);
  const bool is_to_stdout = !command.output || *command.output == "-";
  if (is_binary(format) && is_to_stdout && isatty(STDOUT_FILENO) != 0) {
    complain(fmt::format("{} is not written to a terminal; expected -o OUT or a pipe", format));
    return exit_unusable;
  }
  std::error_code ignored;
  if (!is_to_stdout && std::filesystem::equivalent(command.catalog, *command.output, ignored)) {
    return usage_error(fmt::format("the output {} is the catalog itself", quote(*command.output)));
  }
  const std::unique_ptr<Drawable> drawable = read(command.catalog);
  if (drawable == nullptr) return exit_unusable;
  const std::optional<draw::Part> part = find_part(drawable->graph, command.drawing);
  if (!part) return exit_unusable;
  draw::Diagram diagram = make_diagram(drawable->graph, *part, view_options(command.drawing));
  if (command.drawing.legend) add_legend(diagram);
  const std::optional<std::string> content = write(diagram, format);
  return content ? deliver(command.output, *content) : exit_unusable;
}

}  // namespace

void add_graph_command(CLI::App& program, int& status) {
  const auto options = std::make_shared<GraphCommand>();
  CLI::App* const command =
      program.add_subcommand("graph", "Draws the tasks and behaviors of a catalog.");
  command->footer(footer);
  command
      ->add_option("CATALOG", options->catalog,
                   "The catalog: YAML or a compiled one, or - for standard input")
      ->option_text(" ")
      ->required();
  command
      ->add_option("-o,--output", options->output,
                   "The file to write, or - for standard output (default)")
      ->option_text("OUT");
  command
      ->add_option("--format", options->format,
                   "dot, mermaid, json, svg, png or pdf (default: by the suffix of\n"
                   "OUT, else dot)")
      ->option_text("FORMAT")
      ->check(CLI::IsMember({"dot", "mermaid", "json", "svg", "png", "pdf"}));
  add_drawing_options(*command, options->drawing);
  command->callback([options, &status] { status = run_graph(*options); });
}

}  // namespace cbc::cli
