#include "coordinator/record.h"

#include <array>

#include "cbc/event.h"

namespace cbc {

std::string_view name_of(Verb verb) {
  static constexpr std::array<std::string_view, 7> names{"start", "stop",   "finish", "situation",
                                                         "fault", "repair", "wait"};
  return names[static_cast<std::size_t>(verb)];
}

std::string_view name_of(FinishCause cause) {
  static constexpr std::array<std::string_view, 6> names{"goal_achieved",   "time_out",
                                                         "wrong_progress",  "situation_change",
                                                         "process_failure", "interrupted"};
  return names[static_cast<std::size_t>(cause)];
}

std::string_view name_of(Origin origin) {
  static constexpr std::array<std::string_view, 4> names{"script", "timeout", "reactive", "fault"};
  return names[static_cast<std::size_t>(origin)];
}

std::string_view name_of(Outcome outcome) {
  static constexpr std::array<std::string_view, 3> names{"accepted", "rejected", "unchanged"};
  return names[static_cast<std::size_t>(outcome)];
}

std::string_view name_of(ChangeCause cause) {
  static constexpr std::array<std::string_view, 8> names{"requested", "reactive",  "required",
                                                         "replaced",  "displaced", "released",
                                                         "restarted", "undone"};
  return names[static_cast<std::size_t>(cause)];
}

std::string_view name_of(SearchStatus status) {
  static constexpr std::array<std::string_view, 4> names{"optimal", "feasible", "infeasible",
                                                         "unknown"};
  return names[static_cast<std::size_t>(status)];
}

}  // namespace cbc
