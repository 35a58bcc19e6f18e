#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/words/suitability.h"
#include "support/read_file.h"
#include "support/shared_folder.h"
#include "unit/stage.h"

// Catalogs published with the original tool, if they are at hand.

namespace cbc::published_test {
namespace {

/// The best suitability at which a task can be started while nothing runs: goes through all
/// closures of the task, that is all ways to choose a behavior for it, for what that requires, and
/// so on.
class Closures {
 public:
  explicit Closures(const CompiledCatalog& catalog) : catalog_(catalog) {}

  /// Below 0: there is none.
  double best_of(TaskId task) {
    best_ = -1;
    chosen_.clear();
    descend({task}, 1);
    return best_;
  }

 private:
  void descend(std::vector<TaskId> open, double suitability) {
    // Suitability only falls on the way down; the margin is far over any rounding.
    if (suitability < best_ * (1 - 1e-12)) return;
    while (!open.empty() && chosen_.contains(open.back())) open.pop_back();
    if (open.empty()) {
      if (suitability > best_ && is_valid()) best_ = suitability;
      return;
    }
    const TaskId task = open.back();
    open.pop_back();
    // Only the first task starts on request; the others have to start by themselves.
    if (!chosen_.empty() && catalog_.tasks[task].start_on_request) return;
    for (const Value& value : catalog_.values[task]) {
      std::vector<TaskId> next = open;
      for (const CompiledRequirement& rule : catalog_.requirements[value.behavior]) {
        next.push_back(rule.task);
      }
      chosen_[task] = &value;
      descend(std::move(next), suitability * degree(value.suitability));
      chosen_.erase(task);
    }
  }

  static double degree(Millionths degree) { return static_cast<double>(degree) / one_million; }

  [[nodiscard]] bool is_valid() const {
    for (std::size_t clique = 0; clique < catalog_.cliques.size(); ++clique) {
      int running = 0;
      for (const TaskId task : catalog_.cliques[clique]) {
        if (chosen_.contains(task)) ++running;
      }
      if (running > 1) return false;
    }
    for (const auto& [task, value] : chosen_) {
      for (const CompiledRequirement& rule : catalog_.requirements[value->behavior]) {
        if (performance_of(rule.task) < degree(rule.minimum_performance) - 1e-9) return false;
      }
      if (performance_of(task) < degree(catalog_.tasks[task].minimum_performance) - 1e-9) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] double performance_of(TaskId task) const {
    std::map<TaskId, bool> seen;
    std::vector<TaskId> open{task};
    double product = 1;
    while (!open.empty()) {
      const TaskId member = open.back();
      open.pop_back();
      if (!seen.emplace(member, true).second) continue;
      const Value& value = *chosen_.at(member);
      product *= degree(value.suitability);
      for (const CompiledRequirement& rule : catalog_.requirements[value.behavior]) {
        open.push_back(rule.task);
      }
    }
    return product;
  }

  const CompiledCatalog& catalog_;
  std::map<TaskId, const Value*> chosen_;
  double best_ = -1;
};

class Published : public testing::TestWithParam<const char*> {};

TEST_P(Published, EveryStartFromIdleIsProvenOptimal) {
  const std::string name = GetParam();
  const std::filesystem::path file = test::shared_catalogs() / (name + ".yaml");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const std::string yaml = test::read_file(file);
  const bool is_artificial = name.rfind("creator", 0) == 0;
  int started = 0;
  const test::Stage model(yaml);
  Closures closures(model.catalog());
  for (const std::string_view task : model.catalog().task_names) {
    if (is_artificial && task.rfind("task0_", 0) != 0) continue;
    ++started;
    test::Stage stage(yaml);
    EXPECT_EQ(stage.start(task), "accepted") << task;
    EXPECT_EQ(stage.searches().substr(0, stage.searches().find(' ')), "optimal") << task;
    const TaskId id = stage.catalog().task_ids[stage.catalog().find_task(task).value_or(0)];
    const double best = closures.best_of(id);
    EXPECT_NEAR(total_suitability(stage.catalog(), stage.state()), best, best * 1e-12) << task;
  }
  EXPECT_GT(started, 0);
  if (is_artificial) {
    // The first digit of the name.
    EXPECT_EQ(started, name[std::string_view("creator").size()] - '0');
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogs, Published,
                         testing::Values("creator32230", "creator43232", "creator63233",
                                         "creator63333", "creator93233", "creator93333",
                                         "behavior_catalog"),
                         [](const auto& catalog) { return std::string(catalog.param); });

}  // namespace
}  // namespace cbc::published_test
