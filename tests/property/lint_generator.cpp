#include "lint_generator.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace cbc::oracle {
namespace {

constexpr std::size_t most_assignments = 1000;
constexpr std::size_t most_generated_constraints = 60;

std::vector<Millionths> pick_palette(Random& random) {
  static const std::vector<std::vector<Millionths>> palettes = {
      {1'000'000},
      {1'000'000, 900'000, 800'000, 720'000},
      {900'000, 800'000, 720'000, 640'000, 810'000},
      {500'000, 250'000, 1'000'000},
      {333'333, 666'667, 1'000'000},
      {999'999, 999'998, 1'000'000},
      {950'000, 700'000, 400'000, 0},
  };
  return random.pick(palettes);
}

// The tasks of a block require only those before them, and share behaviors and exclusivity lists
// with any of them.
class StrictGenerator {
 public:
  explicit StrictGenerator(Random& random) : random_(random), palette_(pick_palette(random)) {}

  Catalog generate() {
    const std::size_t blocks = random_.percent(30) ? 2 : 1;
    for (std::size_t i = 0; i < blocks; ++i) add_block(2 + random_.below(6));
    shuffle();
    return std::move(catalog_);
  }

 private:
  struct Block {
    std::size_t first = 0;
    std::size_t end = 0;
    std::size_t constraints = 0;
  };

  void add_block(std::size_t size) {
    Block block;
    block.first = catalog_.tasks.size();
    block.end = block.first + size;
    density_ = random_.below(4);
    avoids_plain_faults_ = random_.percent(65);
    for (std::size_t i = 0; i < size; ++i) add_task(block);
    add_exclusivity(block);
    for (std::size_t task = block.first; task < block.end; ++task) add_behaviors(block, task);
  }

  void add_task(Block& block) {
    Task task;
    task.start_on_request = random_.percent(40);
    task.keep_running = true;
    if (random_.percent(15)) {
      task.minimum = pick_minimum();
      ++block.constraints;
    }
    catalog_.tasks.push_back(task);
  }

  // Products of suitabilities are the minimums that are just reached, or just not.
  Millionths pick_minimum() {
    Millionths minimum = random_.pick(palette_);
    if (random_.percent(50)) minimum = minimum * random_.pick(palette_) / whole_degree;
    if (random_.percent(15)) minimum += 1;
    if (random_.percent(25)) minimum = random_.between(1, whole_degree);
    return std::clamp<Millionths>(minimum, 1, whole_degree);
  }

  void add_exclusivity(Block& block) {
    const std::size_t size = block.end - block.first;
    const std::size_t lists = random_.below(1 + size * density_ / 2 + 1);
    for (std::size_t i = 0; i < lists; ++i) {
      const std::size_t length = random_.percent(25) ? 3 : 2;
      std::vector<std::size_t> list;
      for (std::size_t j = 0; j < length; ++j) {
        const std::size_t task = block.first + random_.below(size);
        if (!contains(list, task)) list.push_back(task);
      }
      if (list.size() < 2) continue;
      block.constraints += list.size() * (list.size() - 1) / 2;
      catalog_.exclusivity.push_back(list);
    }
  }

  void add_behaviors(Block& block, std::size_t task) {
    static const std::vector<std::size_t> counts = {1, 1, 1, 1, 2, 2, 2, 3};
    const std::size_t count = random_.percent(4) ? 0 : random_.pick(counts);
    for (std::size_t i = 0; i < count; ++i) {
      Behavior behavior;
      behavior.performs.push_back({task, random_.pick(palette_)});
      if (random_.percent(22)) add_another_task(block, behavior);
      add_requirements(block, behavior);
      catalog_.behaviors.push_back(behavior);
      if (assignments(block) > most_assignments || block.constraints > most_generated_constraints) {
        catalog_.behaviors.pop_back();
        return;
      }
    }
  }

  // Any task will do that comes after all that the behavior will require.
  void add_another_task(const Block& block, Behavior& behavior) {
    const std::size_t first = behavior.performs.front().task;
    const std::size_t other = first + random_.below(block.end - first);
    if (other != first) behavior.performs.push_back({other, random_.pick(palette_)});
  }

  void add_requirements(Block& block, Behavior& behavior) {
    static const std::vector<std::size_t> counts = {0, 0, 1, 1, 1, 2, 2, 3};
    const std::size_t before = behavior.performs.front().task - block.first;
    const std::size_t count = before == 0 ? 0 : random_.pick(counts);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t task = block.first + random_.below(before);
      if (requires_task(behavior, task) && !random_.percent(20)) continue;
      if (avoids_plain_faults_ && is_plain_fault(behavior, task)) continue;
      add_requirement(block, behavior, task);
      if (random_.percent(15)) require_the_same(block, behavior, task);
    }
  }

  void add_requirement(Block& block, Behavior& behavior, std::size_t task) {
    behavior.requirements.push_back({task, random_.percent(35) ? pick_minimum() : 0});
    block.constraints += 2;
  }

  // Something that is needed for the task as well.
  void require_the_same(Block& block, Behavior& behavior, std::size_t task) {
    for (const Behavior& other : catalog_.behaviors) {
      if (other.performs.front().task != task || other.requirements.empty()) continue;
      const Requirement requirement = random_.pick(other.requirements);
      if (requires_task(behavior, requirement.task)) return;
      if (avoids_plain_faults_ && is_plain_fault(behavior, requirement.task)) return;
      behavior.requirements.push_back(requirement);
      block.constraints += 2;
      return;
    }
  }

  // A mistake that the behavior and the lists alone show.
  bool is_plain_fault(const Behavior& behavior, std::size_t task) const {
    return exclude(behavior.performs.front().task, task) ||
           std::any_of(behavior.requirements.begin(), behavior.requirements.end(),
                       [&](const Requirement& one) { return exclude(one.task, task); });
  }

  bool exclude(std::size_t a, std::size_t b) const {
    return a != b && std::any_of(catalog_.exclusivity.begin(), catalog_.exclusivity.end(),
                                 [&](const std::vector<std::size_t>& list) {
                                   return contains(list, a) && contains(list, b);
                                 });
  }

  static bool requires_task(const Behavior& behavior, std::size_t task) {
    return std::any_of(behavior.requirements.begin(), behavior.requirements.end(),
                       [task](const Requirement& one) { return one.task == task; });
  }

  static bool contains(const std::vector<std::size_t>& items, std::size_t item) {
    return std::find(items.begin(), items.end(), item) != items.end();
  }

  std::size_t assignments(const Block& block) const {
    std::vector<std::size_t> sizes(block.end - block.first, 1);
    for (const Behavior& behavior : catalog_.behaviors) {
      for (const Performance& performed : behavior.performs) {
        if (performed.task >= block.first) ++sizes[performed.task - block.first];
      }
    }
    std::size_t product = 1;
    for (const std::size_t size : sizes) product *= size;
    return product;
  }

  // A catalog does not fix the order of its sections. Tasks that only behaviors name start on
  // request and end, by default.
  void shuffle() {
    std::vector<std::size_t> order(catalog_.tasks.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    random_.shuffle(order);
    std::vector<Task> tasks(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) tasks[order[i]] = catalog_.tasks[i];
    catalog_.tasks = std::move(tasks);
    for (std::vector<std::size_t>& list : catalog_.exclusivity) {
      for (std::size_t& task : list) task = order[task];
    }
    random_.shuffle(catalog_.behaviors);
    std::vector<bool> has_behavior(order.size());
    for (Behavior& behavior : catalog_.behaviors) {
      for (Performance& performed : behavior.performs) {
        performed.task = order[performed.task];
        has_behavior[performed.task] = true;
      }
      for (Requirement& requirement : behavior.requirements) {
        requirement.task = order[requirement.task];
      }
      random_.shuffle(behavior.performs);
      behavior.name = "B" + std::to_string(&behavior - catalog_.behaviors.data());
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
      Task& task = catalog_.tasks[i];
      task.name = "T" + std::to_string(i);
      if (task.start_on_request && task.minimum == 0 && has_behavior[i] && random_.percent(15)) {
        task.listed = false;
        task.keep_running = false;
      }
    }
  }

  Random& random_;
  std::vector<Millionths> palette_;
  std::size_t density_ = 0;  // of exclusivity
  bool avoids_plain_faults_ = false;
  Catalog catalog_;
};

}  // namespace

Catalog generate_strict_catalog(Random& random) { return StrictGenerator(random).generate(); }

void add_situation(Catalog& catalog, Random& random) {
  const std::size_t count = random.below(4);
  for (std::size_t i = 0; i < count; ++i) {
    Variable variable{"V" + std::to_string(i), {}};
    if (random.percent(50)) variable.values = {"red", "green", "blue"};
    catalog.variables.push_back(variable);
  }
  for (Behavior& behavior : catalog.behaviors) {
    for (std::size_t variable = 0; variable < count; ++variable) {
      if (!random.percent(30)) continue;
      Condition condition{variable, {}};
      const std::size_t values = catalog.variables[variable].value_count();
      const std::size_t first = random.below(values);
      condition.values.push_back(first);
      if (values > 2 && random.percent(50)) condition.values.push_back((first + 1) % values);
      behavior.situation.push_back(condition);
    }
  }
}

}  // namespace cbc::oracle
