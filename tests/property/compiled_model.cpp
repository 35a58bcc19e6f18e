#include "compiled_model.h"

#include <exception>
#include <optional>
#include <string>

#include "compiled_text.h"
#include "demand.h"
#include "lint_generator.h"
#include "yaml_text.h"

namespace cbc::oracle {

void run_situation_case(
    std::uint64_t seed, Results& results, bool lists_all_tasks,
    const std::function<void(const Catalog&, const CompiledCatalog&, Random&)>& check) {
  Random random(seed);
  Catalog catalog = generate_strict_catalog(random);
  add_situation(catalog, random);
  if (lists_all_tasks) {
    for (Task& task : catalog.tasks) task.listed = true;
  }
  const std::string yaml = catalog_yaml(catalog, random);
  try {
    const std::optional<CompiledCatalog> compiled = compile_yaml(yaml);
    demand(compiled.has_value(), "not understood");
    check(catalog, *compiled, random);
  } catch (const std::exception& error) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n--- catalog\n" + yaml +
                                        "--- fault\n" + error.what() + "\n"});
  }
}

}  // namespace cbc::oracle
