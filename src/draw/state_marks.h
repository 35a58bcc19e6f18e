#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "draw/catalog_graph.h"

namespace cbc::draw {

/// What runs after an event, and what the event changed. Tasks and behaviors are places in the
/// catalog.
struct RunState {
  struct RunningTask {
    std::uint32_t task = 0;
    std::uint32_t behavior = 0;
    std::optional<std::int32_t> priority;  ///< of its request; 0: it started by itself
  };
  struct Change {
    std::uint32_t behavior = 0;
    bool is_activation = false;
    bool is_successful = true;
    bool is_undoing = false;  ///< takes back another change of the event
  };
  std::vector<RunningTask> running;
  std::vector<RunningTask> before;        ///< what ran before the event
  std::optional<std::uint32_t> finished;  ///< the active behavior whose end the event reports
  std::vector<Change> changes;            ///< in order
  std::vector<std::uint32_t> unavailable;
  std::vector<std::uint32_t> faulty;
};

/// Marks what is in use, since the event, or until then, and notes what there is to say of it. All
/// else becomes faint. The graph is that of a good catalog.
void mark_state(CatalogGraph& graph, const RunState& state);

}  // namespace cbc::draw
