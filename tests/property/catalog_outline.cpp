#include "catalog_outline.h"

#include <algorithm>
#include <cstdlib>
#include <map>

namespace cbc::mutation {
namespace {

constexpr std::size_t unreached = SIZE_MAX;

double percent(const Field& field) { return std::strtod(field.value.text.c_str(), nullptr) / 100; }

bool is_true(const Field& field) {
  static const std::set<std::string, std::less<>> words{"TRUE", "True", "true", "YES", "Yes",
                                                        "yes",  "ON",   "On",   "on"};
  return words.contains(field.value.text);
}

/// Searches an assignment in depth: opens what is required until nothing is open.
class Witness {
 public:
  explicit Witness(const CatalogOutline& catalog) : catalog_(catalog) {}

  bool search(std::size_t task, std::optional<std::size_t> behavior) {
    if (!behavior) return open(task, {});
    return assign(task, *behavior, {});
  }

 private:
  bool open(std::size_t task, const std::vector<std::size_t>& rest) {
    for (std::size_t behavior = 0; behavior < catalog_.behaviors().size(); ++behavior) {
      if (suitability(behavior, task) >= 0 && assign(task, behavior, rest)) return true;
    }
    return false;
  }

  bool assign(std::size_t task, std::size_t behavior, std::vector<std::size_t> open_tasks) {
    if (++steps_ > most_steps) return false;
    for (const auto& [other, unused] : assigned_) {
      if (catalog_.excludes(task, other)) return false;
    }
    assigned_[task] = behavior;
    for (const Requirement& requirement : catalog_.behaviors()[behavior].requirements) {
      open_tasks.push_back(requirement.task);
    }
    while (!open_tasks.empty() && assigned_.contains(open_tasks.back())) open_tasks.pop_back();
    bool found = false;
    if (open_tasks.empty()) {
      found = performs_well();
    } else {
      const std::size_t next = open_tasks.back();
      open_tasks.pop_back();
      found = open(next, open_tasks);
    }
    assigned_.erase(task);
    return found;
  }

  [[nodiscard]] double suitability(std::size_t behavior, std::size_t task) const {
    for (const Performance& performance : catalog_.behaviors()[behavior].performs) {
      if (performance.task == task) return performance.suitability;
    }
    return -1;
  }

  [[nodiscard]] double performance_of(std::size_t task) const {
    std::set<std::size_t> closure{task};
    std::vector<std::size_t> queue{task};
    double product = 1;
    for (std::size_t next = 0; next < queue.size(); ++next) {
      const std::size_t behavior = assigned_.at(queue[next]);
      product *= suitability(behavior, queue[next]);
      for (const Requirement& requirement : catalog_.behaviors()[behavior].requirements) {
        if (closure.insert(requirement.task).second) queue.push_back(requirement.task);
      }
    }
    return product;
  }

  [[nodiscard]] bool performs_well() const {
    constexpr double rounding = 1e-12;
    for (const auto& [task, behavior] : assigned_) {
      if (performance_of(task) < catalog_.tasks()[task].minimum - rounding) return false;
      for (const Requirement& requirement : catalog_.behaviors()[behavior].requirements) {
        if (performance_of(requirement.task) < requirement.minimum - rounding) return false;
      }
    }
    return true;
  }

  static constexpr std::size_t most_steps = 20'000;

  const CatalogOutline& catalog_;
  std::map<std::size_t, std::size_t> assigned_;  // behavior by task
  std::size_t steps_ = 0;
};

}  // namespace

bool performs(const Behavior& behavior, std::size_t task) {
  return std::any_of(behavior.performs.begin(), behavior.performs.end(),
                     [task](const Performance& performance) { return performance.task == task; });
}

const std::vector<Shape>& all_shapes() {
  static const std::vector<Shape> shapes{
      {"catalog",
       {"default_values", "tasks", "behaviors", "exclusivity_constraints"},
       {"behaviors"}},
      {"default_values", {"tasks", "behaviors"}, {}},
      {"task defaults",
       {"execution_goal", "start_on_request", "reactive_start", "timeout", "category",
        "automatic_activation", "default"},
       {}},
      {"behavior defaults", {"suitability", "package", "efficacy"}, {}},
      {"task",
       {"task", "execution_goal", "start_on_request", "reactive_start", "timeout",
        "minimum_performance", "parameters", "category", "automatic_activation", "default"},
       {"task"}},
      {"parameter", {"parameter", "allowed_values"}, {"parameter"}},
      {"behavior",
       {"behavior", "package", "task", "tasks", "requires", "timeout", "suitability", "efficacy"},
       {"behavior", "task", "tasks"}},
      {"performance", {"task", "suitability", "efficacy"}, {"task"}},
      {"requirement", {"task", "minimum_performance"}, {"task"}},
      {"exclusivity", {"mutually_exclusive"}, {"mutually_exclusive"}}};
  return shapes;
}

std::unique_ptr<CatalogOutline> CatalogOutline::read(const Lines& lines) {
  auto root = read_block_text(lines);
  if (!root || root->kind != Item::Kind::mapping) return nullptr;
  std::unique_ptr<CatalogOutline> outline(new CatalogOutline(lines));
  outline->root_ = std::move(*root);
  if (!outline->understand()) return nullptr;
  return outline;
}

void CatalogOutline::add(std::string_view shape, const Item& item) {
  for (const Shape& known : all_shapes()) {
    if (known.name == shape) mappings_.push_back({&known, &item});
  }
}

/// Published files write one key to an entry of a list.
void CatalogOutline::add_defaults(const Item& item, std::string_view shape,
                                  std::vector<const Item*>& found) {
  if (item.kind == Item::Kind::mapping) {
    add(shape, item);
    found.push_back(&item);
  }
  for (const Item& entry : item.items) add_defaults(entry, shape, found);
}

bool CatalogOutline::understand() {
  add("catalog", root_);
  if (const Field* defaults = root_.find("default_values")) {
    std::vector<const Item*> sections;
    add_defaults(defaults->value, "default_values", sections);
    for (const Item* section : sections) {
      if (const Field* field = section->find("tasks")) {
        add_defaults(field->value, "task defaults", task_defaults_);
      }
      if (const Field* field = section->find("behaviors")) {
        add_defaults(field->value, "behavior defaults", behavior_defaults_);
      }
    }
  }
  if (const Field* section = root_.find("tasks")) {
    for (const Item& entry : section->value.items) {
      const Field* name = entry.find("task");
      if (name == nullptr) return false;
      add("task", entry);
      add_task(name->value.text, &entry, name->line);
      if (const Field* parameters = entry.find("parameters")) {
        for (const Item& parameter : parameters->value.items) add("parameter", parameter);
      }
    }
  }
  const Field* section = root_.find("behaviors");
  if (section == nullptr) return false;
  for (const Item& entry : section->value.items) {
    if (entry.find("behavior") == nullptr) return false;
    if (const Field* task = entry.find("task")) {
      if (!find_task(task->value.text)) add_task(task->value.text, nullptr, task->line);
    } else if (const Field* tasks = entry.find("tasks")) {
      for (const Item& performance : tasks->value.items) {
        const Field* name = performance.find("task");
        if (name == nullptr) return false;
        if (!find_task(name->value.text)) add_task(name->value.text, nullptr, name->line);
      }
    } else {
      return false;
    }
  }
  for (Task& task : tasks_) read_attributes(task);
  for (const Item& entry : section->value.items) add_behavior(entry);
  if (const Field* lists = root_.find("exclusivity_constraints")) {
    for (const Item& entry : lists->value.items) {
      const Field* names = entry.find("mutually_exclusive");
      if (names == nullptr) return false;
      add("exclusivity", entry);
      list_entries_.push_back(&entry);
      lists_.emplace_back();
      for (const Item& name : names->value.items) {
        const auto task = find_task(name.text);
        if (!task) return false;
        lists_.back().push_back(*task);
      }
    }
  }
  for (const Behavior& behavior : behaviors_) {
    for (const Requirement& requirement : behavior.requirements) {
      if (requirement.task == unreached) return false;
    }
  }
  return true;
}

void CatalogOutline::add_task(const std::string& name, const Item* entry, std::size_t line) {
  if (const auto known = find_task(name)) {
    tasks_[*known].entry = entry;
    return;
  }
  Task task;
  task.name = name;
  task.entry = entry;
  task.name_line = line;
  tasks_.push_back(task);
}

/// What the task itself says counts before what is said for all, under whatever name.
const Field* CatalogOutline::attribute(const Task& task, std::string_view key,
                                       std::string_view older_key) const {
  for (const std::string_view name : {key, older_key}) {
    const Field* own = task.entry == nullptr ? nullptr : task.entry->find(name);
    if (own != nullptr) return own;
  }
  const Field* common = default_of_tasks(key);
  return common != nullptr ? common : default_of_tasks(older_key);
}

void CatalogOutline::read_attributes(Task& task) const {
  if (const Field* goal = attribute(task, "execution_goal", "category")) {
    task.keeps_running = goal->value.text == "keep_running" || goal->value.text == "recurrent";
  }
  if (const Field* flag = attribute(task, "reactive_start", "default")) {
    task.reactive_start = is_true(*flag);
  }
  if (const Field* flag = attribute(task, "start_on_request", "automatic_activation")) {
    task.start_on_request = is_true(*flag) == (flag->key == "start_on_request");
  }
  if (task.reactive_start && says(task, "reactive_start", "default") &&
      !says(task, "start_on_request", "automatic_activation")) {
    task.start_on_request = false;
  }
  if (const Field* timeout = attribute(task, "timeout", "timeout")) {
    task.timeout = timeout->value.text;
  }
  if (task.entry == nullptr) return;
  if (const Field* minimum = task.entry->find("minimum_performance")) {
    task.minimum = percent(*minimum);
  }
}

bool says(const Task& task, std::string_view key, std::string_view older_key) {
  return task.entry != nullptr &&
         (task.entry->find(key) != nullptr || task.entry->find(older_key) != nullptr);
}

void CatalogOutline::add_behavior(const Item& entry) {
  add("behavior", entry);
  Behavior behavior;
  behavior.name = entry.find("behavior")->value.text;
  behavior.entry = &entry;
  behavior.has_timeout = entry.find("timeout") != nullptr;
  double suitability = 1;
  const auto take = [&suitability](const Item& item) {
    for (const std::string_view key : {"efficacy", "suitability"}) {
      if (const Field* field = item.find(key)) suitability = percent(*field);
    }
  };
  for (const Item* defaults : behavior_defaults_) take(*defaults);
  take(entry);
  if (const Field* task = entry.find("task")) {
    behavior.performs.push_back({*find_task(task->value.text), suitability});
  } else {
    const double common = suitability;
    for (const Item& performance : entry.find("tasks")->value.items) {
      add("performance", performance);
      suitability = common;
      take(performance);
      behavior.performs.push_back({*find_task(performance.find("task")->value.text), suitability});
    }
  }
  if (const Field* requirements = entry.find("requires")) {
    for (const Item& item : requirements->value.items) {
      const Field* name = item.find("task");
      if (name == nullptr) continue;
      add("requirement", item);
      const Field* minimum = item.find("minimum_performance");
      behavior.requirements.push_back({find_task(name->value.text).value_or(unreached),
                                       minimum == nullptr ? 0 : percent(*minimum), &item, name});
    }
  }
  behaviors_.push_back(std::move(behavior));
}

std::optional<std::size_t> CatalogOutline::find_task(std::string_view name) const {
  for (std::size_t index = 0; index < tasks_.size(); ++index) {
    if (tasks_[index].name == name) return index;
  }
  return std::nullopt;
}

const Field* CatalogOutline::default_of_tasks(std::string_view key) const {
  for (const Item* defaults : task_defaults_) {
    if (const Field* field = defaults->find(key)) return field;
  }
  return nullptr;
}

bool CatalogOutline::excludes(std::size_t task, std::size_t other) const {
  if (task == other) return false;
  return std::any_of(lists_.begin(), lists_.end(), [&](const std::vector<std::size_t>& list) {
    return std::find(list.begin(), list.end(), task) != list.end() &&
           std::find(list.begin(), list.end(), other) != list.end();
  });
}

namespace {

/// The number of requirements from each task to `target`, which is 0 for itself.
std::vector<std::size_t> distances_to(const CatalogOutline& catalog, std::size_t target) {
  std::vector<std::size_t> distance(catalog.tasks().size(), unreached);
  distance[target] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (const Behavior& behavior : catalog.behaviors()) {
      for (const Requirement& requirement : behavior.requirements) {
        if (distance[requirement.task] == unreached) continue;
        for (const Performance& performance : behavior.performs) {
          if (distance[performance.task] <= distance[requirement.task] + 1) continue;
          distance[performance.task] = distance[requirement.task] + 1;
          changed = true;
        }
      }
    }
  }
  return distance;
}

}  // namespace

bool CatalogOutline::reaches(std::size_t task, std::size_t other) const {
  const std::vector<std::size_t> distance = distances_to(*this, other);
  for (const Behavior& behavior : behaviors_) {
    if (!performs(behavior, task)) continue;
    for (const Requirement& requirement : behavior.requirements) {
      if (distance[requirement.task] != unreached) return true;
    }
  }
  return false;
}

bool CatalogOutline::requires_task(const Behavior& behavior, std::size_t task) const {
  return std::any_of(behavior.requirements.begin(), behavior.requirements.end(),
                     [task](const Requirement& requirement) { return requirement.task == task; });
}

bool CatalogOutline::is_exclusive(const Behavior& behavior, std::size_t required) const {
  return std::all_of(
      behavior.performs.begin(), behavior.performs.end(),
      [&](const Performance& performance) { return excludes(performance.task, required); });
}

std::size_t CatalogOutline::count_exclusive_requirements() const {
  std::size_t count = 0;
  for (const Behavior& behavior : behaviors_) {
    std::set<std::size_t> tasks;
    for (const Requirement& requirement : behavior.requirements) {
      if (is_exclusive(behavior, requirement.task)) tasks.insert(requirement.task);
    }
    count += tasks.size();
  }
  return count;
}

std::set<std::size_t> CatalogOutline::lines_of_first_steps() const {
  std::size_t shortest = unreached;
  std::set<std::size_t> lines;
  for (std::size_t task = 0; task < tasks_.size(); ++task) {
    const std::vector<std::size_t> distance = distances_to(*this, task);
    std::size_t own = unreached;
    std::set<std::size_t> own_lines;
    for (const Behavior& behavior : behaviors_) {
      if (!performs(behavior, task)) continue;
      for (const Requirement& requirement : behavior.requirements) {
        const std::size_t length = distance[requirement.task];
        if (length == unreached || length > own) continue;
        if (length < own) own_lines.clear();
        own = length;
        own_lines.insert(requirement.name->line);
      }
    }
    if (own == unreached || own >= shortest) continue;
    shortest = own;
    lines = own_lines;
  }
  return lines;
}

double CatalogOutline::most_performance(std::size_t task) const {
  double most = 0;
  for (const Behavior& behavior : behaviors_) {
    for (const Performance& performance : behavior.performs) {
      if (performance.task != task) continue;
      double least_below = 1;
      for (const Requirement& requirement : behavior.requirements) {
        least_below = std::min(least_below, most_performance(requirement.task));
      }
      most = std::max(most, performance.suitability * least_below);
    }
  }
  return most;
}

bool CatalogOutline::can_run(std::size_t task, std::optional<std::size_t> behavior) const {
  return Witness(*this).search(task, behavior);
}

bool CatalogOutline::is_live(std::size_t behavior) const {
  const auto& performed = behaviors_[behavior].performs;
  return std::any_of(performed.begin(), performed.end(), [&](const Performance& performance) {
    return can_run(performance.task, behavior);
  });
}

bool CatalogOutline::is_live(const Behavior& behavior) const {
  return is_live(static_cast<std::size_t>(&behavior - behaviors_.data()));
}

}  // namespace cbc::mutation
