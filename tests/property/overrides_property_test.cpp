// Random catalogs: what becomes of two requests must be what the oracle makes of them, one after
// the other. CBC_SEED and CBC_PROPERTY_CASES are as in lint_property_test.cpp.
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "compiled_model.h"
#include "demand.h"
#include "enumeration.h"
#include "oracle.h"
#include "random.h"
#include "random_cases.h"
#include "runtime/compiled/compiled_catalog.h"
#include "statistics.h"
#include "verify/engine/overrides.h"

namespace cbc::oracle::overrides_property_test {
namespace {

constexpr std::uint64_t default_cases = 300;

class Check : private CompiledModel {
 public:
  Check(const Catalog& catalog, const CompiledCatalog& compiled, Random& random,
        Statistics& statistics)
      : CompiledModel(catalog, compiled),
        facts_(std::make_shared<const CatalogFacts>(catalog)),
        random_(random),
        statistics_(statistics) {}

  void check() {
    draw_situation();
    std::vector<std::size_t> tasks;
    std::vector<TaskId> ids;
    for (std::size_t task = 0; task < catalog_.tasks.size(); ++task) {
      if (!random_.percent(70)) continue;
      tasks.push_back(task);
      ids.push_back(id_of_task(task));
    }
    const OverrideMatrix matrix = find_overrides(compiled_, ids, given_, {});
    demand(matrix.complete && matrix.error.empty(), "not complete");
    for (std::size_t row = 0; row < tasks.size(); ++row) {
      for (std::size_t column = 0; column < tasks.size(); ++column) {
        // All pairs would take long.
        if (row == column || random_.percent(60)) continue;
        for (std::size_t place = 0; place < priorities_of_second; ++place) {
          constexpr std::array<int, priorities_of_second> priorities{2, 3, 1};
          compare(matrix.at(row, column)[place], tasks[row], tasks[column], priorities[place]);
        }
      }
    }
  }

 private:
  void draw_situation() {
    for (std::size_t variable = 0; variable < catalog_.variables.size(); ++variable) {
      const std::size_t value = random_.below(catalog_.variables[variable].value_count());
      script_.situation.variables.emplace_back(variable, value);
      given_.variables.push_back({*compiled_.find_variable(catalog_.variables[variable].name),
                                  static_cast<std::uint32_t>(value)});
    }
    for (std::size_t behavior = 0; behavior < catalog_.behaviors.size(); ++behavior) {
      if (!random_.percent(5)) continue;
      script_.situation.own.emplace_back(behavior, false);
      given_.behaviors.push_back({id_of_behavior(behavior), false});
    }
  }

  static Event start(std::size_t task, int priority) {
    Event event;
    event.verb = Verb::start;
    event.subject = task;
    event.priority = priority;
    return event;
  }

  /// With which a task runs if it alone is requested.
  std::size_t alone(std::size_t task) const {
    Oracle oracle(facts_, script_, nullptr);
    oracle.handle(start(task, 1));
    return oracle.state().values[task];
  }

  bool is_worse(std::size_t task, std::size_t now, std::size_t before) const {
    return facts_->suitability(now, task) < facts_->suitability(before, task);
  }

  Override::Kind kind_of(std::size_t first, std::size_t second, int priority,
                         std::size_t& changes) const {
    const std::size_t first_alone = alone(first);
    const std::size_t second_alone = alone(second);
    if (first_alone == none) return Override::Kind::not_started;
    Oracle oracle(facts_, script_, nullptr);
    oracle.handle(start(first, 2));
    oracle.handle(start(second, priority));
    if (oracle.events().back().at("outcome") == "rejected") return Override::Kind::rejected;
    const Assignment& values = oracle.state().values;
    if (values[first] == none) return Override::Kind::stops;
    bool has_worse = false;
    for (const auto& [task, before] : {std::pair(first, first_alone), {second, second_alone}}) {
      if (before == none || values[task] == before) continue;
      ++changes;
      has_worse = has_worse || is_worse(task, values[task], before);
    }
    if (has_worse) return Override::Kind::worse;
    return changes > 0 ? Override::Kind::other : Override::Kind::both;
  }

  void compare(const Override& found, std::size_t first, std::size_t second, int priority) {
    std::size_t changes = 0;
    const Override::Kind expected = kind_of(first, second, priority, changes);
    const std::string where = catalog_.tasks[first].name + ", then " + catalog_.tasks[second].name +
                              " with " + std::to_string(priority);
    demand(found.kind == expected, where + ": expected " + std::string(name_of(expected)) +
                                       ", found " + std::string(name_of(found.kind)));
    demand(found.changes.size() == changes, where + ": other changes");
    for (const Override::Change& change : found.changes) {
      const std::size_t task = change.task == id_of_task(first) ? first : second;
      demand(change.task == id_of_task(task), where + ": a change of another task");
      demand(change.alone == id_of_behavior(alone(task)), where + ": another behavior before");
    }
    statistics_.count(std::string(name_of(found.kind)));
  }

  const std::shared_ptr<const CatalogFacts> facts_;
  Random& random_;
  Statistics& statistics_;
  Script script_;
  SituationPart given_;
};

void run_case(std::uint64_t seed, Results& results) {
  run_situation_case(seed, results, true,
                     [&](const Catalog& catalog, const CompiledCatalog& compiled, Random& random) {
                       Check(catalog, compiled, random, results.statistics).check();
                     });
}

const LowerBound lower_bounds[] = {
    {"both", 1000}, {"other", 5},      {"worse", 10},
    {"stops", 500}, {"rejected", 500}, {"not_started", 500},
};

TEST(Overrides, AreThoseOfTheOracle) { run_random_cases(default_cases, run_case, lower_bounds); }

}  // namespace
}  // namespace cbc::oracle::overrides_property_test
