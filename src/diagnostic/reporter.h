#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "cbc/diagnostic.h"

namespace cbc {

/// Reports findings about one file. The same finding is reported once, though a piece of the file
/// may be read several times through aliases.
class Reporter {
 public:
  Reporter(std::string file, Diagnostics& diagnostics)
      : file_(std::move(file)), diagnostics_(diagnostics) {}

  void error(std::string_view rule, const Range& range, std::string message,
             std::vector<Note> notes = {}) {
    report(Severity::error, rule, range, std::move(message), std::move(notes));
  }
  void warning(std::string_view rule, const Range& range, std::string message,
               std::vector<Note> notes = {}) {
    report(Severity::warning, rule, range, std::move(message), std::move(notes));
  }
  void report(Severity severity, std::string_view rule, const Range& range, std::string message,
              std::vector<Note> notes = {});

  /// A note about another place of this file.
  [[nodiscard]] Note note(const Range& range, std::string message) const {
    return {file_, range, std::move(message)};
  }

  [[nodiscard]] std::size_t errors() const { return errors_; }

 private:
  std::string file_;
  Diagnostics& diagnostics_;
  std::size_t errors_ = 0;
  std::unordered_set<std::string> reported_;
};

}  // namespace cbc
