#include "versions/runs/run_comparison.h"

#include <utility>

#include "core/support/wording.h"
#include "runtime/base/text.h"
#include "runtime/coordinator/state.h"

namespace cbc {

std::string task_in_place_of(std::string_view task, std::string_view now, std::string_view before) {
  return concat(printable(task), ": ", in_place_of(now, before));
}

void AnswerCollector::on_event(const ExplainedRecord& record, const Step* step,
                               const State& state) {
  RunAnswer& answer = answers_.emplace_back();
  answer.time = record.time;
  answer.what = name_of(record.verb);
  if (record.task != none) {
    answer.what += " " + printable(catalog_.name_of_task(record.task));
  } else if (record.behavior != none) {
    answer.what += " " + printable(catalog_.name_of_behavior(record.behavior));
  }
  if (step != nullptr && form_of(record.verb).is_decided) answer.outcome = record.outcome;
  for (const std::uint32_t task : state.running()) {
    answer.running[std::string(catalog_.task_names[task])] =
        catalog_.name_of_behavior(state.behavior(catalog_.task_ids[task]));
  }
}

std::vector<RunAnswer> AnswerCollector::take() { return std::exchange(answers_, {}); }

void RunComparison::compare(const std::vector<RunAnswer>& before,
                            const std::vector<RunAnswer>& now) {
  if (!before.empty() && !now.empty()) {
    const RunAnswer& old_one = before.front();
    const RunAnswer& new_one = now.front();
    if (old_one.outcome && new_one.outcome && old_one.outcome != new_one.outcome) {
      lines_.push_back({old_one.time, old_one.what,
                        in_place_of(name_of(*new_one.outcome), name_of(*old_one.outcome))});
    }
  }
  // The last answers of both at each time.
  std::map<Microseconds, std::pair<const RunAnswer*, const RunAnswer*>> at_time;
  for (const RunAnswer& answer : before) at_time[answer.time].first = &answer;
  for (const RunAnswer& answer : now) at_time[answer.time].second = &answer;
  for (const auto& [time, answers] : at_time) {
    const auto& [old_one, new_one] = answers;
    if (old_one != nullptr) before_ = old_one->running;
    if (new_one != nullptr) now_ = new_one->running;
    compare_running(time, (new_one != nullptr ? new_one : old_one)->what);
  }
}

void RunComparison::compare_running(Microseconds time, const std::string& event) {
  std::map<std::string, std::pair<std::string, std::string>> behaviors;  // by task: before, now
  for (const auto& [task, behavior] : before_) behaviors[task].first = behavior;
  for (const auto& [task, behavior] : now_) behaviors[task].second = behavior;
  std::map<std::string, std::string> differences;
  for (const auto& [task, both] : behaviors) {
    if (both.first == both.second) continue;
    std::string words = task_in_place_of(task, both.second, both.first);
    const auto known = differences_.find(task);
    if (known == differences_.end() || known->second != words) {
      lines_.push_back({time, event, words});
    }
    differences.emplace(task, std::move(words));
  }
  std::vector<std::string> alike;
  for (const auto& [task, words] : differences_) {
    if (!differences.contains(task)) alike.push_back(printable(task));
  }
  if (!alike.empty()) {
    lines_.push_back({time, event, "as in the log again: " + join(alike, ", "), true});
  }
  differences_ = std::move(differences);
}

std::size_t RunComparison::events() const {
  std::size_t count = 0;
  const Line* before = nullptr;
  for (const Line& line : lines_) {
    if (line.is_end) continue;
    if (before == nullptr || before->time != line.time || before->event != line.event) ++count;
    before = &line;
  }
  return count;
}

}  // namespace cbc
