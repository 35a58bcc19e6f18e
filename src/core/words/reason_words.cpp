#include "core/words/reason_words.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/support/wording.h"
#include "core/words/suitability.h"
#include "core/words/words.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

/// ", but it reaches 51.3 % at best (...)": how near to a minimum performance one can come.
std::string describe_best(const CompiledCatalog& catalog, const Reason& reason) {
  if (reason.best.empty()) return {};
  std::vector<Millionths> suitabilities;
  const auto factor = [&](ValueId id) {
    const Value& value = catalog.values.items[id];
    suitabilities.push_back(value.suitability);
    return fmt::format("{} {}", printable(catalog.name_of_behavior(value.behavior)),
                       format_percent(value.suitability));
  };
  const std::string factors = join(reason.best, ", ", factor);
  return fmt::format(", but it reaches {} % at best ({})", percent_of_product(suitabilities),
                     factors);
}

std::string place(const CompiledCatalog& catalog, const Reason& reason) {
  return place_in_catalog(catalog, reason.line);
}

/// "day, dusk or night": the values of a variable in which a behavior fits.
std::string fitting_values(const CompiledCatalog& catalog, const Reason& condition) {
  std::vector<std::string> names;
  for (const FittingValue& fitting : catalog.fitting_values_of(condition.behavior)) {
    if (fitting.variable != condition.variable) continue;
    names.push_back(printable(catalog.name_of_value({fitting.variable, fitting.value})));
  }
  return list_with_or(names);
}

std::string describe_misfit(const CompiledCatalog& catalog, const Reason& reason,
                            const std::string& behavior) {
  if (reason.value != none) {
    return fmt::format("{} does not fit: {}", behavior,
                       describe_value(catalog, {reason.variable, reason.value}));
  }
  return fmt::format("{} fits only where {} is {}", behavior,
                     printable(catalog.name_of_variable(reason.variable)),
                     fitting_values(catalog, reason));
}

std::string describe_protection(const EventRecord& record, const Reason& reason) {
  if (reason.is_from_any_request) {
    return reason.priority == 0
               ? "started by itself, and another reactive start never stops such a task"
               : "runs on request, and a reactive start never stops such a task";
  }
  const std::int32_t level = record.search != nullptr ? record.search->protection : record.priority;
  if (record.origin == Origin::reactive) {
    return fmt::format("runs with priority {}, not below that of this reaction, {}",
                       reason.priority, level);
  }
  if (record.verb == Verb::reconsider) {
    return fmt::format("runs with priority {}, and goes on", reason.priority);
  }
  if (record.verb == Verb::start || record.verb == Verb::stop) {
    return fmt::format("runs with priority {}, higher than {}", reason.priority, level);
  }
  // A finish has no priority of its own: see docs/semantics.md, "Finish".
  if (level == 0)
    return fmt::format("runs with priority {}, and goes on if it can", reason.priority);
  return fmt::format("runs with priority {}, and goes on before tasks of priority {} do",
                     reason.priority, level);
}

/// How a behavior ended that this event therefore does not choose.
std::string describe_finished(const CompiledCatalog& catalog, const EventRecord& record,
                              BehaviorId behavior) {
  const auto values = catalog.performs[behavior];
  const bool is_of_one = record.task != none || values.size() == 1;
  const std::string name = behavior_name(catalog, behavior);
  switch (record.cause) {
    case FinishCause::goal_achieved:
      return is_of_one
                 ? fmt::format(
                       "{} has just achieved its goal, so nothing performs it now",
                       task_name(catalog, record.task != none ? record.task
                                                              : catalog.task_of(values.front())))
                 : name + " has just achieved the goal of its tasks, so nothing performs them now";
    case FinishCause::time_out:
      return name + " has just timed out";
    case FinishCause::wrong_progress:
      return name + " has just ended for wrong progress";
    case FinishCause::process_failure:
      return name + " has just failed (process_failure)";
    case FinishCause::interrupted:
      return name + " has just been interrupted";
    case FinishCause::situation_change:
      return name + " has just ended, as the situation changed";
  }
  return {};
}

}  // namespace

std::string describe_kind(Reason::Kind kind, const std::string& behavior, const std::string& task,
                          const std::string& other_task) {
  switch (kind) {
    case Reason::Kind::priority:
      return task + " has its own request of higher priority";
    case Reason::Kind::no_behavior:
      return "no behavior performs " + task;
    case Reason::Kind::is_protected:
      return task + " is protected by its request";
    case Reason::Kind::exclusive:
      return fmt::format("{} excludes {}", task, other_task);
    case Reason::Kind::limited:
      return fmt::format("{} is in a list of which only some may run", task);
    case Reason::Kind::on_request:
      return task + " starts only on request, and is not requested";
    case Reason::Kind::requires_task:
      return fmt::format("{} requires {}", behavior, task);
    case Reason::Kind::performance:
      return fmt::format("{} requires a minimum performance of {}",
                         behavior.empty() ? "the catalog" : behavior, task);
    case Reason::Kind::unavailable:
      return behavior + " is unavailable";
    case Reason::Kind::situation:
      return behavior + " does not fit the situation";
    case Reason::Kind::faulty:
      return behavior + " is faulty";
    case Reason::Kind::not_retried:
      return behavior + " failed before, and is not tried again";
    case Reason::Kind::makes_worse:
      return fmt::format("nobody asked for {}, and for it what was asked for would run worse",
                         task);
    case Reason::Kind::not_improved:
      return fmt::format("{} keeps {} until it is started", task, behavior);
    case Reason::Kind::finished:
      return behavior + " has just ended";
    case Reason::Kind::stopped:
      return task + " is stopped by this event";
  }
  return {};
}

std::string describe_reason(const CompiledCatalog& catalog, const EventRecord& record,
                            const Reason& reason) {
  const auto name = [&](TaskId task) {
    return task == none ? std::string() : task_name(catalog, task);
  };
  const std::string task = name(reason.task);
  const std::string behavior =
      reason.behavior == none ? "" : behavior_name(catalog, reason.behavior);
  const std::string text = describe_kind(reason.kind, behavior, task, name(reason.other_task));
  switch (reason.kind) {
    case Reason::Kind::priority:
      return fmt::format("{} has a request of priority {}, higher than {}", task, reason.priority,
                         record.priority);
    case Reason::Kind::is_protected:
      return fmt::format("{} {}", task, describe_protection(record, reason));
    case Reason::Kind::on_request:
      return text + ": request it first";
    case Reason::Kind::exclusive:
    case Reason::Kind::requires_task:
    case Reason::Kind::not_improved:
      return text + place(catalog, reason);
    case Reason::Kind::limited: {
      std::vector<std::string> names;
      for (const TaskId member : catalog.limited[reason.limit]) {
        names.push_back(task_name(catalog, member));
      }
      return fmt::format("at most {} of {} run", catalog.limits[reason.limit].most,
                         list_with_and(names)) +
             place(catalog, reason);
    }
    case Reason::Kind::not_retried:
      return fmt::format("{} failed at {} s, and is not tried again before {}", behavior,
                         format_decimal(reason.time, 6),
                         catalog.retry_of(reason.behavior) == Retry::after_repair
                             ? "its repair"
                             : "its repair, or a start that risks nothing that runs") +
             place(catalog, reason);
    case Reason::Kind::performance:
      return fmt::format("{} requires {} with at least {}",
                         reason.behavior == none ? "the catalog" : behavior, task,
                         format_percent(reason.minimum_performance)) +
             place(catalog, reason) + describe_best(catalog, reason);
    case Reason::Kind::situation:
      return reason.variable == none ? text : describe_misfit(catalog, reason, behavior);
    case Reason::Kind::finished:
      return describe_finished(catalog, record, reason.behavior);
    default:
      return text;
  }
}

namespace {

/// A reason among others, and what is said of it.
struct Told {
  std::string text;
  const Reason* reason = nullptr;
  std::size_t depth = 0;  ///< how many others it helps to explain, one by one
  bool is_told = false;
};

/// Orders reasons so that one explains another: what is said of a required task stands below the
/// requirement.
class Chain {
 public:
  Chain(const CompiledCatalog& catalog, std::vector<Told> reasons)
      : catalog_(catalog), reasons_(std::move(reasons)) {}

  /// `roots`: the tasks that all is about.
  std::vector<Told> take(std::span<const TaskId> roots) && {
    for (const Told& told : reasons_) {
      if (told.reason->kind == Reason::Kind::is_protected || leads_on(*told.reason)) {
        reachable_.insert(told.reason->task);
      }
    }
    reachable_.insert(roots.begin(), roots.end());
    for (const TaskId root : roots) tell_about(root, 0);
    for (const bool is_first : {true, false}) {
      for (Told& told : reasons_) {
        const bool is_beginning = told.reason->kind == Reason::Kind::is_protected;
        if (!told.is_told && (is_beginning || !is_first)) tell(told, 0);
      }
    }
    return std::move(ordered_);
  }

 private:
  static bool leads_on(const Reason& reason) {
    return reason.behavior != none && reason.task != none &&
           reason.kind != Reason::Kind::not_improved;
  }

  [[nodiscard]] bool is_about(const Reason& reason, TaskId task) const {
    if (reason.kind == Reason::Kind::exclusive) {
      if (reason.task != task && reason.other_task != task) return false;
      const TaskId other = reason.task == task ? reason.other_task : reason.task;
      return visited_.contains(other) || !reachable_.contains(other);
    }
    if (reason.kind == Reason::Kind::limited) {
      const auto members = catalog_.limited[reason.limit];
      return std::binary_search(members.begin(), members.end(), task);
    }
    if (reason.behavior == none || reason.kind == Reason::Kind::not_improved) {
      return reason.task == task;
    }
    return catalog_.can_perform(reason.behavior, task);
  }

  void tell_about(TaskId task, std::size_t depth) {
    if (!visited_.insert(task).second) return;
    // What leads to other tasks comes last: a behavior may perform these, too.
    for (const bool leads : {false, true}) {
      for (Told& told : reasons_) {
        if (told.is_told || leads_on(*told.reason) != leads) continue;
        if (is_about(*told.reason, task)) tell(told, depth);
      }
    }
  }

  void tell(Told& told, std::size_t depth) {
    add(told, depth);
    const Reason& reason = *told.reason;
    if (leads_on(reason)) {
      // The requirement, and the minimum of it.
      for (Told& other : reasons_) {
        const bool is_same =
            other.reason->behavior == reason.behavior && other.reason->task == reason.task;
        if (!other.is_told && is_same) add(other, depth);
      }
    }
    if (leads_on(reason) || reason.kind == Reason::Kind::is_protected) {
      tell_about(reason.task, depth + 1);
    }
  }

  void add(Told& told, std::size_t depth) {
    told.is_told = true;
    ordered_.push_back({std::move(told.text), told.reason, depth});
  }

  const CompiledCatalog& catalog_;
  std::vector<Told> reasons_;
  std::set<TaskId> reachable_;
  std::set<TaskId> visited_;
  std::vector<Told> ordered_;
};

}  // namespace

std::vector<std::string> describe_reasons(const CompiledCatalog& catalog, const EventRecord& record,
                                          std::span<const Reason> reasons,
                                          std::span<const TaskId> tasks, TaskId it) {
  std::vector<Told> sentences;
  std::vector<TaskId> told;  // protected tasks that another sentence mentions already
  const auto protection_of = [&](TaskId task) -> const Reason* {
    const auto found = std::find_if(reasons.begin(), reasons.end(), [&](const Reason& reason) {
      return reason.kind == Reason::Kind::is_protected && reason.task == task;
    });
    return found == reasons.end() || std::count(told.begin(), told.end(), task) > 0 ? nullptr
                                                                                    : &*found;
  };
  for (const Reason& reason : reasons) {
    if (reason.kind != Reason::Kind::exclusive) continue;
    TaskId other = reason.task;
    TaskId excluded = reason.other_task;
    if (other == it || (excluded != it && protection_of(other) != nullptr)) {
      std::swap(other, excluded);
    }
    const bool is_it = excluded == it;
    std::string sentence = fmt::format("{} excludes {}", task_name(catalog, other),
                                       is_it ? "it" : task_name(catalog, excluded)) +
                           place(catalog, reason);
    const TaskId guarded = is_it ? other : excluded;
    if (const Reason* const protection = protection_of(guarded)) {
      sentence +=
          fmt::format(", {} {}", is_it ? "and" : "which", describe_protection(record, *protection));
      told.push_back(guarded);
    }
    sentences.push_back({std::move(sentence), &reason});
  }
  std::vector<TaskId> on_request;
  for (const Reason& reason : reasons) {
    if (reason.kind == Reason::Kind::exclusive) continue;
    if (reason.kind == Reason::Kind::is_protected && protection_of(reason.task) == nullptr)
      continue;
    // A minimum performance implies that the task is required.
    if (reason.kind == Reason::Kind::requires_task &&
        std::any_of(reasons.begin(), reasons.end(), [&reason](const Reason& other) {
          return other.kind == Reason::Kind::performance && other.behavior == reason.behavior &&
                 other.task == reason.task;
        })) {
      continue;
    }
    if (reason.kind == Reason::Kind::on_request) on_request.push_back(reason.task);
    sentences.push_back({describe_reason(catalog, record, reason), &reason});
  }
  const bool has_several = on_request.size() > 1;
  if (has_several) {
    std::erase_if(sentences, [](const Told& sentence) {
      return sentence.reason->kind == Reason::Kind::on_request;
    });
  }
  constexpr std::size_t deepest = 8;  // deeper chains would leave no room for words
  std::vector<std::string> lines;
  std::vector<TaskId> roots(tasks.begin(), tasks.end());
  if (record.task != none) roots.push_back(record.task);  // the event says that it runs, or not
  for (const Told& sentence : Chain(catalog, std::move(sentences)).take(roots)) {
    lines.push_back(std::string(2 * std::min(sentence.depth, deepest), ' ') + sentence.text);
  }
  if (has_several) {
    lines.push_back(list_with_and(names_in_sentence(catalog, on_request)) +
                    " start only on request, and are not requested: request them first");
  }
  return lines;
}

std::vector<const Reason*> order_reasons(const CompiledCatalog& catalog,
                                         std::span<const Reason> reasons,
                                         std::span<const TaskId> tasks) {
  // That the event stops its tasks comes last.
  const bool is_event_last = !reasons.empty() && (reasons.back().kind == Reason::Kind::stopped ||
                                                  reasons.back().kind == Reason::Kind::finished);
  std::vector<Told> all;
  for (const Reason& reason : reasons.first(reasons.size() - (is_event_last ? 1 : 0))) {
    all.push_back({{}, &reason});
  }
  std::vector<const Reason*> ordered;
  for (const Told& told : Chain(catalog, std::move(all)).take(tasks)) {
    ordered.push_back(told.reason);
  }
  if (is_event_last) ordered.push_back(&reasons.back());
  return ordered;
}

std::vector<std::string> describe_rejection(const CompiledCatalog& catalog,
                                            const ExplainedRecord& record) {
  if (record.search != nullptr && record.search->result.status == SearchStatus::unknown) {
    return {"a search limit was reached before the first solution"};
  }
  std::vector<std::string> sentences =
      describe_reasons(catalog, record, record.conflict, std::span(&record.task, 1));
  if (sentences.empty()) {
    sentences.emplace_back(
        "no consistent set of behaviors; finding the reasons would have taken too long");
  }
  return sentences;
}

}  // namespace cbc
