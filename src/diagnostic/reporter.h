#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
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

  /// Reports with the severity of the rule.
  void report(std::string_view rule, const Range& range, std::string message,
              std::vector<Note> notes = {}, std::vector<Edit> edits = {});

  /// Reports with another severity.
  void report_as(Severity severity, std::string_view rule, const Range& range, std::string message,
                 std::vector<Note> notes = {}, std::vector<Edit> edits = {});

  /// A note about another place of this file.
  [[nodiscard]] Note note(const Range& range, std::string message) const {
    return {file_, range, std::move(message)};
  }

  [[nodiscard]] std::size_t errors() const { return errors_; }
  /// Errors of one rule.
  [[nodiscard]] std::size_t errors(std::string_view rule) const {
    const auto found = errors_of_.find(rule);
    return found == errors_of_.end() ? 0 : found->second;
  }

 private:
  std::string file_;
  Diagnostics& diagnostics_;
  std::size_t errors_ = 0;
  std::unordered_map<std::string_view, std::size_t> errors_of_;
  std::unordered_set<std::string> reported_;
};

}  // namespace cbc
