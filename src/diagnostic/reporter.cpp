#include "diagnostic/reporter.h"

#include <utility>

namespace cbc {

void Reporter::report(Severity severity, std::string_view rule, const Range& range,
                      std::string message, std::vector<Note> notes) {
  std::string identity(rule);
  identity += ' ' + std::to_string(range.begin.line) + ' ' + std::to_string(range.begin.column) +
              ' ' + message;
  if (!reported_.insert(std::move(identity)).second) return;
  if (severity == Severity::error) ++errors_;
  diagnostics_.add({rule, severity, file_, range, std::move(message), std::move(notes)});
}

}  // namespace cbc
