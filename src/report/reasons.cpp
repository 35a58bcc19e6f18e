#include "report/reasons.h"

#include <fmt/format.h>

#include "text/decimal.h"
#include "text/quote.h"

namespace cbc {
namespace {

std::string place(const CompiledCatalog& catalog, const Reason& reason) {
  return fmt::format(" ({}:{})", printable(catalog.file), reason.line);
}

std::string describe_protection(const EventRecord& record, const std::string& task,
                                const Reason& reason) {
  if (record.origin == Origin::reactive) {
    return fmt::format("{} runs by request, and a reactive start stops no such task", task);
  }
  return fmt::format("{} runs with priority {}, higher than {}", task, reason.priority,
                     record.priority);
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
      return describe_protection(record, task, reason);
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
  }
  return {};
}

}  // namespace cbc
