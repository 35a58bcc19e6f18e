#include "core/catalog/task_attributes.h"

#include <algorithm>
#include <utility>

#include "core/diagnostic/rules.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

struct Flags {
  bool start_on_request = true;
  bool reactive_start = false;
};

Flags flags_of(const GivenAttributes& own, const GivenAttributes& defaults) {
  Flags flags;
  if (own.reactive_start) {
    flags.reactive_start = own.reactive_start->value;
  } else if (defaults.reactive_start) {
    flags.reactive_start = defaults.reactive_start->value;
  }
  if (own.start_on_request) {
    flags.start_on_request = own.start_on_request->value;
  } else if (own.reactive_start && own.reactive_start->value) {
    flags.start_on_request = false;
  } else if (defaults.start_on_request) {
    flags.start_on_request = defaults.start_on_request->value;
  }
  return flags;
}

std::string name_of(ExecutionGoal goal) {
  return goal == ExecutionGoal::achieve_goal ? "achieve_goal" : "keep_running";
}

std::string name_of(bool flag) { return flag ? "TRUE" : "FALSE"; }

std::string name_of(const std::optional<Timeout>& timeout) {
  return timeout ? format_decimal(timeout->value, 6) + " s" : "none";
}

std::string name_of_minimum(const Percent& minimum) {
  return minimum.value == 0 ? "none" : format_decimal(minimum.value, 4) + " %";
}

bool same_parameters(const std::vector<Parameter>& a, const std::vector<Parameter>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Parameter& x, const Parameter& y) {
                      return x.name == y.name && allow_the_same(x, y);
                    });
}

class Changes {
 public:
  void compare(const std::string& attribute, const std::string& before, const std::string& now) {
    if (before != now) add(attribute + " " + now + ", was " + before);
  }

  void add(const std::string& change) {
    if (!text_.empty()) text_ += "; ";
    text_ += change;
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace

void TaskAttributes::apply(const Range& range, const GivenAttributes& own, Task& task) {
  task.is_unclear = own.is_unclear || defaults_.is_unclear;
  const Flags flags = flags_of(own, defaults_);
  task.start_on_request = flags.start_on_request;
  task.reactive_start = flags.reactive_start;
  task.execution_goal =
      own.execution_goal.value_or(defaults_.execution_goal.value_or(ExecutionGoal::achieve_goal));
  if (own.timeout) task.own_timeout_range = own.timeout->range;
  if (const auto& timeout = own.timeout ? own.timeout : defaults_.timeout) {
    task.timeout = timeout->value;
  }
  const bool is_certain = !task.is_unclear || (own.start_on_request && own.reactive_start);
  if (flags.start_on_request && flags.reactive_start && is_certain) {
    report_both_flags(range, own, task);
  }
}

// The place of the finding is the flag that the task itself gives; if it gives none, that of the
// defaults, once for all tasks.
void TaskAttributes::report_both_flags(const Range& range, const GivenAttributes& own,
                                       const Task& task) {
  if (!own.start_on_request && !own.reactive_start) {
    reporter_.report(rule::on_request_and_reactive, defaults_.reactive_start->range,
                     "by default tasks have both reactive_start and start_on_request; one of them "
                     "must be FALSE",
                     {reporter_.note(range, "task " + quote(task.name) + " has both of them")});
    return;
  }
  const std::string message = "task " + quote(task.name) +
                              " has both reactive_start and start_on_request; one of them must be "
                              "FALSE";
  std::vector<Note> notes;
  Range place = range;
  if (own.start_on_request && own.reactive_start) {
    place = std::max(own.reactive_start->range, own.start_on_request->range);
    notes.push_back(reporter_.note(std::min(own.reactive_start->range, own.start_on_request->range),
                                   "the other one is given here"));
  } else if (own.start_on_request) {
    place = own.start_on_request->range;
    notes.push_back(reporter_.note(defaults_.reactive_start->range,
                                   "reactive_start is given here for all tasks"));
  }
  reporter_.report(rule::on_request_and_reactive, place, message, std::move(notes));
}

std::string TaskAttributes::describe_changes(const TaskEntry& before, const TaskEntry& now) const {
  const auto goal = [this](const TaskEntry& task) {
    return name_of(task.attributes.execution_goal.value_or(
        defaults_.execution_goal.value_or(ExecutionGoal::achieve_goal)));
  };
  const auto timeout = [this](const TaskEntry& task) {
    return name_of(task.attributes.timeout ? task.attributes.timeout : defaults_.timeout);
  };
  const Flags old_flags = flags_of(before.attributes, defaults_);
  const Flags new_flags = flags_of(now.attributes, defaults_);
  Changes changes;
  changes.compare("execution_goal", goal(before), goal(now));
  changes.compare("start_on_request", name_of(old_flags.start_on_request),
                  name_of(new_flags.start_on_request));
  changes.compare("reactive_start", name_of(old_flags.reactive_start),
                  name_of(new_flags.reactive_start));
  changes.compare("timeout", timeout(before), timeout(now));
  changes.compare("minimum_performance", name_of_minimum(before.minimum_performance),
                  name_of_minimum(now.minimum_performance));
  if (!same_parameters(before.parameters, now.parameters)) {
    changes.add(now.parameters.empty() ? "no parameters" : "other parameters");
  }
  return changes.text();
}

}  // namespace cbc
