#include "bench/inputs.h"

#include <optional>
#include <stdexcept>
#include <utility>

#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "core/diagnostic/diagnostic.h"
#include "core/script/reader.h"
#include "core/yaml/document.h"
#include "support/read_file.h"

namespace cbc::bench {
namespace {

Script understand_script(const std::string& path, const CompiledCatalog& catalog) {
  Diagnostics diagnostics;
  const std::string text = test::read_file(path);
  const auto document = yaml::parse(text, path, diagnostics);
  if (document == nullptr) refuse(diagnostics);
  std::optional<Script> script = read_script(*document, catalog, Severity::warning, diagnostics);
  if (!script) refuse(diagnostics);
  return std::move(*script);
}

}  // namespace

void refuse(const Diagnostics& diagnostics) {
  std::string message = "unusable input:\n";
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    message += render(diagnostic, SourceTexts(), plain_style());
  }
  throw std::runtime_error(message);
}

std::shared_ptr<const CompiledCatalog> compile_text(std::string_view text,
                                                    const std::string& name) {
  Diagnostics diagnostics;
  const std::optional<Catalog> catalog = read_catalog(text, name, diagnostics);
  if (!catalog) refuse(diagnostics);
  return std::make_shared<const CompiledCatalog>(compile(*catalog));
}

std::shared_ptr<const Mission> load_mission(const std::string& name) {
  const std::string stem = CBC_SOURCE_DIR "/catalogs/" + name;
  auto mission = std::make_shared<Mission>();
  mission->catalog = compile_text(test::read_file(stem + ".yaml"), name);
  mission->script = understand_script(stem + ".mission.yaml", *mission->catalog);
  return mission;
}

std::shared_ptr<const Mission> mission_of_start(std::shared_ptr<const CompiledCatalog> catalog,
                                                std::string_view task) {
  const auto place = catalog->find_task(task);
  if (!place) throw std::runtime_error("no task " + std::string(task));
  Step step;
  step.verb = Verb::start;
  step.subject = *place;
  auto mission = std::make_shared<Mission>();
  mission->catalog = std::move(catalog);
  mission->script.steps.push_back(std::move(step));
  return mission;
}

}  // namespace cbc::bench
