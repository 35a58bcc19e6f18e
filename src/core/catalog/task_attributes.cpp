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
  apply_rules(own, task);
  const bool is_certain = !task.is_unclear || (own.start_on_request && own.reactive_start);
  if (flags.start_on_request && flags.reactive_start && is_certain) {
    report_both_flags(range, own, task);
  }
}

/// A default `resume` does not reach the tasks of which it could not be said.
void TaskAttributes::apply_rules(const GivenAttributes& own, Task& task) {
  TaskRules& rules = task.rules;
  if (own.requestable) rules.requestable = own.requestable->value ? 1 : 0;
  if (own.reactive_priority) {
    rules.reactive_priority = task.reactive_start ? own.reactive_priority->value : 0;
    task.reactive_priority_range = own.reactive_priority->range;
  }
  if (const auto& improve = own.improve ? own.improve : defaults_.improve) {
    rules.improve = improve->value;
    task.improve_range = improve->range;
  }
  if (own.improve) task.own_improve_range = own.improve->range;
  const bool may_resume =
      rules.requestable != 0 && !task.reactive_start && rules.improve != Improve::when_started;
  if (own.resume) {
    rules.resume = own.resume->value ? 1 : 0;
    task.own_resume_range = own.resume->range;
  } else if (defaults_.resume) {
    rules.resume = defaults_.resume->value && may_resume ? 1 : 0;
  }
  if (!task.is_unclear) report_rules(own, task);
}

void TaskAttributes::report_rules(const GivenAttributes& own, const Task& task) {
  const std::string name = "task " + quote(task.name);
  if (task.rules.requestable == 0 && task.start_on_request) {
    reporter_.report(rule::unrequestable, own.requestable->range,
                     name + " can never run: it starts only on request, and nobody can request it");
  }
  if (own.reactive_priority && !task.reactive_start && !own.has_unknown_key) {
    reporter_.report(rule::priority_without_reaction, own.reactive_priority->range,
                     name +
                         " has a reactive_priority, but no reactive_start: it never starts by "
                         "itself as a reaction");
  }
  if (!own.resume || !own.resume->value) return;
  const auto report = [&](const std::string& reason) {
    reporter_.report(rule::cannot_resume, own.resume->range, name + " cannot resume: " + reason);
  };
  if (task.rules.requestable == 0) {
    report("nobody can request it, so there is no request to be kept");
  } else if (task.reactive_start) {
    report("it starts by itself (reactive_start)");
  } else if (task.rules.improve == Improve::when_started) {
    report("what gets better only when somebody starts it does not come back unasked (improve)");
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
  const auto rules = [this](const TaskEntry& entry) {
    Task task;
    task.is_unclear = true;  // reports nothing
    const Flags flags = flags_of(entry.attributes, defaults_);
    task.reactive_start = flags.reactive_start;
    TaskAttributes(defaults_, reporter_).apply_rules(entry.attributes, task);
    return task.rules;
  };
  const TaskRules old_rules = rules(before);
  const TaskRules new_rules = rules(now);
  changes.compare("requestable", name_of(old_rules.requestable != 0),
                  name_of(new_rules.requestable != 0));
  changes.compare("reactive_priority", std::to_string(old_rules.reactive_priority),
                  std::to_string(new_rules.reactive_priority));
  changes.compare("improve", std::string(word_of(old_rules.improve)),
                  std::string(word_of(new_rules.improve)));
  changes.compare("resume", name_of(old_rules.resume != 0), name_of(new_rules.resume != 0));
  if (!same_parameters(before.parameters, now.parameters)) {
    changes.add(now.parameters.empty() ? "no parameters" : "other parameters");
  }
  return changes.text();
}

}  // namespace cbc
