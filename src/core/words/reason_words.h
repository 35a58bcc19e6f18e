#pragma once

#include <span>
#include <string>
#include <vector>

#include "ask/conflict/reasons.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"
#include "why/explanation.h"

// Reasons in words.

namespace cbc {

/// A kind of reason, in a sentence with these names, whatever the event was.
[[nodiscard]] std::string describe_kind(Reason::Kind kind, const std::string& behavior,
                                        const std::string& task, const std::string& other_task);

/// A reason for a rejection or a choice, in a sentence, with its place in the catalog if it has
/// one.
[[nodiscard]] std::string describe_reason(const CompiledCatalog& catalog, const EventRecord& record,
                                          const Reason& reason);

/// A set of reasons for people, one sentence in each line. An exclusion and the protection of the
/// excluding task make one sentence, as do several tasks that nobody requested. What is said of a
/// required task follows the requirement, indented by two blanks. `tasks`: those in question, with
/// which the reasons begin. `it`: the task that the sentences call so, or none.
[[nodiscard]] std::vector<std::string> describe_reasons(const CompiledCatalog& catalog,
                                                        const EventRecord& record,
                                                        std::span<const Reason> reasons,
                                                        std::span<const TaskId> tasks,
                                                        TaskId it = none);

/// The same order for reasons that are told one by one.
[[nodiscard]] std::vector<const Reason*> order_reasons(const CompiledCatalog& catalog,
                                                       std::span<const Reason> reasons,
                                                       std::span<const TaskId> tasks);

/// Why an event was rejected, in one line or more: see describe_reasons.
[[nodiscard]] std::vector<std::string> describe_rejection(const CompiledCatalog& catalog,
                                                          const ExplainedRecord& record);

}  // namespace cbc
