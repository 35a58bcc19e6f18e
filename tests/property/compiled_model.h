// A model and the catalog that was compiled of it: the same things by their names, and random cases
// of both.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "model.h"
#include "random.h"
#include "random_cases.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc::oracle {

// What the model calls by its places, in the compiled catalog.
class CompiledModel {
 public:
  CompiledModel(const Catalog& catalog, const CompiledCatalog& compiled)
      : catalog_(catalog), compiled_(compiled) {}

  TaskId id_of_task(std::size_t task) const {
    return compiled_.task_ids[*compiled_.find_task(catalog_.tasks[task].name)];
  }
  BehaviorId id_of_behavior(std::size_t behavior) const {
    return compiled_.behavior_ids[*compiled_.find_behavior(catalog_.behaviors[behavior].name)];
  }
  VariableValue id_of_value(std::size_t variable, std::size_t value) const {
    return {*compiled_.find_variable(catalog_.variables[variable].name),
            static_cast<std::uint32_t>(value)};
  }

 protected:
  const Catalog& catalog_;
  const CompiledCatalog& compiled_;
};

// Checks a strict catalog with situation variables, drawn with the seed; a fault has its text.
// `lists_all_tasks`: those that are not listed come last in a catalog, and order decides between
// equal answers.
void run_situation_case(
    std::uint64_t seed, Results& results, bool lists_all_tasks,
    const std::function<void(const Catalog&, const CompiledCatalog&, Random&)>& check);

}  // namespace cbc::oracle
