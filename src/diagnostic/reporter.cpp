#include "diagnostic/reporter.h"

#include <utility>

#include "cbc/rules.h"

namespace cbc {

void Reporter::report(std::string_view rule, const Range& range, std::string message,
                      std::vector<Note> notes, std::vector<Edit> edits) {
  report_as(find_rule(rule)->severity, rule, range, std::move(message), std::move(notes),
            std::move(edits));
}

void Reporter::report_as(Severity severity, std::string_view rule, const Range& range,
                         std::string message, std::vector<Note> notes, std::vector<Edit> edits) {
  std::string identity(rule);
  identity += ' ' + std::to_string(range.begin.line) + ' ' + std::to_string(range.begin.column) +
              ' ' + message;
  if (!reported_.insert(std::move(identity)).second) return;
  if (severity == Severity::error) {
    ++errors_;
    ++errors_of_[rule];
  }
  diagnostics_.add(
      {rule, severity, file_, range, std::move(message), std::move(notes), std::move(edits)});
}

}  // namespace cbc
