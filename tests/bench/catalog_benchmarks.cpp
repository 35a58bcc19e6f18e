#include <array>
#include <cstdio>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include "bench/benchmarks.h"
#include "bench/catalog_generator.h"
#include "support/read_file.h"
#include "support/shared_folder.h"

namespace cbc::bench {
namespace {

/// With this seed every start of a task of level 0 has a solution.
constexpr std::uint64_t seed = 67;

/// Artificial catalogs 1 to 3 of the paper, and larger ones. The published files are named after
/// the five numbers.
constexpr std::array<CatalogShape, 6> shapes{{{3, 2, 2, 3, 0, seed},
                                              {4, 3, 2, 3, 2, seed},
                                              {6, 3, 2, 3, 3, seed},
                                              {6, 3, 3, 3, 3, seed},
                                              {9, 3, 2, 3, 3, seed},
                                              {9, 3, 3, 3, 3, seed}}};

void register_table_row(const std::string& name,
                        const std::shared_ptr<const CompiledCatalog>& catalog,
                        std::string_view task) {
  const std::shared_ptr<const Mission> mission = mission_of_start(catalog, task);
  for (const std::uint64_t m : {1U, 5U, 0U}) {
    register_event(fmt::format("table2/{}/{}", name, name_of_m(m)), plan(mission, m), 0);
  }
}

void register_starts(const std::string& name,
                     const std::shared_ptr<const CompiledCatalog>& catalog) {
  for (const std::string_view task : catalog->task_names) {
    if (task.rfind("task0_", 0) != 0) continue;
    register_event(fmt::format("optimum/{}/{}", name, task),
                   plan(mission_of_start(catalog, task), 0), 0);
  }
}

}  // namespace

void register_catalog_benchmarks() {
  const std::filesystem::path folder = test::shared_catalogs();
  const bool has_published = std::filesystem::is_directory(folder);
  if (!has_published) {
    fmt::print(stderr, "No folder {} (CBC_SHARED): generated catalogs instead of published ones.\n",
               folder.string());
  }
  const std::string reference =
      has_published ? folder / "behavior_catalog.yaml" : CBC_SOURCE_DIR "/catalogs/quadrotor.yaml";
  register_table_row("reference", compile_text(test::read_file(reference), reference),
                     "FOLLOW_PATH");
  for (const CatalogShape& shape : shapes) {
    const std::string name =
        fmt::format("{}{}{}{}{}{}", has_published ? "creator" : "generated", shape.tasks,
                    shape.behaviors, shape.requirements, shape.levels, shape.exclusions);
    const std::string text =
        has_published ? test::read_file(folder / (name + ".yaml")) : generate_catalog(shape);
    const std::shared_ptr<const CompiledCatalog> catalog = compile_text(text, name);
    register_table_row(name, catalog, "task0_0");
    register_starts(name, catalog);
  }
}

}  // namespace cbc::bench
