#include <cstddef>
#include <map>

#include <fmt/format.h>

#include "core/report/run_json.h"
#include "core/report/run_report.h"
#include "core/report/run_text.h"
#include "core/report/test_report.h"
#include "core/support/wording.h"
#include "core/words/failure_explanation.h"
#include "core/words/words.h"
#include "solve/report/solve_report.h"

namespace cbc {
namespace {

/// Runs as tests: a script is a test suite, an expectation a test case. A run that ended early is
/// an error, and the expectations it did not reach are skipped.
class RunTests final : public SolveReport {
 public:
  /// `is_part`: of a report that has begun already.
  RunTests(const TestFormat& format, const ReportSettings& settings, bool is_part)
      : format_(format), settings_(settings), out_(settings.out) {
    if (!is_part) fmt::print(out_, "{}", format_.begin("cbc solve"));
  }

  void begin_run(const CompiledCatalog& catalog, const Script& script) override {
    explanation_.begin_run(catalog, script);
    suite_ = {script.file, std::string(catalog.file), {}};
    places_.clear();
    for (const Step& step : script.steps) {
      if (!step.expect) continue;
      places_[&step] = suite_.cases.size();
      suite_.cases.push_back({fmt::format("line {}: {}", step.range.begin.line,
                                          describe_expectation(catalog, *step.expect))});
    }
  }

  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override {
    explanation_.add(record, step, state);
  }

  void on_failure(const Failure& failure) override {
    TestCase& test = suite_.cases[places_.at(failure.step)];
    std::string message = failure.message;
    if (!settings_.layout.is_brief) message += "\n" + join(explanation_.tell(failure), "\n");
    test.fail({"expectation failed", Severity::error, suite_.file, failure.range, message, {}});
  }

  /// Expectations are checked in the order of the script, so if a run ends early, the last ones
  /// were not reached.
  void end_run(const RunResult& result, const std::string& error) override {
    for (auto place = static_cast<std::size_t>(result.passed + result.failed);
         place < suite_.cases.size(); ++place) {
      suite_.cases[place].status = TestCase::Status::skipped;
      suite_.cases[place].more = "the run ended earlier";
    }
    if (!error.empty()) {
      suite_.cases.push_back({"runs to its end"});
      suite_.cases.back().fail(
          {"run ended early", Severity::error, suite_.file, whole_file, error, {}},
          TestCase::Status::error);
    }
    fmt::print(out_, "{}", format_.suite(suite_));
  }

  void end() override { fmt::print(out_, "{}", format_.end); }

  [[nodiscard]] std::unique_ptr<SolveReport> make_part(std::FILE* out) const override {
    ReportSettings of_part = settings_;
    of_part.out = out;
    return std::make_unique<RunTests>(format_, of_part, true);
  }
  void add_part(std::string_view text, const RunResult& /*result*/) override {
    fmt::print(out_, "{}", text);
  }

 private:
  const TestFormat& format_;
  const ReportSettings settings_;
  std::FILE* const out_;
  FailureExplanation explanation_;
  TestSuite suite_;
  std::map<const Step*, std::size_t> places_;  ///< of the cases
};

template <const TestFormat& format>
std::unique_ptr<SolveReport> make_tests(const ReportSettings& settings) {
  return std::make_unique<RunTests>(format, settings, false);
}

}  // namespace

std::span<const SolveFormat> solve_formats() {
  using Report = std::unique_ptr<SolveReport>;
  using Settings = const ReportSettings&;
  static constexpr SolveFormat formats[] = {
      {"text",
       [](Settings settings) -> Report {
         return std::make_unique<TextReport>(settings.style, settings.out, settings.layout);
       }},
      {"json",
       [](Settings settings) -> Report {
         return std::make_unique<JsonReport>(settings.out, settings.adds);
       }},
      {"junit", make_tests<junit_format>},
      {"github", make_tests<github_format>},
  };
  return formats;
}

}  // namespace cbc
