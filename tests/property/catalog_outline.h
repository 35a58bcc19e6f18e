// What a catalog in block style says, and what follows from it by the definition of catalogs, found
// in simple ways, without the code under test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "block_text.h"

namespace cbc::mutation {

/// A kind of mapping in a catalog.
struct Shape {
  std::string_view name;
  std::vector<std::string_view> keys;
  std::vector<std::string_view> required;
};

struct Mapping {
  const Shape* shape;
  const Item* item;
};

/// The kinds of mappings, by the specification.
[[nodiscard]] const std::vector<Shape>& all_shapes();

struct Task {
  std::string name;
  const Item* entry = nullptr;  ///< nullptr: only behaviors name it
  std::size_t name_line = 0;    ///< where it is first named
  bool keeps_running = false;
  bool start_on_request = true;
  bool reactive_start = false;
  std::string timeout;  ///< as it is written; empty: none
  double minimum = 0;   ///< of performance, 0 to 1
};

/// Whether the entry of the task itself has one of the keys.
[[nodiscard]] bool says(const Task& task, std::string_view key, std::string_view older_key);

struct Performance {
  std::size_t task;
  double suitability;  ///< 0 to 1
};

struct Requirement {
  std::size_t task;
  double minimum;
  const Item* entry;
  const Field* name;
};

struct Behavior {
  std::string name;
  const Item* entry;
  std::vector<Performance> performs;
  std::vector<Requirement> requirements;
  bool has_timeout = false;
};

[[nodiscard]] bool performs(const Behavior& behavior, std::size_t task);

class CatalogOutline {
 public:
  /// Nothing if the text is not in the style that is understood here, or names something undefined.
  [[nodiscard]] static std::unique_ptr<CatalogOutline> read(const Lines& lines);

  [[nodiscard]] const Lines& lines() const { return lines_; }
  [[nodiscard]] const Item& root() const { return root_; }
  [[nodiscard]] const std::vector<Mapping>& mappings() const { return mappings_; }
  [[nodiscard]] const std::vector<Task>& tasks() const { return tasks_; }
  [[nodiscard]] const std::vector<Behavior>& behaviors() const { return behaviors_; }
  /// The entries of exclusivity_constraints, and the tasks of each.
  [[nodiscard]] const std::vector<const Item*>& list_entries() const { return list_entries_; }
  [[nodiscard]] const std::vector<std::vector<std::size_t>>& lists() const { return lists_; }

  [[nodiscard]] std::optional<std::size_t> find_task(std::string_view name) const;
  /// A value that is given for all tasks, or nothing.
  [[nodiscard]] const Field* default_of_tasks(std::string_view key) const;

  [[nodiscard]] bool excludes(std::size_t task, std::size_t other) const;
  /// Whether a behavior of `task` requires `other`, or what it requires does.
  [[nodiscard]] bool reaches(std::size_t task, std::size_t other) const;
  [[nodiscard]] bool requires_task(const Behavior& behavior, std::size_t task) const;
  /// Whether the required task excludes all the tasks of the behavior.
  [[nodiscard]] bool is_exclusive(const Behavior& behavior, std::size_t required) const;
  [[nodiscard]] std::size_t count_exclusive_requirements() const;

  /// The lines at which one of the shortest cycles may be reported: those of the requirements of
  /// the first task in catalog order that a shortest cycle goes through, which lead on in one.
  [[nodiscard]] std::set<std::size_t> lines_of_first_steps() const;

  /// No performance of the task is better than this.
  [[nodiscard]] double most_performance(std::size_t task) const;

  /// Whether there is an assignment that satisfies all constraints in which the task runs, with the
  /// behavior of a place, if one is given. False, too, if none was found soon.
  [[nodiscard]] bool can_run(std::size_t task,
                             std::optional<std::size_t> behavior = std::nullopt) const;
  /// The same for a behavior with any of its tasks.
  [[nodiscard]] bool is_live(std::size_t behavior) const;
  [[nodiscard]] bool is_live(const Behavior& behavior) const;

 private:
  explicit CatalogOutline(Lines lines) : lines_(std::move(lines)) {}

  bool understand();
  void add(std::string_view shape, const Item& item);
  void add_defaults(const Item& item, std::string_view shape, std::vector<const Item*>& found);
  void add_task(const std::string& name, const Item* entry, std::size_t line);
  void read_attributes(Task& task) const;
  [[nodiscard]] const Field* attribute(const Task& task, std::string_view key,
                                       std::string_view older_key) const;
  void add_behavior(const Item& entry);

  Lines lines_;
  Item root_;
  std::vector<Mapping> mappings_;
  std::vector<const Item*> task_defaults_;
  std::vector<const Item*> behavior_defaults_;
  std::vector<Task> tasks_;
  std::vector<Behavior> behaviors_;
  std::vector<const Item*> list_entries_;
  std::vector<std::vector<std::size_t>> lists_;
};

}  // namespace cbc::mutation
