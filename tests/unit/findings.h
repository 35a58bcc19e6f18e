#pragma once

#include <string>

#include "core/diagnostic/diagnostic.h"

namespace cbc {

/// The fixture of the readers' tests: findings as text, one on a line, in the order of sort():
///
///     3:9-13 error undefined-task: message
///       1:2-5 message of a note
///
/// The end of a range is one past its last character; a line is added to it if it is another one.
inline std::string show(const Range& range) {
  std::string text = std::to_string(range.begin.line) + ":" + std::to_string(range.begin.column);
  text += "-";
  if (range.end.line != range.begin.line) text += std::to_string(range.end.line) + ":";
  return text + std::to_string(range.end.column);
}

inline std::string show(const Diagnostics& diagnostics) {
  Diagnostics sorted = diagnostics;
  sorted.sort();
  std::string text;
  for (const Diagnostic& finding : sorted.all()) {
    text += show(finding.range) + " " + std::string(name_of(finding.severity)) + " " +
            std::string(finding.rule) + ": " + finding.message + "\n";
    for (const Note& note : finding.notes) {
      text += "  " + show(note.range) + " " + note.message + "\n";
    }
  }
  return text;
}

}  // namespace cbc
