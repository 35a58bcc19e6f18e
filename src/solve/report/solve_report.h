#pragma once

#include <cstdio>
#include <memory>
#include <span>
#include <string_view>

#include "core/diagnostic/diagnostic.h"
#include "core/report/event_json.h"
#include "core/report/run_report.h"
#include "core/report/run_text.h"

// All formats of `cbc solve`.

namespace cbc {

/// What a report depends on besides the runs.
struct ReportSettings {
  std::FILE* out = stdout;
  Style style = plain_style();  ///< of a text for people
  EventAdditions adds;          ///< of a report for programs
  TextLayout layout;            ///< of a text for people
};

/// A format of `cbc solve` for whole runs. Event streams (jsonl) are not among them.
struct SolveFormat {
  std::string_view name;
  std::unique_ptr<SolveReport> (*make)(const ReportSettings& settings);
};

/// The first one is the default.
[[nodiscard]] std::span<const SolveFormat> solve_formats();

}  // namespace cbc
