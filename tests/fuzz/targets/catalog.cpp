#include <string>

#include "compile/catalog_dump.h"
#include "core/compile/compile.h"
#include "core/diagnostic/rules.h"
#include "fuzz/catalogs.h"
#include "fuzz/lint.h"
#include "fuzz/target.h"
#include "graph/engine/catalog_graph.h"
#include "graph/engine/diagram.h"
#include "graph/report/graph_report.h"
#include "runtime/compiled/compiled_file.h"
#include "support/exercise.h"

// A catalog in YAML, as `cbc lint --fix`, `cbc compile --dump` and `cbc graph` take it.
namespace cbc::fuzz {
namespace {

void draw(const CompiledCatalog& catalog) {
  const draw::CatalogGraph graph = draw::to_graph(catalog);
  draw::Diagram diagram = draw::make_diagram(graph, draw::whole(graph), {});
  draw::add_legend(diagram);
  require(!graph_dot(diagram).empty() && !graph_mermaid(diagram).empty() &&
              !graph_json(diagram).empty(),
          "a picture is empty");
}

/// The file of the catalog says the same as the catalog, and the checker accepts all answers.
void compile_and_run(const CompiledCatalog& catalog) {
  const std::string bytes = write_compiled(catalog, {});
  const CompiledFileResult result = read_compiled(bytes);
  if (!result.file) fail("the compiled catalog is refused: " + result.error);
  require(write_compiled(result.file->catalog, {}) == bytes, "the compiled catalog has changed");
  require(!catalog_json(*result.file).empty(), "the dump is empty");
  if (const auto refusal = test::exercise(result.file->catalog)) fail(*refusal);
}

void run(const std::string& input) {
  const SeveritySettings settings;
  const LintedCatalog linted = lint(input, settings);
  report(linted.file);
  fix(linted, settings);
  if (!linted.compiled) return;
  draw(*linted.compiled);
  if (linted.errors == 0) compile_and_run(*linted.compiled);
}

}  // namespace

Target catalog_target() {
  return {"catalog",      "a catalog in YAML: lint, fixes, pictures, compilation, events",
          Language::yaml, 0,
          4096,           run,
          catalog_texts};
}

}  // namespace cbc::fuzz
