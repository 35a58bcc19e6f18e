#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/script/runner.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"

namespace cbc {

// What two runs did about the same events from outside, by name, as catalogs number things
// differently. A difference counts by what a robot would show: outcomes, and what performs a task.

/// Running tasks with their behaviors.
using Running = std::map<std::string, std::string>;

/// What one event of a run led to.
struct RunAnswer {
  Microseconds time = 0;
  std::string what;                ///< "start LAND"
  std::optional<Outcome> outcome;  ///< of a start, stop or finish from outside
  Running running;
};

/// "LOCALIZE: LIDAR in place of CAMERA": what performs a task. Empty: nothing.
[[nodiscard]] std::string task_in_place_of(std::string_view task, std::string_view now,
                                           std::string_view before);

/// Collects the answers of a run.
class AnswerCollector final : public RunListener {
 public:
  /// The catalog must outlive it.
  explicit AnswerCollector(const CompiledCatalog& catalog) : catalog_(catalog) {}

  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override;
  /// The answers since the last call.
  [[nodiscard]] std::vector<RunAnswer> take();

 private:
  const CompiledCatalog& catalog_;
  std::vector<RunAnswer> answers_;
};

/// Tells where two runs begin and cease to differ: a difference lasts until it ends, so that the
/// events in between, which follow from it, are not told as differences of their own.
class RunComparison {
 public:
  struct Line {
    Microseconds time = 0;
    std::string event;
    std::string what;
    bool is_end = false;  ///< of differences
  };

  /// What both did from one event from outside, the first of them, to the next one.
  void compare(const std::vector<RunAnswer>& before, const std::vector<RunAnswer>& now);
  [[nodiscard]] const std::vector<Line>& lines() const { return lines_; }
  /// How many events begin a difference.
  [[nodiscard]] std::size_t events() const;

 private:
  void compare_running(Microseconds time, const std::string& event);

  Running before_;
  Running now_;
  std::map<std::string, std::string> differences_;  ///< by task: in words
  std::vector<Line> lines_;
};

}  // namespace cbc
