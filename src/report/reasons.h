#pragma once

#include <span>
#include <string>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coordinator/record.h"

namespace cbc {

/// A reason why an event was rejected, or did not do otherwise, in a sentence, with the place in
/// the catalog if it has one.
[[nodiscard]] std::string describe_reason(const CompiledCatalog& catalog, const EventRecord& record,
                                          const Reason& reason);

/// A set of reasons for a person: an exclusion and the protection that makes it hurt are one
/// sentence. `it`: a task that the sentences are about, or none.
[[nodiscard]] std::vector<std::string> describe_reasons(const CompiledCatalog& catalog,
                                                        const EventRecord& record,
                                                        std::span<const Reason> reasons,
                                                        TaskId it = none);

/// Why an event was rejected, in one sentence or more.
[[nodiscard]] std::vector<std::string> describe_rejection(const CompiledCatalog& catalog,
                                                          const EventRecord& record);

}  // namespace cbc
