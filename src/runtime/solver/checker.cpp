#include "runtime/solver/checker.h"

#include <algorithm>

#include "runtime/base/text.h"

namespace cbc {

Checker::Checker(const CompiledCatalog& catalog)
    : catalog_(catalog),
      clique_marks_(catalog.cliques.size(), 0),
      clique_holders_(catalog.cliques.size()),
      running_(catalog.limits.size()),
      closure_marks_(catalog.tasks.size(), 0) {}

std::optional<std::string> Checker::find_violation(const Problem& problem,
                                                   const Assignment& answer) {
  answer_ = &answer;
  first_task_ = catalog_.group_tasks[problem.group];
  end_task_ = catalog_.group_tasks[problem.group + 1];
  if (answer.size() != end_task_ - first_task_) return "the answer has another number of tasks";
  if (auto violation = check_domains(problem)) return violation;
  if (auto violation = check_exclusivity()) return violation;
  if (auto violation = check_limits()) return violation;
  return check_requirements();
}

void Checker::stop_violating_tasks(const Problem& problem, Assignment& answer) {
  while (find_violation(problem, answer)) answer[violating_ - first_task_] = none;
}

BehaviorId Checker::behavior_of(TaskId task) const {
  const std::uint32_t index = (*answer_)[task - first_task_];
  return index == none ? none : catalog_.values[task][index].behavior;
}

bool Checker::is_in_domain(const Problem& problem, TaskId task) const {
  const std::uint32_t index = (*answer_)[task - first_task_];
  if (index == none) return problem.may_stop[task - first_task_] != 0;
  if (index >= catalog_.values[task].size()) return false;
  const std::size_t word = catalog_.words[task] - catalog_.words[first_task_] + index / 64;
  return ((problem.domains[word] >> (index % 64)) & 1) != 0;
}

std::optional<std::string> Checker::check_domains(const Problem& problem) {
  for (TaskId task = first_task_; task < end_task_; ++task) {
    violating_ = task;
    if (!is_in_domain(problem, task)) {
      return concat("task ", quote(catalog_.name_of_task(task)), " has a value outside its domain");
    }
  }
  return std::nullopt;
}

std::optional<std::string> Checker::check_exclusivity() {
  ++number_;
  for (TaskId task = first_task_; task < end_task_; ++task) {
    violating_ = task;
    if (behavior_of(task) == none) continue;
    for (const std::uint32_t clique : catalog_.task_cliques[task]) {
      if (clique_marks_[clique] == number_) {
        return concat(describe(clique_holders_[clique]), " and ", describe(task),
                      " exclude one another");
      }
      clique_marks_[clique] = number_;
      clique_holders_[clique] = task;
    }
  }
  return std::nullopt;
}

std::optional<std::string> Checker::check_limits() {
  if (catalog_.limits.empty()) return std::nullopt;
  std::fill(running_.begin(), running_.end(), 0);
  for (TaskId task = first_task_; task < end_task_; ++task) {
    violating_ = task;
    if (behavior_of(task) == none) continue;
    for (const std::uint32_t limit : catalog_.limits_of(task)) {
      if (++running_[limit] <= catalog_.limits[limit].most) continue;
      return concat(describe(task), " is one more than may run (line ", catalog_.limits[limit].line,
                    ")");
    }
  }
  return std::nullopt;
}

std::optional<std::string> Checker::check_requirements() {
  for (TaskId task = first_task_; task < end_task_; ++task) {
    violating_ = task;
    const BehaviorId behavior = behavior_of(task);
    if (behavior == none) continue;
    if (!performs_at_least(task, catalog_.tasks[task].minimum_performance)) {
      return concat(describe(task), " is below its minimum performance");
    }
    for (const CompiledRequirement& requirement : catalog_.requirements[behavior]) {
      if (behavior_of(requirement.task) == none) {
        return concat(describe(task), " requires task ",
                      quote(catalog_.name_of_task(requirement.task)), ", which does not run");
      }
      if (!performs_at_least(requirement.task, requirement.minimum_performance)) {
        return concat(describe(task), " requires more of ", describe(requirement.task), " (line ",
                      catalog_.line_of(requirement), ")");
      }
    }
  }
  return std::nullopt;
}

/// Computes the performance (docs/semantics.md, "Performance") as an exact number in base 10^6 with
/// one digit for each factor below 1: the highest digit is floor(performance * 10^6).
bool Checker::performs_at_least(TaskId task, Millionths minimum) {
  if (minimum == 0) return true;
  ++number_;
  closure_.assign(1, task);
  closure_marks_[task] = number_;
  digits_.clear();
  for (std::size_t next = 0; next < closure_.size(); ++next) {
    const TaskId member = closure_[next];
    const BehaviorId behavior = behavior_of(member);
    if (behavior == none) return false;
    const Millionths suitability =
        catalog_.values[member][(*answer_)[member - first_task_]].suitability;
    if (suitability != one_million) {
      std::uint64_t carry = digits_.empty() ? suitability : 0;
      for (std::uint32_t& digit : digits_) {
        carry += std::uint64_t{digit} * suitability;
        digit = static_cast<std::uint32_t>(carry % one_million);
        carry /= one_million;
      }
      digits_.push_back(static_cast<std::uint32_t>(carry));
    }
    for (const CompiledRequirement& requirement : catalog_.requirements[behavior]) {
      if (closure_marks_[requirement.task] == number_) continue;
      closure_marks_[requirement.task] = number_;
      closure_.push_back(requirement.task);
    }
  }
  return digits_.empty() || digits_.back() >= minimum;
}

std::string Checker::describe(TaskId task) const {
  return concat("task ", quote(catalog_.name_of_task(task)), " with ",
                quote(catalog_.name_of_behavior(behavior_of(task))));
}

}  // namespace cbc
