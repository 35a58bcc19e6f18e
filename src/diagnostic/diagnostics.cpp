#include <algorithm>
#include <tuple>
#include <utility>

#include "cbc/diagnostic.h"

namespace cbc {

std::string_view name_of(Severity severity) {
  switch (severity) {
    case Severity::error:
      return "error";
    case Severity::warning:
      return "warning";
    case Severity::note:
      break;
  }
  return "note";
}

void Diagnostics::add(Diagnostic diagnostic) { all_.push_back(std::move(diagnostic)); }

void Diagnostics::sort() {
  // Findings at one place keep the order in which they were found.
  std::stable_sort(all_.begin(), all_.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::tie(a.file, a.range.begin, a.rule) < std::tie(b.file, b.range.begin, b.rule);
  });
}

std::size_t Diagnostics::count(Severity severity) const {
  return static_cast<std::size_t>(std::count_if(
      all_.begin(), all_.end(),
      [severity](const Diagnostic& diagnostic) { return diagnostic.severity == severity; }));
}

}  // namespace cbc
