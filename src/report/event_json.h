#pragma once

#include <string>

#include "compiled/compiled_catalog.h"
#include "coordinator/record.h"
#include "coordinator/state.h"
#include "script/script.h"

namespace cbc {

/// What the events have beside the keys that they always have.
struct EventAdditions {
  bool why = false;
  bool alternatives = false;
};

/// Appends one event as the JSON of `cbc solve` has it, on one line. `step` is the scripted one, or
/// null. It goes straight to text: streams write a hundred thousand of them in a second.
void append_event(std::string& text, const CompiledCatalog& catalog, const EventRecord& record,
                  const Step* step, const State& state, const EventAdditions& adds);

}  // namespace cbc
