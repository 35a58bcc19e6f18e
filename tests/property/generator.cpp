#include "generator.h"

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "enumeration.h"
#include "oracle.h"

namespace cbc::oracle {
namespace {

// All times of a case are multiples of one of these, so that many things fall due together.
Microseconds pick_time_unit(Random& random) {
  static const std::vector<Microseconds> units = {1'000'000, 1'000'000, 500'000,  250'000,
                                                  100'000,   80'000,    1'000'001};
  return random.pick(units);
}

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

  Catalog generate() {
    choose_defaults();
    std::size_t left = random_.percent(15) ? 1 + random_.below(4) : 5 + random_.below(8);
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
      if (complete_.count(block.first + i) == 0) {
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

// Runs an oracle along with the script it writes.
class ScriptGenerator {
 public:
  ScriptGenerator(Random& random, const Catalog& catalog)
      : random_(random),
        facts_(std::make_shared<const CatalogFacts>(catalog)),
        unit_(usual_unit(catalog)),
        script_(generate_settings()),
        oracle_(facts_, script_, nullptr) {}

  Script generate() {
    const std::size_t length = 10 + random_.below(21);
    while (script_.events.size() < length) {
      if (script_.events.size() < 5 && random_.percent(60)) {
        emit_timed(start_event(random_.below(task_count())));
      } else {
        add_something();
      }
    }
    return std::move(script_);
  }

 private:
  Microseconds usual_unit(const Catalog& catalog) {
    std::vector<Microseconds> timeouts;
    for (const Task& task : catalog.tasks) {
      if (task.timeout) {
        timeouts.push_back(*task.timeout);
      }
    }
    return timeouts.empty() || random_.percent(50) ? pick_time_unit(random_)
                                                   : random_.pick(timeouts);
  }

  Script generate_settings() {
    Script script;
    if (random_.percent(50)) {
      const std::vector<Microseconds> delays = {80'000,    unit_,     unit_,         2 * unit_,
                                                unit_ / 2, unit_ / 4, unit_ * 3 / 2, 1};
      script.reactive_delay = random_.pick(delays);
    }
    if (random_.percent(40)) {
      for (std::size_t b = 0; b < facts_->catalog.behaviors.size(); ++b) {
        if (random_.percent(15)) {
          script.situation.own.emplace_back(b, random_.percent(15));
        }
      }
      random_.shuffle(script.situation.own);
    }
    if (random_.percent(40)) {
      for (std::size_t v = 0; v < facts_->catalog.variables.size(); ++v) {
        if (random_.percent(60)) {
          script.situation.variables.emplace_back(v, pick_value(v));
        }
      }
    }
    return script;
  }

  void emit(const Event& event) {
    script_.events.push_back(event);
    oracle_.handle(event);
  }

  void emit_timed(Event event) {
    add_time(event);
    emit(event);
  }

  void add_time(Event& event) {
    const std::size_t way = random_.below(100);
    const std::optional<Microseconds> due = oracle_.next_due_time();
    if (way < 50) {
      return;
    }
    if (way < 72 && due && *due >= oracle_.now()) {
      if (random_.percent(50)) {
        event.at = *due;
      } else {
        event.wait = *due - oracle_.now();
      }
    } else if (way < 90) {
      event.wait = unit_ * random_.between(0, 3);
    } else if (way < 96) {
      event.at = oracle_.now() + unit_ * random_.between(0, 4);
    } else {
      event.wait = random_.between(0, 2 * unit_);
    }
  }

  void add_something() {
    if (!facts_->catalog.variables.empty() && random_.percent(14)) {
      return add_change_of_variables();
    }
    const std::size_t way = random_.below(100);
    if (way < 32) {
      emit_timed(start_event(random_.below(task_count())));
    } else if (way < 39) {
      add_restart();
    } else if (way < 46) {
      add_stop();
    } else if (way < 60) {
      add_finish();
    } else if (way < 65) {
      add_wait();
    } else if (way < 74) {
      add_situation();
    } else if (way < 77) {
      add_fault();
    } else if (way < 87) {
      add_repair();
    } else if (way < 91) {
      add_contested_event();
    } else {
      add_failing_event();
    }
  }

  // A start that makes the order of the requests decide, or a finish that must override higher
  // priorities, if there is one.
  void add_contested_event() {
    std::vector<Event> candidates;
    for (std::size_t task = 0; task < task_count(); ++task) {
      Event event;
      event.verb = Verb::start;
      event.subject = task;
      event.priority = static_cast<int>(random_.between(1, 4));
      candidates.push_back(event);
    }
    for (std::size_t b = 0; b < facts_->catalog.behaviors.size(); ++b) {
      if (is_active(b)) {
        Event event;
        event.verb = Verb::finish;
        event.subject = b;
        event.cause = random_.percent(50) ? Cause::process_failure : Cause::interrupted;
        candidates.push_back(event);
      }
    }
    random_.shuffle(candidates);
    for (const Event& event : candidates) {
      Statistics statistics;
      oracle_.preview(event, &statistics);
      if (statistics.of("decided by: f1, order of requests") != 0 ||
          statistics.of("escalation: 1") != 0 || statistics.of("escalation: 2") != 0 ||
          statistics.of("escalation: 3 or more") != 0) {
        emit(event);
        return;
      }
    }
  }

  std::size_t task_count() const { return facts_->catalog.tasks.size(); }

  std::vector<std::size_t> tasks_where(bool running, bool requested) const {
    std::vector<std::size_t> result;
    for (std::size_t task = 0; task < task_count(); ++task) {
      const bool runs = oracle_.state().values[task] != none;
      if (runs == running && (!requested || oracle_.state().requests[task])) {
        result.push_back(task);
      }
    }
    return result;
  }

  template <typename Predicate>
  std::vector<std::size_t> behaviors_where(Predicate predicate) const {
    std::vector<std::size_t> result;
    for (std::size_t b = 0; b < facts_->catalog.behaviors.size(); ++b) {
      if (predicate(b)) {
        result.push_back(b);
      }
    }
    return result;
  }

  bool is_active(std::size_t behavior) const {
    const Assignment& values = oracle_.state().values;
    return std::find(values.begin(), values.end(), behavior) != values.end();
  }

  Event start_event(std::size_t task) {
    Event event;
    event.verb = Verb::start;
    // A task that runs already is tried again with another one, most of the time.
    if (oracle_.state().values[task] != none && random_.percent(70)) {
      const std::vector<std::size_t> idle = tasks_where(false, false);
      task = idle.empty() ? task : random_.pick(idle);
    }
    event.subject = task;
    if (random_.percent(70)) {
      event.priority = static_cast<int>(random_.between(1, random_.percent(45) ? 2 : 4));
    }
    if (random_.percent(30)) {
      event.parameters = pick_parameters();
    }
    return event;
  }

  Parameters pick_parameters() {
    using nlohmann::ordered_json;
    static const std::vector<ordered_json> choices = {
        ordered_json::object(),
        {{"p", "1"}},
        {{"p", "2"}},
        {{"p", "1"}, {"q", ordered_json::array({"1", "east"})}},
        {{"q", ordered_json::array({"1", "east"})}, {"p", "1"}},
        {{"p", "1"}, {"q", nullptr}},
        {{"p", nullptr}},
        {{"p", "1"}, {"q", ordered_json::object()}},
        {{"q", {{"r", nullptr}, {"s", ordered_json::array()}}}, {"p", "1"}},
        {{"p", "1"}, {"q", {{"r", "fast"}, {"s", ordered_json::array()}}}},
        {{"p", "1"}, {"q", {{"s", nullptr}, {"r", "fast"}}}},
        {{"q", ordered_json::array({"east", "1"})}, {"p", "1"}},
        {{"q", ordered_json::array({ordered_json::array({"1", "1", "1"})})}},
    };
    return random_.pick(choices);
  }

  Event restart_event(std::size_t task) {
    Event event = start_event(task);
    event.subject = task;
    event.parameters = pick_parameters();
    const std::optional<Request>& request = oracle_.state().requests[task];
    if (request) {
      const auto raise = static_cast<int>(random_.percent(80) ? 0 : 1);
      event.priority = std::max(1, request->priority + raise);
    }
    return event;
  }

  void add_restart() {
    const std::vector<std::size_t> running = tasks_where(true, random_.percent(80));
    if (!running.empty()) {
      emit_timed(restart_event(random_.pick(running)));
    }
  }

  Event stop_event() {
    Event event;
    event.verb = Verb::stop;
    const std::vector<std::size_t> running = tasks_where(true, false);
    event.subject = running.empty() || random_.percent(12) ? random_.below(task_count())
                                                           : random_.pick(running);
    if (random_.percent(40)) {
      event.priority = static_cast<int>(random_.between(1, 4));
    }
    return event;
  }

  void add_stop() { emit_timed(stop_event()); }

  Event finish_event() {
    static const std::vector<Cause> causes = {Cause::goal_achieved,    Cause::goal_achieved,
                                              Cause::situation_change, Cause::time_out,
                                              Cause::wrong_progress,   Cause::process_failure,
                                              Cause::interrupted,      Cause::situation_change};
    Event event;
    event.verb = Verb::finish;
    event.cause = random_.pick(causes);
    if (random_.percent(25)) {
      const std::vector<std::size_t> running = tasks_where(true, false);
      event.performed_task = running.empty() || random_.percent(10) ? random_.below(task_count())
                                                                    : random_.pick(running);
      return event;
    }
    const std::vector<std::size_t> active =
        behaviors_where([&](std::size_t b) { return is_active(b); });
    event.subject = active.empty() || random_.percent(3)
                        ? random_.below(facts_->catalog.behaviors.size())
                        : random_.pick(active);
    return event;
  }

  void add_finish() {
    const bool nothing_runs = tasks_where(true, false).empty();
    if (facts_->catalog.behaviors.empty() || (nothing_runs && random_.percent(90))) {
      return;
    }
    Event event = finish_event();
    if (event.cause == Cause::situation_change && event.subject != none && random_.percent(60)) {
      Event change;
      change.verb = Verb::situation;
      change.situation.own.emplace_back(event.subject, false);
      emit_timed(change);
      emit(event);
      return;
    }
    emit_timed(event);
  }

  void add_wait() {
    Event event;
    event.verb = Verb::wait;
    add_time(event);
    if (!event.at && !event.wait) {
      event.wait = unit_ * random_.between(0, 4);
    }
    emit(event);
  }

  void add_situation() {
    const std::vector<std::size_t> unavailable =
        behaviors_where([&](std::size_t b) { return !oracle_.own(b); });
    Event event;
    event.verb = Verb::situation;
    const std::size_t behaviors = facts_->catalog.behaviors.size();
    std::vector<std::pair<std::size_t, bool>>& own = event.situation.own;
    if (!unavailable.empty() && random_.percent(65)) {
      own.emplace_back(random_.pick(unavailable), true);
    } else if (behaviors > 0) {
      const std::size_t behavior = random_.below(behaviors);
      own.emplace_back(behavior, random_.percent(20));
    }
    if (behaviors > 0 && random_.percent(30)) {
      const std::size_t other = random_.below(behaviors);
      if (own.empty() || own.front().first != other) {
        own.emplace_back(other, random_.percent(60));
      }
    }
    if (!own.empty()) {
      emit_timed(event);
    }
  }

  std::size_t pick_value(std::size_t variable) {
    return random_.below(facts_->catalog.variables[variable].value_count());
  }

  std::pair<std::size_t, std::size_t> pick_change() {
    const std::size_t variable = random_.below(facts_->catalog.variables.size());
    return {variable, pick_value(variable)};
  }

  // A variable with a value in which an active behavior does not fit, if there is one.
  std::pair<std::size_t, std::size_t> pick_disturbance() {
    std::vector<std::pair<std::size_t, std::size_t>> choices;
    for (std::size_t b = 0; b < facts_->catalog.behaviors.size(); ++b) {
      for (const Condition& condition : facts_->catalog.behaviors[b].situation) {
        const std::size_t count = facts_->catalog.variables[condition.variable].value_count();
        for (std::size_t value = 0; value < count && is_active(b); ++value) {
          if (std::find(condition.values.begin(), condition.values.end(), value) ==
              condition.values.end()) {
            choices.emplace_back(condition.variable, value);
          }
        }
      }
    }
    return choices.empty() ? pick_change() : random_.pick(choices);
  }

  // Of one variable or several, and now and then of behaviors at once.
  void add_change_of_variables() {
    Event event;
    event.verb = Verb::situation;
    const std::size_t variables = facts_->catalog.variables.size();
    const auto [changed, value] = random_.percent(50) ? pick_disturbance() : pick_change();
    for (std::size_t v = 0; v < variables; ++v) {
      if (v == changed) {
        event.situation.variables.emplace_back(v, value);
      } else if (random_.percent(35)) {
        event.situation.variables.emplace_back(v, pick_value(v));
      }
    }
    for (std::size_t b = 0; b < facts_->catalog.behaviors.size(); ++b) {
      if (!event.situation.own.empty() ? random_.percent(8) : random_.percent(4)) {
        event.situation.own.emplace_back(b, !oracle_.own(b) || random_.percent(30));
      }
    }
    emit_timed(event);
  }

  void emit_fault(std::size_t behavior) {
    Event event;
    event.verb = Verb::fault;
    event.subject = behavior;
    emit(event);
  }

  void emit_fault_once(std::size_t behavior) {
    if (!oracle_.faulty(behavior)) {
      emit_fault(behavior);
    }
  }

  void add_fault() {
    const std::vector<std::size_t> active =
        behaviors_where([&](std::size_t b) { return is_active(b) && !oracle_.faulty(b); });
    if (!active.empty()) {
      emit_fault(random_.pick(active));
    }
  }

  void add_repair() {
    const std::vector<std::size_t> faulty =
        behaviors_where([&](std::size_t b) { return oracle_.faulty(b); });
    const std::size_t behaviors = facts_->catalog.behaviors.size();
    if (behaviors == 0 || (faulty.empty() && random_.percent(90))) {
      return;
    }
    Event event;
    event.verb = Verb::repair;
    event.subject = faulty.empty() ? random_.below(behaviors) : random_.pick(faulty);
    emit_timed(event);
  }

  Event event_to_fail() {
    const std::size_t way = random_.below(100);
    const std::vector<std::size_t> running = tasks_where(true, false);
    if (way < 25 && !running.empty()) {
      return restart_event(random_.pick(running));
    }
    if (way < 45 && !running.empty()) {
      return finish_event();
    }
    if (way < 52 && !running.empty()) {
      return stop_event();
    }
    Event event = start_event(random_.below(task_count()));
    if (random_.percent(50)) {
      event.priority = static_cast<int>(random_.between(3, 4));
    }
    return event;
  }

  // Looks at what an event would do, makes some of the behaviors concerned faulty, then does it.
  // Often looks again, at what it would do then.
  void add_failing_event() {
    const Event event = event_to_fail();
    const bool all_of_task = event.verb == Verb::start && random_.percent(45);
    const std::size_t chance_if_active = random_.percent(50) ? 90 : 20;
    if (all_of_task) {
      for (const std::size_t behavior : facts_->behaviors_of[event.subject]) {
        emit_fault_once(behavior);
      }
    }
    do {
      for (const std::size_t behavior : concerned(event)) {
        if (random_.percent(is_active(behavior) ? chance_if_active : 60)) {
          emit_fault_once(behavior);
        }
      }
    } while (random_.percent(45));
    emit_timed(event);
  }

  // The behaviors that the event would activate or deactivate.
  std::vector<std::size_t> concerned(const Event& event) const {
    std::set<std::string> names;
    for (const nlohmann::ordered_json& happened : oracle_.preview(event, nullptr)) {
      for (const nlohmann::ordered_json& change : happened["changes"]) {
        names.insert(change["behavior"].get<std::string>());
      }
    }
    return behaviors_where(
        [&](std::size_t b) { return names.count(facts_->catalog.behaviors[b].name) != 0; });
  }

  Random& random_;
  std::shared_ptr<const CatalogFacts> facts_;
  Microseconds unit_;
  Script script_;
  Oracle oracle_;
};

}  // namespace

Catalog generate_catalog(Random& random) { return CatalogGenerator(random).generate(); }

Script generate_script(Random& random, const Catalog& catalog) {
  return ScriptGenerator(random, catalog).generate();
}

Case generate_case(std::uint64_t seed) {
  Random random(seed);
  Case result;
  result.catalog = generate_catalog(random);
  result.script = generate_script(random, result.catalog);
  return result;
}

}  // namespace cbc::oracle
