#include "script/expectation.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "text/quote.h"

namespace cbc {
namespace {

class Mismatches {
 public:
  void add(std::string_view text) {
    if (!text_.empty()) text_ += "; ";
    text_ += text;
  }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

std::string describe_task(const CompiledCatalog& catalog, const State& state, TaskId task) {
  if (!state.is_running(task)) return "it does not run";
  return fmt::format("it runs with {}", quote(catalog.name_of_behavior(state.behavior(task))));
}

std::string join_names(const CompiledCatalog& catalog,
                       const std::vector<std::uint32_t>& behaviors) {
  if (behaviors.empty()) return "none";
  std::string text;
  for (const std::uint32_t behavior : behaviors) {
    if (!text.empty()) text += ", ";
    text += quote(catalog.behavior_names[behavior]);
  }
  return text;
}

void check_running(const Expectation::Running& expected, const CompiledCatalog& catalog,
                   const State& state, Mismatches& mismatches) {
  const TaskId task = catalog.task_ids[expected.task];
  const bool holds = expected.behavior
                         ? state.behavior(task) == catalog.behavior_ids[*expected.behavior]
                         : state.is_running(task);
  if (holds) return;
  const std::string wanted =
      expected.behavior ? fmt::format(" with {}", quote(catalog.behavior_names[*expected.behavior]))
                        : "";
  mismatches.add(fmt::format("expected task {} to run{}, but {}",
                             quote(catalog.task_names[expected.task]), wanted,
                             describe_task(catalog, state, task)));
}

void check_active(std::vector<std::uint32_t> expected, const CompiledCatalog& catalog,
                  const State& state, Mismatches& mismatches) {
  std::vector<std::uint32_t> active;
  for (std::uint32_t behavior = 0; behavior < catalog.behavior_names.size(); ++behavior) {
    if (state.is_active(catalog.behavior_ids[behavior])) active.push_back(behavior);
  }
  std::sort(expected.begin(), expected.end());
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
  if (active == expected) return;
  mismatches.add(fmt::format("expected the active behaviors to be {}, but they are {}",
                             join_names(catalog, expected), join_names(catalog, active)));
}

}  // namespace

std::string find_mismatch(const Expectation& expectation, const CompiledCatalog& catalog,
                          const State& state, std::optional<Outcome> outcome) {
  Mismatches mismatches;
  if (expectation.outcome && outcome != expectation.outcome) {
    mismatches.add(fmt::format("expected outcome '{}', but {}", name_of(*expectation.outcome),
                               outcome ? fmt::format("it is '{}'", name_of(*outcome))
                                       : "there was no start, stop or finish yet"));
  }
  for (const Expectation::Running& expected : expectation.running) {
    check_running(expected, catalog, state, mismatches);
  }
  for (const std::uint32_t index : expectation.stopped) {
    const TaskId task = catalog.task_ids[index];
    if (!state.is_running(task)) continue;
    mismatches.add(fmt::format("expected task {} not to run, but {}",
                               quote(catalog.task_names[index]),
                               describe_task(catalog, state, task)));
  }
  if (expectation.active) check_active(*expectation.active, catalog, state, mismatches);
  return mismatches.take();
}

}  // namespace cbc
