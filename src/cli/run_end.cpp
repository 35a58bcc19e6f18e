#include "cli/run_end.h"

#include <fmt/format.h>

#include "cli/exit_status.h"

namespace cbc::cli {

std::string describe_end(const RunResult& result, const CoordinatorOptions& options) {
  switch (result.status) {
    case Coordinator::Status::ok:
      return {};
    case Coordinator::Status::too_many_clock_events:
      return fmt::format("the clock made more than {} events (--max-clock-events)",
                         options.max_clock_events);
    case Coordinator::Status::refused_answer:
      return "the checker refuses an answer of the solver: " + result.internal_error;
  }
  return {};
}

int status_of(const RunResult& result) {
  if (result.status == Coordinator::Status::refused_answer) return exit_internal;
  if (result.status == Coordinator::Status::too_many_clock_events) return exit_unusable;
  return result.failed > 0 ? exit_no : exit_ok;
}

}  // namespace cbc::cli
