#pragma once

#include <iosfwd>
#include <vector>

#include <benchmark/benchmark.h>

namespace cbc::bench {

/// Shows results as Google Benchmark does (of repetitions only the median), and keeps them for the
/// tables. To be constructed after benchmark::Initialize.
class TableReporter final : public benchmark::BenchmarkReporter {
 public:
  TableReporter() : display_(*benchmark::CreateDefaultDisplayReporter()) {}

  bool ReportContext(const Context& context) override { return display_.ReportContext(context); }
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override { display_.Finalize(); }

  /// Whether the results are shown to people, not to a program (--benchmark_format).
  [[nodiscard]] bool is_for_people() const;

  /// The results once more, as tables in the shape of the paper's.
  void print_tables(std::ostream& out) const;

 private:
  benchmark::BenchmarkReporter& display_;
  std::vector<Run> medians_;  ///< as they ran
};

}  // namespace cbc::bench
