#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "enumeration.h"
#include "generator.h"

namespace cbc::oracle {
namespace {

std::vector<Millionths> pick_palette(Random& random) {
  static const std::vector<std::vector<Millionths>> palettes = {
      {1'000'000},
      {1'000'000, 1'000'000, 900'000, 800'000, 720'000},
      {900'000, 800'000, 720'000, 640'000, 810'000, 1'000'000},
      {500'000, 500'000, 250'000, 1'000'000, 200'000},
      {1'000'000, 999'999, 999'998},
      {999'999, 999'900, 990'000, 1'000'000},
      {1'000'000, 800'000, 800'000, 1'000'000},
      {333'333, 666'667, 1'000'000},
      {950'000, 700'000, 400'000, 0, 1'000'000},
      {1, 3, 1'000'000, 0},
  };
  if (random.percent(85)) {
    return random.pick(palettes);
  }
  std::vector<Millionths> palette;
  palette.reserve(4);
  for (int i = 0; i < 4; ++i) {
    palette.push_back(random.between(0, whole_degree));
  }
  return palette;
}

// Tasks of one block may require one another, exclude one another, and share behaviors. A behavior
// requires only tasks that come before all it performs, so there are no cycles.
class CatalogGenerator {
 public:
  explicit CatalogGenerator(Random& random)
      : random_(random), unit_(pick_time_unit(random)), palette_(pick_palette(random)) {}

  /// `tasks`: 0 for a random number of them.
  Catalog generate(std::size_t tasks) {
    choose_defaults();
    std::size_t left = tasks;
    if (left == 0) left = random_.percent(15) ? 1 + random_.below(4) : 5 + random_.below(8);
    while (left > 0) {
      const std::size_t size = std::min(left, 1 + std::max(random_.below(7), random_.below(7)));
      add_block(size);
      left -= size;
    }
    name_all();
    if (random_.percent(50)) {
      add_variables();
    }
    arrange();
    return std::move(catalog_);
  }

 private:
  struct Block {
    std::size_t first = 0;
    std::size_t size = 0;
    std::size_t space = 1;
    std::size_t space_limit = 1;
  };

  void choose_defaults() {
    Defaults& defaults = catalog_.defaults;
    if (random_.percent(30)) {
      return;
    }
    if (random_.percent(50)) {
      defaults.start_on_request = random_.percent(50);
    }
    if (random_.percent(30)) {
      defaults.reactive_start =
          defaults.start_on_request == std::optional(false) && random_.percent(40);
    }
    if (random_.percent(40)) {
      defaults.keep_running = random_.percent(50);
    }
    if (random_.percent(12)) {
      defaults.timeout = unit_ * random_.between(2, 9);
    }
    if (random_.percent(30)) {
      defaults.suitability = random_.pick(palette_);
    }
  }

  Task default_task() const {
    const Defaults& defaults = catalog_.defaults;
    Task task;
    task.start_on_request = defaults.start_on_request.value_or(true);
    task.reactive_start = defaults.reactive_start.value_or(false);
    task.keep_running = defaults.keep_running.value_or(false);
    task.timeout = defaults.timeout;
    return task;
  }

  void add_block(std::size_t size) {
    static const std::vector<std::size_t> limits = {200, 1000, 3000, 3000, 6000, 20'000};
    Block block;
    block.first = catalog_.tasks.size();
    block.size = size;
    block.space_limit = random_.pick(limits);
    for (std::size_t i = 0; i < size; ++i) {
      add_task(block, i);
    }
    add_exclusivity(block);
    if (size >= 5 && random_.percent(25)) {
      add_rivals(block);
    }
    if (size >= 4 && random_.percent(35)) {
      add_waiting(block);
    }
    for (std::size_t i = 0; i < size; ++i) {
      if (!complete_.contains(block.first + i)) {
        add_behaviors(block, block.first + i);
      }
    }
  }

  // The first tasks of a block support the others: most of them start by themselves.
  void add_task(const Block& block, std::size_t position) {
    Task task = default_task();
    task.listed = !random_.percent(15);
    if (task.listed) {
      const bool supports = 2 * position < block.size;
      task.start_on_request = random_.percent(supports ? 12 : 70);
      task.reactive_start = !task.start_on_request && random_.percent(supports ? 20 : 60);
      task.keep_running = random_.percent(50);
      if (random_.percent(22)) {
        task.timeout = unit_ * random_.between(1, 8);
      }
    }
    catalog_.tasks.push_back(task);
  }

  void add_exclusivity(const Block& block) {
    if (block.size < 2) {
      return;
    }
    const std::size_t lists = random_.below(block.size / 2 + 2);
    for (std::size_t i = 0; i < lists; ++i) {
      std::set<std::size_t> chosen;
      const std::size_t length = random_.percent(6) ? 1 : 2 + random_.below(3);
      // Goals exclude one another, or a goal and a support do.
      const bool goals = random_.percent(45);
      for (std::size_t j = 0; j < (goals ? length : std::min<std::size_t>(length, 2)); ++j) {
        const std::size_t half = goals || j == 1 ? block.size / 2 : 0;
        chosen.insert(block.first + half + random_.below(block.size - half));
      }
      std::vector<std::size_t> list(chosen.begin(), chosen.end());
      if (random_.percent(2)) {
        list.push_back(list.front());
      }
      random_.shuffle(list);
      catalog_.exclusivity.push_back(list);
    }
  }

  // The last task has two behaviors, each of which needs a support that excludes another goal: when
  // both goals run, one of them has to give way, and the requests decide which.
  void add_rivals(const Block& block) {
    const std::size_t last = block.first + block.size - 1;
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t support = block.first + i;
      catalog_.tasks[support].start_on_request = false;
      catalog_.tasks[support].listed = true;
      catalog_.exclusivity.push_back({support, last - 1 - i});
      if (!exclude(last, support)) {
        Behavior behavior;
        behavior.performs.push_back({last, palette_.front()});
        behavior.requirements.push_back({support, 0});
        catalog_.behaviors.push_back(behavior);
      }
    }
  }

  // A reactive task that shares no list with a goal, and yet cannot run beside it: what both
  // require excludes one another. So it waits until the goal has stopped.
  void add_waiting(const Block& block) {
    const std::size_t last = block.first + block.size - 1;
    const std::size_t tasks[] = {last, last - 1};
    if (exclude(last, block.first) || exclude(last - 1, block.first + 1)) {
      return;
    }
    Task& waiting = catalog_.tasks[last];
    waiting.listed = true;
    waiting.start_on_request = false;
    waiting.reactive_start = true;
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t support = block.first + i;
      catalog_.tasks[support].start_on_request = false;
      catalog_.tasks[support].listed = true;
      Behavior behavior;
      behavior.performs.push_back({tasks[i], pick_suitability()});
      behavior.requirements.push_back({support, 0});
      catalog_.behaviors.push_back(behavior);
      if (i == 0 || random_.percent(60)) {
        complete_.insert(tasks[i]);
      }
    }
    catalog_.exclusivity.push_back({block.first, block.first + 1});
  }

  bool exclude(std::size_t a, std::size_t b) const {
    return std::any_of(catalog_.exclusivity.begin(), catalog_.exclusivity.end(),
                       [&](const std::vector<std::size_t>& list) {
                         return std::find(list.begin(), list.end(), a) != list.end() &&
                                std::find(list.begin(), list.end(), b) != list.end();
                       });
  }

  std::size_t count_behaviors(std::size_t task) const {
    std::size_t count = 0;
    for (const Behavior& behavior : catalog_.behaviors) {
      for (const Performance& performed : behavior.performs) {
        count += performed.task == task ? 1U : 0U;
      }
    }
    return count;
  }

  std::size_t block_space(const Block& block) const {
    std::size_t space = 1;
    for (std::size_t i = 0; i < block.size; ++i) {
      space *= 1 + count_behaviors(block.first + i);
    }
    return space;
  }

  void add_behaviors(const Block& block, std::size_t task) {
    static const std::vector<std::size_t> counts = {1, 1, 2, 2, 2, 3, 3, 4};
    const std::size_t count = random_.percent(4) ? 0 : random_.pick(counts);
    for (std::size_t i = 0; i < count && count_behaviors(task) < 4; ++i) {
      Behavior behavior;
      behavior.performs.push_back({task, pick_suitability()});
      if (random_.percent(28)) {
        add_second_tasks(block, behavior);
      }
      if (random_.percent(8)) {
        behavior.timeout = unit_ * random_.between(1, 8);
      }
      add_requirements(block, behavior);
      catalog_.behaviors.push_back(behavior);
      if (block_space(block) > block.space_limit) {
        catalog_.behaviors.pop_back();
        return;
      }
    }
  }

  void add_second_tasks(const Block& block, Behavior& behavior) {
    const std::size_t wanted = 1 + random_.below(2);
    for (std::size_t i = 0; i < wanted; ++i) {
      const std::size_t other = block.first + random_.below(block.size);
      const bool known =
          std::any_of(behavior.performs.begin(), behavior.performs.end(),
                      [&](const Performance& performed) { return performed.task == other; });
      if (!known && count_behaviors(other) < 4) {
        behavior.performs.push_back({other, pick_suitability()});
      }
    }
    random_.shuffle(behavior.performs);
  }

  Millionths pick_suitability() {
    const Millionths suitability = random_.percent(30) ? palette_.front() : random_.pick(palette_);
    return random_.percent(1) ? 0 : suitability;
  }

  void add_requirements(const Block& block, Behavior& behavior) {
    std::size_t first_own = none;
    for (const Performance& performed : behavior.performs) {
      first_own = std::min(first_own, performed.task);
    }
    if (first_own == block.first || random_.percent(15)) {
      return;
    }
    const std::size_t wanted = 1 + random_.below(3);
    for (std::size_t i = 0; i < wanted; ++i) {
      // Mostly support tasks.
      std::size_t range = first_own - block.first;
      if (random_.percent(60)) {
        range = std::min(range, (block.size + 1) / 2);
      }
      const std::size_t task = block.first + random_.below(range);
      const bool known = std::any_of(behavior.requirements.begin(), behavior.requirements.end(),
                                     [&](const Requirement& entry) { return entry.task == task; });
      const bool excluded =
          std::any_of(behavior.performs.begin(), behavior.performs.end(),
                      [&](const Performance& performed) { return exclude(performed.task, task); });
      if (known || excluded) {
        continue;
      }
      const Millionths minimum = random_.percent(55) ? pick_minimum(task) : 0;
      behavior.requirements.push_back({task, minimum});
    }
  }

  // Often exactly what some choice of behaviors reaches. All behaviors that may perform the task,
  // or what it requires, are in the catalog already, some of several tasks excepted.
  Millionths pick_minimum(std::size_t task) {
    static const std::vector<Millionths> usual = {250'000, 500'000, 700'000, 720'000,
                                                  810'000, 900'000, 999'999, 1'000'000};
    if (random_.percent(15)) {
      return random_.pick(usual);
    }
    std::set<std::size_t> seen;
    Integer product = 1;
    std::size_t factors = 0;
    multiply_sample(task, seen, product, factors);
    if (factors == 0) {
      return random_.pick(usual);
    }
    const Integer whole = product / power_of_million(factors - 1);
    const auto reached = whole.convert_to<Millionths>();
    const bool exact = whole * power_of_million(factors - 1) == product;
    if (exact && random_.percent(90)) {
      return reached;
    }
    return std::min<Millionths>(whole_degree, reached + random_.between(0, 1));
  }

  // Multiplies the suitabilities of a random choice for a task and all it requires.
  void multiply_sample(std::size_t task, std::set<std::size_t>& seen, Integer& product,
                       std::size_t& factors) {
    std::vector<std::pair<std::size_t, Millionths>> choices;
    for (std::size_t b = 0; b < catalog_.behaviors.size(); ++b) {
      for (const Performance& performed : catalog_.behaviors[b].performs) {
        if (performed.task == task) {
          choices.emplace_back(b, performed.suitability);
        }
      }
    }
    if (choices.empty() || !seen.insert(task).second) {
      return;
    }
    const auto [behavior, suitability] = random_.pick(choices);
    product *= suitability;
    ++factors;
    for (const Requirement& requirement : catalog_.behaviors[behavior].requirements) {
      multiply_sample(requirement.task, seen, product, factors);
    }
  }

  // Task minimums come last, when all behaviors are known; the names are in no useful order.
  void name_all() {
    const std::size_t tasks = catalog_.tasks.size();
    std::vector<std::size_t> numbers(tasks);
    for (std::size_t i = 0; i < tasks; ++i) {
      numbers[i] = i;
    }
    random_.shuffle(numbers);
    for (std::size_t i = 0; i < tasks; ++i) {
      Task& task = catalog_.tasks[i];
      task.name = "T" + std::to_string(numbers[i]);
      if (task.listed && random_.percent(25)) {
        task.minimum = pick_minimum(i);
      }
    }
    const bool same_names = random_.percent(10);
    for (std::size_t b = 0; b < catalog_.behaviors.size(); ++b) {
      Behavior& behavior = catalog_.behaviors[b];
      const std::string& task = catalog_.tasks[behavior.performs.front().task].name;
      const bool first = std::none_of(catalog_.behaviors.begin(),
                                      catalog_.behaviors.begin() + static_cast<std::ptrdiff_t>(b),
                                      [&](const Behavior& other) { return other.name == task; });
      behavior.name = same_names && first ? task : task + "_BY_" + std::to_string(b);
    }
  }

  void add_variables() {
    const std::size_t wanted = 1 + random_.below(3);
    while (catalog_.variables.size() < wanted) {
      add_variable();
    }
    static const std::vector<std::size_t> chances = {20, 40, 60};
    const std::size_t chance = random_.pick(chances);
    for (Behavior& behavior : catalog_.behaviors) {
      if (random_.percent(chance)) {
        add_conditions(behavior);
      }
    }
  }

  // A variable may have the name of a task, but not of a behavior. Values are texts, whatever else
  // they look like.
  void add_variable() {
    static const std::vector<std::vector<std::string>> values = {
        {"far", "near", "lost"},  {"bright", "dark"},        {"on", "off"}, {"no", "maybe", "yes"},
        {"1.0", "1", "01", "10"}, {"true", "false", "True"}, {"A", "a"},
    };
    Variable variable;
    variable.name = "V" + std::to_string(catalog_.variables.size());
    const std::string& task = random_.pick(catalog_.tasks).name;
    const auto has_name = [&](const auto& named) { return named.name == task; };
    if (random_.percent(10) &&
        std::none_of(catalog_.behaviors.begin(), catalog_.behaviors.end(), has_name) &&
        std::none_of(catalog_.variables.begin(), catalog_.variables.end(), has_name)) {
      variable.name = task;
    }
    if (random_.percent(60)) {
      variable.values = random_.pick(values);
      random_.shuffle(variable.values);
    }
    catalog_.variables.push_back(variable);
  }

  void add_conditions(Behavior& behavior) {
    const std::size_t first = random_.below(catalog_.variables.size());
    behavior.situation.push_back({first, pick_fitting_values(first)});
    const std::size_t second = random_.below(catalog_.variables.size());
    if (second != first && random_.percent(40)) {
      behavior.situation.push_back({second, pick_fitting_values(second)});
    }
  }

  // Most often some of the values, the initial one among them.
  std::vector<std::size_t> pick_fitting_values(std::size_t variable) {
    std::vector<std::size_t> values(catalog_.variables[variable].value_count());
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = i;
    }
    std::vector<std::size_t> others(values.begin() + 1, values.end());
    random_.shuffle(others);
    if (random_.percent(3)) {
      random_.shuffle(values);
      return values;
    }
    if (random_.percent(30)) {
      others.resize(1 + random_.below(others.size()));
      return others;
    }
    others.resize(random_.below(others.size()));
    others.push_back(0);
    random_.shuffle(others);
    return others;
  }

  // Brings all into a random order, then the tasks into catalog order: those listed first, then
  // the others in the order in which the behaviors name them.
  void arrange() {
    if (random_.percent(70)) {
      random_.shuffle(catalog_.behaviors);
    }
    random_.shuffle(catalog_.exclusivity);
    std::vector<std::size_t> order;
    for (std::size_t task = 0; task < catalog_.tasks.size(); ++task) {
      if (count_behaviors(task) == 0) {
        catalog_.tasks[task].listed = true;
      }
      if (catalog_.tasks[task].listed) {
        order.push_back(task);
      }
    }
    if (random_.percent(70)) {
      random_.shuffle(order);
    }
    for (const Behavior& behavior : catalog_.behaviors) {
      for (const Performance& performed : behavior.performs) {
        if (std::find(order.begin(), order.end(), performed.task) == order.end()) {
          order.push_back(performed.task);
        }
      }
    }
    renumber(order);
  }

  void renumber(const std::vector<std::size_t>& order) {
    std::vector<std::size_t> place(order.size());
    std::vector<Task> tasks;
    for (std::size_t i = 0; i < order.size(); ++i) {
      place[order[i]] = i;
      tasks.push_back(catalog_.tasks[order[i]]);
    }
    catalog_.tasks = std::move(tasks);
    for (Behavior& behavior : catalog_.behaviors) {
      for (Performance& performed : behavior.performs) {
        performed.task = place[performed.task];
      }
      for (Requirement& requirement : behavior.requirements) {
        requirement.task = place[requirement.task];
      }
    }
    for (std::vector<std::size_t>& list : catalog_.exclusivity) {
      for (std::size_t& task : list) {
        task = place[task];
      }
    }
  }

  Random& random_;
  Microseconds unit_;
  std::vector<Millionths> palette_;
  std::set<std::size_t> complete_;  // tasks that get no more behaviors
  Catalog catalog_;
};

}  // namespace

Microseconds pick_time_unit(Random& random) {
  static const std::vector<Microseconds> units = {1'000'000, 1'000'000, 500'000,  250'000,
                                                  100'000,   80'000,    1'000'001};
  return random.pick(units);
}

void add_further_keys(Random& random, Catalog& catalog) {
  for (Task& task : catalog.tasks) {
    if (!task.listed) {
      continue;
    }
    task.requestable = task.start_on_request || !random.percent(25);
    if (task.reactive_start && random.percent(55)) {
      task.reactive_priority = static_cast<int>(random.between(1, 4));
    }
    if (random.percent(50)) {
      task.improve = random.percent(50) ? Improve::at_once : Improve::when_started;
    }
    task.resume = task.requestable && !task.reactive_start &&
                  task.improve != Improve::when_started && random.percent(60);
  }
  for (Behavior& behavior : catalog.behaviors) {
    if (random.percent(65)) {
      behavior.retry = random.percent(60) ? Retry::when_started : Retry::after_repair;
    }
  }
  for (std::size_t list = 0; list < catalog.exclusivity.size(); ++list) {
    catalog.at_most.push_back(random.percent(35) ? static_cast<std::size_t>(random.between(2, 3))
                                                 : 1);
  }
}

Catalog generate_catalog(Random& random) { return CatalogGenerator(random).generate(0); }

Catalog generate_catalog(Random& random, std::size_t tasks) {
  return CatalogGenerator(random).generate(tasks);
}

}  // namespace cbc::oracle
