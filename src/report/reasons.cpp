#include "report/reasons.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "text/decimal.h"
#include "text/quote.h"

namespace cbc {
namespace {

std::string place(const CompiledCatalog& catalog, const Reason& reason) {
  return fmt::format(" ({}:{})", printable(catalog.file), reason.line);
}

std::string describe_protection(const EventRecord& record, const Reason& reason) {
  if (record.origin == Origin::reactive) {
    return "runs by request, and a reactive start stops no such task";
  }
  const std::int32_t level = record.search != nullptr ? record.search->protection : record.priority;
  if (level == 0 && record.verb != Verb::start && record.verb != Verb::stop) {
    return fmt::format("runs with priority {}, and this event has none", reason.priority);
  }
  return fmt::format("runs with priority {}, higher than {}", reason.priority, level);
}

}  // namespace

std::string describe_reason(const CompiledCatalog& catalog, const EventRecord& record,
                            const Reason& reason) {
  const auto task_name = [&](TaskId task) {
    return task == none ? std::string() : printable(catalog.name_of_task(task));
  };
  const std::string task = task_name(reason.task);
  const std::string behavior =
      reason.behavior == none ? "" : printable(catalog.name_of_behavior(reason.behavior));
  switch (reason.kind) {
    case Reason::Kind::priority:
      return fmt::format("{} has a request of priority {}, higher than {}", task, reason.priority,
                         record.priority);
    case Reason::Kind::no_behavior:
      return fmt::format("no behavior performs {}", task);
    case Reason::Kind::is_protected:
      return fmt::format("{} {}", task, describe_protection(record, reason));
    case Reason::Kind::exclusive:
      return fmt::format("{} excludes {}", task, task_name(reason.other_task)) +
             place(catalog, reason);
    case Reason::Kind::on_request:
      return fmt::format("{} is not running, and starts on request only", task);
    case Reason::Kind::requires_task:
      return fmt::format("{} requires {}", behavior, task) + place(catalog, reason);
    case Reason::Kind::performance:
      return fmt::format("{} requires {} with at least {} %",
                         reason.behavior == none ? "the catalog" : behavior, task,
                         format_decimal(reason.minimum_performance, 4)) +
             place(catalog, reason);
    case Reason::Kind::unavailable:
      return fmt::format("{} cannot be activated in the present situation", behavior);
    case Reason::Kind::faulty:
      return fmt::format("{} is faulty", behavior);
    case Reason::Kind::finished:
      return fmt::format("{} has just finished ({})", behavior, name_of(record.cause));
  }
  return {};
}

std::vector<std::string> describe_reasons(const CompiledCatalog& catalog, const EventRecord& record,
                                          std::span<const Reason> reasons, TaskId it) {
  std::vector<std::string> sentences;
  std::vector<TaskId> told;  // protected tasks whose sentence is part of another one
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
    std::string sentence = fmt::format("{} excludes {}", printable(catalog.name_of_task(other)),
                                       is_it ? "it" : printable(catalog.name_of_task(excluded))) +
                           place(catalog, reason);
    const TaskId guarded = is_it ? other : excluded;
    if (const Reason* const protection = protection_of(guarded)) {
      sentence +=
          fmt::format(", {} {}", is_it ? "and" : "which", describe_protection(record, *protection));
      told.push_back(guarded);
    }
    sentences.push_back(std::move(sentence));
  }
  for (const Reason& reason : reasons) {
    if (reason.kind == Reason::Kind::exclusive) continue;
    if (reason.kind == Reason::Kind::is_protected && protection_of(reason.task) == nullptr)
      continue;
    // A minimum performance says that the task is required, too.
    if (reason.kind == Reason::Kind::requires_task &&
        std::any_of(reasons.begin(), reasons.end(), [&reason](const Reason& other) {
          return other.kind == Reason::Kind::performance && other.behavior == reason.behavior &&
                 other.task == reason.task;
        })) {
      continue;
    }
    sentences.push_back(describe_reason(catalog, record, reason));
  }
  return sentences;
}

std::vector<std::string> describe_rejection(const CompiledCatalog& catalog,
                                            const EventRecord& record) {
  if (record.search != nullptr && record.search->result.status == SearchStatus::unknown) {
    return {"a search limit came before the first solution"};
  }
  std::vector<std::string> sentences = describe_reasons(catalog, record, record.conflict);
  if (sentences.empty()) {
    sentences.emplace_back(
        "no consistent set of behaviors; finding the reasons would have taken too long");
  }
  return sentences;
}

}  // namespace cbc
