#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/catalog/reader.h"
#include "core/command_line/command_line.h"
#include "core/diagnostic/diagnostic.h"
#include "core/files/file_set.h"
#include "core/files/ordered_work.h"
#include "core/files/progress.h"
#include "tune/engine/numbers.h"
#include "tune/report/tune_report.h"
#include "tune/tune.h"

// What tuning has in common, be it by missions or by states.

namespace cbc::cli {

[[nodiscard]] Millionths degree_of(const std::string& percentage);

/// Whether the catalog was not compiled. Otherwise that is printed.
[[nodiscard]] bool has_numbers(const CheckedCatalog& source);

/// The numbers that --only names. Empty if it names something else, which is printed.
[[nodiscard]] std::optional<std::vector<TunableNumber>> choose_numbers(
    const CatalogReading& reading, const std::vector<std::string>& only);

/// A result without any number looked at yet. All but the options must outlive it.
[[nodiscard]] TuneResult begin_result(const CheckedCatalog& source,
                                      const std::vector<TunableNumber>& numbers,
                                      const Recording& present, const TuneOptions& options);

/// Writes to standard output, and the page. Returns the exit status.
[[nodiscard]] int write_reports(const TuneResult& result, const TuneOptions& options);

/// The exit status of what was found out.
[[nodiscard]] int status_of(const TuneResult& result);

/// Makes an item for each number, several at once. A terminal shows the progress.
template <typename Make>
auto for_each_number(std::string what, const TuneResult& result, const TuneOptions& options,
                     const Make& make) {
  using Item = decltype(make(0));
  constexpr std::chrono::milliseconds between_looks(100);
  std::vector<Item> items;
  Progress progress(std::move(what), result.numbers.size());
  OrderedWork<Item> work(result.numbers.size(), thread_count(options.jobs), make);
  for (const TunableNumber& number : result.numbers) {
    progress.begin(describe(number, result.source));
    while (!work.wait_for(between_looks)) progress.show();
    items.push_back(work.take());
  }
  return items;
}

}  // namespace cbc::cli
