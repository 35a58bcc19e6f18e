#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cbc/live_coordinator.h"
#include "compiled/compiled_catalog.h"
#include "coordinator/coordinator.h"

namespace cbc {

/// Keeps the events of one call, in the terms of the public interface.
class HandledEvents final : public EventListener {
 public:
  explicit HandledEvents(const CompiledCatalog& catalog) : catalog_(catalog) {}

  void clear();
  void on_event(const EventRecord& record) override;

  /// Valid until the next event.
  [[nodiscard]] std::span<const HandledEvent> events();

 private:
  void add_change(const EventRecord& record, const Change& change);
  [[nodiscard]] std::uint32_t subject_of(const EventRecord& record) const;

  const CompiledCatalog& catalog_;
  // Their spans have the right sizes, but point anywhere until events() sets them, as these arrays
  // move when they grow.
  std::vector<HandledEvent> events_;
  std::vector<BehaviorChange> changes_;  ///< of all events, one after the other
  std::vector<TaskStop> stopped_tasks_;
  std::vector<std::uint32_t> tasks_;  ///< of all changes
};

}  // namespace cbc
