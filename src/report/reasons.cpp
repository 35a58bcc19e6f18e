#include "report/reasons.h"

#include <fmt/format.h>

#include "text/quote.h"

namespace cbc {

std::string describe_priority_conflict(const CompiledCatalog& catalog, const EventRecord& record) {
  return fmt::format("{} has a request of priority {}, higher than {}",
                     printable(catalog.name_of_task(record.priority_conflict->task)),
                     record.priority_conflict->priority, record.priority);
}

}  // namespace cbc
