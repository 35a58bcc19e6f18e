#include "catalog_changes.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "demand.h"

namespace cbc::plain {

using oracle::Catalog;
using oracle::Millionths;
using oracle::Random;

namespace {

Millionths another_degree(Random& random, Millionths degree) {
  static const std::vector<Millionths> degrees = {0,       250'000, 500'000, 720'000,
                                                  800'000, 900'000, 999'999, 1'000'000};
  const Millionths other =
      random.percent(30)
          ? std::clamp<Millionths>(degree + (random.percent(50) ? 1 : -1), 0, oracle::whole_degree)
          : random.pick(degrees);
  return other != degree ? other : oracle::whole_degree - degree / 2;
}

bool change_suitability(Catalog& catalog, Random& random) {
  auto& performed = catalog.behaviors[random.below(catalog.behaviors.size())].performs;
  Millionths& suitability = performed[random.below(performed.size())].suitability;
  suitability = another_degree(random, suitability);
  return true;
}

bool change_required_minimum(Catalog& catalog, Random& random) {
  auto& required = catalog.behaviors[random.below(catalog.behaviors.size())].requirements;
  if (required.empty()) return false;
  Millionths& minimum = required[random.below(required.size())].minimum;
  minimum = another_degree(random, minimum);
  return true;
}

bool change_task_minimum(Catalog& catalog, Random& random) {
  oracle::Task& task = catalog.tasks[random.below(catalog.tasks.size())];
  task.minimum = another_degree(random, task.minimum);
  return task.listed;
}

bool change_exclusivity(Catalog& catalog, Random& random) {
  auto& lists = catalog.exclusivity;
  if (!lists.empty() && random.percent(50)) {
    lists.erase(lists.begin() + static_cast<std::ptrdiff_t>(random.below(lists.size())));
    return true;
  }
  const std::size_t a = random.below(catalog.tasks.size());
  const std::size_t b = random.below(catalog.tasks.size());
  lists.push_back({a, b});
  return a != b;
}

bool change_requirement(Catalog& catalog, Random& random) {
  auto& required = catalog.behaviors[random.below(catalog.behaviors.size())].requirements;
  if (!required.empty() && random.percent(60)) {
    required.erase(required.begin() + static_cast<std::ptrdiff_t>(random.below(required.size())));
    return true;
  }
  const std::size_t task = random.below(catalog.tasks.size());
  for (const oracle::Requirement& one : required) {
    if (one.task == task) return false;
  }
  required.push_back({task, 0});
  return true;
}

bool change_start_on_request(Catalog& catalog, Random& random) {
  oracle::Task& task = catalog.tasks[random.below(catalog.tasks.size())];
  task.start_on_request = !task.start_on_request;
  if (task.start_on_request) task.reactive_start = false;
  return task.listed;
}

bool change_reactive_start(Catalog& catalog, Random& random) {
  oracle::Task& task = catalog.tasks[random.below(catalog.tasks.size())];
  task.reactive_start = !task.reactive_start;
  return task.listed && !task.start_on_request;
}

bool change_goal(Catalog& catalog, Random& random) {
  oracle::Task& task = catalog.tasks[random.below(catalog.tasks.size())];
  task.keep_running = !task.keep_running;
  return task.listed;
}

bool change_situation(Catalog& catalog, Random& random) {
  if (catalog.variables.empty()) return false;
  auto& conditions = catalog.behaviors[random.below(catalog.behaviors.size())].situation;
  if (!conditions.empty() && random.percent(60)) {
    conditions.erase(conditions.begin() +
                     static_cast<std::ptrdiff_t>(random.below(conditions.size())));
    return true;
  }
  const std::size_t variable = random.below(catalog.variables.size());
  for (const oracle::Condition& one : conditions) {
    if (one.variable == variable) return false;
  }
  conditions.push_back({variable, {random.below(catalog.variables[variable].value_count())}});
  return true;
}

bool change_initial_value(Catalog& catalog, Random& random) {
  if (catalog.variables.empty()) return false;
  const std::size_t variable = random.below(catalog.variables.size());
  std::vector<std::string>& values = catalog.variables[variable].values;
  if (values.empty()) return false;
  std::rotate(values.begin(), values.begin() + 1, values.end());
  for (oracle::Behavior& behavior : catalog.behaviors) {
    for (oracle::Condition& condition : behavior.situation) {
      if (condition.variable != variable) continue;
      for (std::size_t& value : condition.values) {
        value = (value + values.size() - 1) % values.size();
      }
    }
  }
  return true;
}

bool change_name(Catalog& catalog, Random& random) {
  switch (random.below(3)) {
    case 0:
      catalog.tasks[random.below(catalog.tasks.size())].name += "_new";
      return true;
    case 1:
      catalog.behaviors[random.below(catalog.behaviors.size())].name += "_new";
      return true;
    default:
      if (catalog.variables.empty()) return false;
      oracle::Variable& variable = catalog.variables[random.below(catalog.variables.size())];
      if (!variable.values.empty() && random.percent(50)) {
        variable.values[random.below(variable.values.size())] += "_new";
      } else {
        variable.name += "_new";
      }
      return true;
  }
}

bool remove_behavior(Catalog& catalog, Random& random) {
  if (catalog.behaviors.size() < 2) return false;
  catalog.behaviors.erase(catalog.behaviors.begin() +
                          static_cast<std::ptrdiff_t>(random.below(catalog.behaviors.size())));
  // An unlisted task that no behavior names would be gone.
  for (oracle::Task& task : catalog.tasks) task.listed = true;
  return true;
}

bool change_order(Catalog& catalog, Random& random) {
  if (catalog.behaviors.size() < 2) return false;
  for (oracle::Task& task : catalog.tasks) task.listed = true;
  const std::size_t place = random.below(catalog.behaviors.size() - 1);
  std::swap(catalog.behaviors[place], catalog.behaviors[place + 1]);
  return true;
}

struct Kind {
  const char* name;
  bool (*change)(Catalog&, Random&);
};

constexpr Kind kinds[] = {
    {"suitability", change_suitability},
    {"minimum of a requirement", change_required_minimum},
    {"minimum of a task", change_task_minimum},
    {"exclusivity", change_exclusivity},
    {"requirement", change_requirement},
    {"start_on_request", change_start_on_request},
    {"reactive_start", change_reactive_start},
    {"execution_goal", change_goal},
    // More often: only few of these leave a variable to one of the two catalogs.
    {"situation", change_situation},
    {"situation", change_situation},
    {"situation", change_situation},
    {"situation", change_situation},
    {"initial value", change_initial_value},
    // More often: most new names are also given as renames, and then little differs.
    {"name", change_name},
    {"name", change_name},
    {"behavior removed", remove_behavior},
    {"order of behaviors", change_order},
};

}  // namespace

Catalog rewrite(Catalog catalog, Random& random) {
  catalog.defaults = {};
  for (oracle::Task& task : catalog.tasks) task.listed = true;
  std::vector<std::vector<std::size_t>> lists;
  for (std::vector<std::size_t> list : catalog.exclusivity) {
    random.shuffle(list);
    if (random.percent(30)) lists.push_back(list);
    for (std::size_t a = 0; a < list.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        if (list[a] != list[b]) lists.push_back({list[a], list[b]});
      }
    }
  }
  random.shuffle(lists);
  catalog.exclusivity = std::move(lists);
  for (oracle::Behavior& behavior : catalog.behaviors) {
    random.shuffle(behavior.performs);
    random.shuffle(behavior.requirements);
    random.shuffle(behavior.situation);
    for (oracle::Condition& condition : behavior.situation) random.shuffle(condition.values);
  }
  return catalog;
}

std::string change_one(Catalog& catalog, Random& random) {
  const Kind& kind = kinds[random.below(std::size(kinds))];
  if (catalog.behaviors.empty() || catalog.tasks.empty()) return {};
  return kind.change(catalog, random) ? kind.name : std::string();
}

void share_a_suitability(Catalog& catalog, Random& random) {
  if (random.percent(50)) return;
  const Millionths shared = random.between(1, oracle::whole_degree);
  catalog.defaults.suitability = shared;
  for (oracle::Behavior& behavior : catalog.behaviors) {
    for (oracle::Performance& performance : behavior.performs) {
      if (random.percent(60)) performance.suitability = shared;
    }
  }
}

bool remove_task(Catalog& catalog, Random& random) {
  if (catalog.tasks.size() < 2) return false;
  for (oracle::Task& task : catalog.tasks) task.listed = true;
  const std::size_t removed = random.below(catalog.tasks.size());
  const auto is_removed = [&](const auto& part) { return part.task == removed; };
  const auto close_gap = [&](std::size_t& task) {
    if (task > removed) --task;
  };
  catalog.tasks.erase(catalog.tasks.begin() + static_cast<std::ptrdiff_t>(removed));
  for (oracle::Behavior& behavior : catalog.behaviors) {
    std::erase_if(behavior.performs, is_removed);
    std::erase_if(behavior.requirements, is_removed);
    for (oracle::Performance& performance : behavior.performs) close_gap(performance.task);
    for (oracle::Requirement& requirement : behavior.requirements) close_gap(requirement.task);
  }
  std::erase_if(catalog.behaviors,
                [](const oracle::Behavior& behavior) { return behavior.performs.empty(); });
  for (auto& list : catalog.exclusivity) {
    std::erase(list, removed);
    for (std::size_t& task : list) close_gap(task);
  }
  return !catalog.behaviors.empty();
}

}  // namespace cbc::plain
