#include "interface/event_checks.h"

namespace cbc {
namespace {

LiveStatus check_task(const CompiledCatalog& catalog, const Event& event, std::int32_t least) {
  if (event.subject >= catalog.tasks.size()) return LiveStatus::unknown_task;
  if (event.priority && *event.priority < least) return LiveStatus::invalid_priority;
  return LiveStatus::ok;
}

LiveStatus check_behavior(const CompiledCatalog& catalog, std::uint32_t behavior) {
  return behavior < catalog.behaviors.size() ? LiveStatus::ok : LiveStatus::unknown_behavior;
}

LiveStatus check_parameters(const Event& event) {
  const bool is_missing =
      event.parameters && event.parameters->data() == nullptr && !event.parameters->empty();
  return is_missing ? LiveStatus::invalid_parameters : LiveStatus::ok;
}

LiveStatus check_situation(const CompiledCatalog& catalog,
                           std::span<const Availability> situation) {
  if (situation.data() == nullptr && !situation.empty()) return LiveStatus::invalid_situation;
  for (const Availability& entry : situation) {
    const LiveStatus status = check_behavior(catalog, entry.behavior);
    if (status != LiveStatus::ok) return status;
  }
  return LiveStatus::ok;
}

}  // namespace

LiveStatus check_event(const CompiledCatalog& catalog, const Event& event) {
  LiveStatus status = LiveStatus::ok;
  switch (event.verb) {
    case Verb::start:
      status = check_task(catalog, event, 1);
      return status == LiveStatus::ok ? check_parameters(event) : status;
    case Verb::stop:
      return check_task(catalog, event, 0);
    case Verb::finish:
      status = check_behavior(catalog, event.subject);
      if (status != LiveStatus::ok) return status;
      return event.cause <= FinishCause::interrupted ? status : LiveStatus::invalid_cause;
    case Verb::situation:
      return check_situation(catalog, event.situation);
    case Verb::fault:
    case Verb::repair:
      return check_behavior(catalog, event.subject);
    case Verb::wait:
      return LiveStatus::ok;
  }
  return LiveStatus::invalid_verb;
}

}  // namespace cbc
