#include "bench/catalog_generator.h"

#include <iterator>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace cbc::bench {
namespace {

class Generator {
 public:
  explicit Generator(const CatalogShape& shape) : shape_(shape), random_(shape.seed) {}

  std::string run() {
    add("default_values:\n  tasks: {{start_on_request: FALSE}}\nbehaviors:\n");
    for (std::size_t level = 0; level < shape_.levels; ++level) {
      for (std::size_t place = 0; place < shape_.tasks; ++place) write_behaviors(level, place);
    }
    add("- behavior: empty\n  task: empty\ntasks:\n");
    for (std::size_t task = 0; task < task_count(); ++task) add("- task: task{}\n", name(task));
    add("- task: empty\nexclusivity_constraints:\n");
    for (std::size_t list = 0; list < shape_.exclusions * shape_.levels; ++list) write_list();
    for (std::size_t task = 0; task < task_count(); ++task) {
      add("- mutually_exclusive: [empty, task{}]\n", name(task));
    }
    return std::move(text_);
  }

 private:
  template <typename... Values>
  void add(fmt::format_string<const Values&...> pattern, const Values&... values) {
    fmt::format_to(std::back_inserter(text_), pattern, values...);
  }

  [[nodiscard]] std::size_t task_count() const { return shape_.levels * shape_.tasks; }
  [[nodiscard]] std::string name(std::size_t task) const {
    return fmt::format("{}_{}", task / shape_.tasks, task % shape_.tasks);
  }

  // The distributions of the standard library are not the same everywhere.
  std::size_t below(std::size_t bound) { return static_cast<std::size_t>(random_() % bound); }

  std::size_t take_one(std::vector<std::size_t>& tasks) {
    const auto chosen = tasks.begin() + static_cast<std::ptrdiff_t>(below(tasks.size()));
    const std::size_t task = *chosen;
    tasks.erase(chosen);
    return task;
  }

  void write_behaviors(std::size_t level, std::size_t place) {
    const std::size_t task = level * shape_.tasks + place;
    for (std::size_t behavior = 0; behavior < shape_.behaviors; ++behavior) {
      add("- behavior: behavior{}_{}\n  task: task{}\n  suitability: {}\n", name(task), behavior,
          name(task), 60 + below(40));
      std::vector<std::size_t> lower;
      for (std::size_t other = (level + 1) * shape_.tasks; other < task_count(); ++other) {
        lower.push_back(other);
      }
      if (lower.empty() || shape_.requirements == 0) continue;
      add("  requires:\n");
      for (std::size_t i = 0; i < shape_.requirements && !lower.empty(); ++i) {
        const std::size_t required = take_one(lower);
        requirements_.emplace(task, required);
        add("  - task: task{}\n", name(required));
      }
    }
  }

  [[nodiscard]] bool requires_any(std::size_t task, const std::vector<std::size_t>& others) const {
    for (const std::size_t other : others) {
      if (requirements_.count({task, other}) + requirements_.count({other, task}) > 0) return true;
    }
    return false;
  }

  void write_list() {
    std::vector<std::size_t> candidates;
    for (std::size_t task = 0; task < task_count(); ++task) candidates.push_back(task);
    std::vector<std::size_t> list;
    while (list.size() < shape_.exclusions && !candidates.empty()) {
      const std::size_t task = take_one(candidates);
      if (!requires_any(task, list)) list.push_back(task);
    }
    if (list.size() < 2) return;
    add("- mutually_exclusive:\n");
    for (const std::size_t task : list) add("  - task{}\n", name(task));
  }

  const CatalogShape shape_;
  std::mt19937_64 random_;
  std::set<std::pair<std::size_t, std::size_t>> requirements_;  ///< (task, required task)
  std::string text_;
};

}  // namespace

std::string generate_catalog(const CatalogShape& shape) { return Generator(shape).run(); }

}  // namespace cbc::bench
