#include "unit/compiled_fixture.h"

#include <algorithm>
#include <optional>

#include <gtest/gtest.h>

#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "unit/findings.h"

namespace cbc::test {
namespace {

std::uint32_t found_or_zero(std::optional<std::uint32_t> index, std::string_view name) {
  EXPECT_TRUE(index) << name;
  return index.value_or(0);
}

/// The domain word of a value.
std::uint64_t& word_of(Problem& problem, const CompiledCatalog& catalog, TaskId task,
                       std::uint32_t index) {
  const TaskId first = catalog.group_tasks[problem.group];
  return problem.domains[catalog.words[task] - catalog.words[first] + index / 64];
}

}  // namespace

CompiledCatalog compile_text(std::string_view yaml) {
  Diagnostics diagnostics;
  const auto catalog = read_catalog(yaml, "a.yaml", diagnostics);
  EXPECT_TRUE(catalog.has_value()) << cbc::show(diagnostics);
  return compile(catalog.value_or(Catalog{}));
}

std::string chain_of_alternatives(int length) {
  std::string text = "behaviors:\n";
  for (int task = 0; task < length; ++task) {
    const std::string number = std::to_string(task);
    text += "- {behavior: alone" + number + ", task: T" + number + ", suitability: 1}\n";
    text += "- {behavior: with" + number + ", task: T" + number + ", suitability: 99.999";
    if (task + 1 < length) text += ", requires: [{task: T" + std::to_string(task + 1) + "}]";
    text += "}\n";
  }
  return text;
}

TaskId task_id(const CompiledCatalog& catalog, std::string_view name) {
  return catalog.task_ids[found_or_zero(catalog.find_task(name), name)];
}

BehaviorId behavior_id(const CompiledCatalog& catalog, std::string_view name) {
  return catalog.behavior_ids[found_or_zero(catalog.find_behavior(name), name)];
}

LocalTask local_task(const CompiledCatalog& catalog, std::string_view name) {
  const TaskId task = task_id(catalog, name);
  return task - catalog.group_tasks[catalog.tasks[task].group];
}

std::uint32_t value_index(const CompiledCatalog& catalog, std::string_view task,
                          std::string_view behavior) {
  const BehaviorId wanted = behavior_id(catalog, behavior);
  const auto values = catalog.values[task_id(catalog, task)];
  for (std::uint32_t index = 0; index < values.size(); ++index) {
    if (values[index].behavior == wanted) return index;
  }
  ADD_FAILURE() << behavior << " does not perform " << task;
  return none;
}

Problem open_problem(const CompiledCatalog& catalog, GroupId group) {
  Problem problem;
  problem.group = group;
  const TaskId first = catalog.group_tasks[group];
  const TaskId end = catalog.group_tasks[group + 1];
  problem.domains.assign(catalog.words[end] - catalog.words[first], 0);
  problem.may_stop.assign(end - first, 1);
  problem.present.assign(end - first, none);
  for (TaskId task = first; task < end; ++task) {
    for (std::uint32_t index = 0; index < catalog.values[task].size(); ++index) {
      word_of(problem, catalog, task, index) |= std::uint64_t{1} << (index % 64);
    }
  }
  return problem;
}

void demand(Problem& problem, const CompiledCatalog& catalog, std::string_view task) {
  problem.may_stop[local_task(catalog, task)] = 0;
}

void request(Problem& problem, const CompiledCatalog& catalog, std::string_view task) {
  problem.requests.push_back(local_task(catalog, task));
}

void set_present(Problem& problem, const CompiledCatalog& catalog, std::string_view task,
                 std::string_view behavior) {
  problem.present[local_task(catalog, task)] = value_index(catalog, task, behavior);
  const BehaviorId active = behavior_id(catalog, behavior);
  const auto index = std::lower_bound(problem.active.begin(), problem.active.end(), active);
  if (index == problem.active.end() || *index != active) problem.active.insert(index, active);
}

void leave_out(Problem& problem, const CompiledCatalog& catalog, std::string_view task,
               std::string_view behavior) {
  const std::uint32_t index = value_index(catalog, task, behavior);
  word_of(problem, catalog, task_id(catalog, task), index) &= ~(std::uint64_t{1} << (index % 64));
}

void leave_out_all(Problem& problem, const CompiledCatalog& catalog, std::string_view task) {
  for (const Value& value : catalog.values[task_id(catalog, task)]) {
    leave_out(problem, catalog, task, std::string(catalog.name_of_behavior(value.behavior)));
  }
}

std::string show(const CompiledCatalog& catalog, const Assignment& answer, GroupId group) {
  std::string text;
  for (LocalTask task(0); task < answer.size(); ++task) {
    if (answer[task] == none) continue;
    const TaskId id = catalog.group_tasks[group] + task;
    if (!text.empty()) text += " ";
    text += std::string(catalog.name_of_task(id)) + "=" +
            std::string(catalog.name_of_behavior(catalog.values[id][answer[task]].behavior));
  }
  return text;
}

Assignment answer_of(const CompiledCatalog& catalog, std::string_view text, GroupId group) {
  Assignment answer(catalog.group_tasks[group + 1] - catalog.group_tasks[group], none);
  while (!text.empty()) {
    const std::string_view entry = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), entry.size() + 1));
    const std::size_t sign = entry.find('=');
    const std::string_view task = entry.substr(0, sign);
    answer[local_task(catalog, task)] = value_index(catalog, task, entry.substr(sign + 1));
  }
  return answer;
}

}  // namespace cbc::test
