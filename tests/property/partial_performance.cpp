#include "partial_performance.h"

#include <vector>

#include "demand.h"

namespace cbc::oracle {

bool reaches_with_what_runs(const CatalogFacts& facts, const Assignment& values, std::size_t task,
                            Millionths minimum) {
  std::vector<std::size_t> running = {task};
  for (std::size_t i = 0; i < running.size(); ++i) {
    for (const Requirement& requirement :
         facts.catalog.behaviors[values[running[i]]].requirements) {
      if (values[requirement.task] != none && !contains(running, requirement.task)) {
        running.push_back(requirement.task);
      }
    }
  }
  Integer product = 1;
  for (const std::size_t required : running) {
    product *= facts.suitability(values[required], required);
  }
  return product >= power_of_million(running.size() - 1) * minimum;
}

}  // namespace cbc::oracle
