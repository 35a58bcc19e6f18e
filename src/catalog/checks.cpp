#include "catalog/checks.h"

#include <cstddef>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "catalog/cycles.h"
#include "catalog/describe.h"
#include "catalog/exclusions.h"
#include "cbc/rules.h"
#include "text/quote.h"

namespace cbc {
namespace {

// Longer cycles are shown by their beginning.
constexpr std::size_t longest_chain = 10;

}  // namespace

void check_requirement_cycles(const Catalog& catalog, Reporter& reporter) {
  for (const Cycle& cycle : find_requirement_cycles(catalog)) {
    std::string chain;
    std::vector<Note> notes;
    for (const CycleStep& step : cycle) {
      const Behavior& behavior = catalog.behaviors[step.behavior];
      const Requirement& requirement = behavior.requirements[step.requirement];
      const std::string task = quote(catalog.tasks[step.task].name);
      if (notes.size() < longest_chain) chain += task + " -> ";
      notes.push_back(reporter.note(
          requirement.range, describe(behavior) + ", which performs " + task + ", requires " +
                                 quote(catalog.tasks[requirement.task].name)));
    }
    if (cycle.size() > longest_chain) chain += "... -> ";
    chain += quote(catalog.tasks[cycle.front().task].name);
    const Range place = notes.front().range;
    reporter.report(rule::requirement_cycle, place, "tasks require one another: " + chain,
                    std::move(notes));
  }
}

void check_exclusive_requirements(const Catalog& catalog, Reporter& reporter) {
  Exclusions exclusions(catalog);
  std::unordered_set<TaskIndex> reported;
  for (const Behavior& behavior : catalog.behaviors) {
    if (behavior.performs.empty()) continue;
    reported.clear();
    for (const Requirement& requirement : behavior.requirements) {
      const auto list = exclusions.find_for_all(behavior, requirement.task);
      if (!list || !reported.insert(requirement.task).second) continue;
      const std::string own =
          behavior.performs.size() == 1
              ? quote(catalog.tasks[behavior.performs.front().task].name) + ", the task it performs"
              : std::string("every task it performs");
      reporter.report(
          rule::exclusive_requirement, requirement.range,
          describe(behavior) + " requires " + quote(catalog.tasks[requirement.task].name) +
              ", which excludes " + own,
          {reporter.note(catalog.exclusivity[*list].range, "mutually exclusive by this list")});
    }
  }
}

}  // namespace cbc
