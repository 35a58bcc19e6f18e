#pragma once

#include <string>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coordinator/explanation.h"
#include "coordinator/record.h"
#include "coordinator/state.h"

namespace cbc {

/// An explanation for a person: a sentence, and what it announces, if that is more than one.
struct Sentences {
  std::string first;
  std::vector<std::string> more;
};

/// Why a requested task does not run any more. The state is that after the event, here and below.
[[nodiscard]] Sentences describe_displacement(const CompiledCatalog& catalog,
                                              const EventRecord& record,
                                              const Displacement& displaced, const State& state);

/// Why a task has its value, or a behavior is active or not.
[[nodiscard]] Sentences describe_why(const CompiledCatalog& catalog, const EventRecord& record,
                                     const Why& why, const State& state);

/// A listed configuration: its objectives, then what runs in the first one of the list, or in what
/// another one differs from that.
[[nodiscard]] std::string describe_alternative(const CompiledCatalog& catalog,
                                               const EventRecord& record, std::size_t place,
                                               const State& state);

}  // namespace cbc
