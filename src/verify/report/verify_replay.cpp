// A counterexample or witness, or the script of a difference, told event by event.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/report/explanation_json.h"
#include "core/report/run_text.h"
#include "core/script/runner.h"
#include "core/support/json_description.h"
#include "core/support/system.h"
#include "core/support/wording.h"
#include "core/words/failure_explanation.h"
#include "core/words/layout.h"
#include "core/words/reason_words.h"
#include "core/words/words.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "verify/report/verify_report.h"
#include "why/conflict.h"

namespace cbc {
namespace {

/// What a condition demands to run, as far as an expectation can say it.
void add_demand(const CompiledCatalog& catalog, const StateCondition& condition,
                Expectation& demand) {
  if (condition.kind == StateCondition::Kind::all) {
    for (const StateCondition& part : condition.parts) add_demand(catalog, part, demand);
  }
  if (condition.kind != StateCondition::Kind::running) return;
  auto& running = demand.running.emplace_back();
  running.task = catalog.tasks[condition.task].catalog_index;
  for (const BehaviorId behavior : condition.behaviors) {
    running.behaviors.push_back(catalog.behaviors[behavior].catalog_index);
  }
}

/// What a property demands of the last state.
Expectation demand_of(const CompiledCatalog& catalog, const Property& property) {
  Expectation demand;
  if (property.kind == Property::Kind::can_start) demand.outcome = Outcome::accepted;
  if (property.kind == Property::Kind::always) add_demand(catalog, property.condition, demand);
  return demand;
}

/// Writes a run in the words of `cbc solve`, and notes what led to its end.
class ReplayListener final : public RunListener {
 public:
  ReplayListener(const CompiledCatalog& catalog, const Script& script, const Style& style)
      : catalog_(catalog), text_(style, memory_.stream()) {
    text_.begin_run(catalog, script);
    explanation_.begin_run(catalog, script);
  }

  /// The script is about a property.
  void set(const Property& property, std::span<const Microseconds> due, const State& first) {
    property_ = &property;
    due_ = due;
    before_.emplace(first);
  }
  void set_last_move(Microseconds time) { last_move_ = time; }

  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override {
    tell_idle_queue(record.time);
    has_events_ = true;
    if (record.time >= last_move_) begin_last_move();
    text_.on_event(record, step, state);
    explanation_.add(record, step, state);
    if (before_) before_.emplace(state);
    if (record.origin != Origin::script || record.verb != Verb::start) return;
    conflict_.clear();
    JsonWriter json(conflict_);
    json::list(json::pointed(json::reason))
        .write(json, order_reasons(catalog_, record.conflict, std::span(&record.task, 1)),
               json::ReasonContext{catalog_, record});
  }
  void on_failure(const Failure& failure) override { text_.on_failure(failure); }
  void on_end(const State& state) override {
    tell_idle_queue(std::numeric_limits<Microseconds>::max());
    begin_last_move();
    text_.on_end(state);
    const bool is_told = !idle_queue_.empty() && !has_events_;
    if (property_ != nullptr && !is_told) {
      explanation_lines_ = explanation_.tell(demand_of(catalog_, *property_));
    }
  }

  Replay take(RunResult result) && {
    begin_last_move();
    std::string text(memory_.text());
    // The report says which script this is.
    const std::size_t title = text.find("\n\n") + 2;
    text.erase(0, title);
    return {std::move(result),
            std::move(text),
            *last_move_begin_ - title,
            std::move(conflict_),
            std::move(explanation_lines_),
            std::move(idle_queue_)};
  }

 private:
  void begin_last_move() {
    if (!last_move_begin_) last_move_begin_ = memory_.size();
  }

  /// The queue comes due as a move of its own, which is no event where nothing can start: it is
  /// told nevertheless, so that there are as many moves to be seen as the report counts.
  void tell_idle_queue(Microseconds until) {
    for (; !due_.empty() && due_.front() < until; due_ = due_.subspan(1)) {
      for (const TaskId task : catalog_.task_ids) {
        const std::uint32_t index = catalog_.tasks[task].catalog_index;
        if (!before_->queue().has(index) || before_->queue().due(index) != due_.front()) continue;
        tell_idle(task);
      }
    }
  }

  void tell_idle(TaskId task) {
    const std::vector<Reason> hindrances = hindrances_to_reactive_start(catalog_, *before_, task);
    const std::vector<std::string> reasons =
        describe_reasons(catalog_, EventRecord(), hindrances, std::span(&task, 1));
    const std::string what =
        fmt::format("{} is due, and cannot start by itself", task_name(catalog_, task));
    text_.write_between(due_.front(), what, reasons);
    idle_queue_.push_back(fmt::format("at {} s {}: {}", format_time(due_.front()), what,
                                      join(reasons, "; ", without_indentation)));
  }

  const CompiledCatalog& catalog_;
  const Property* property_ = nullptr;
  std::span<const Microseconds> due_;  ///< of the moves that let the queue come due: still to come
  std::optional<State> before_;        ///< the state after the event before
  Microseconds last_move_ = 0;
  std::optional<std::size_t> last_move_begin_;
  MemoryFile memory_;
  TextReport text_;
  FailureExplanation explanation_;
  std::string conflict_ = "[]";
  std::vector<std::string> explanation_lines_;
  std::vector<std::string> idle_queue_;
  bool has_events_ = false;
};

Replay run(const CompiledCatalog& catalog, const Script& script, ReplayListener& listener) {
  RunResult result =
      run_script(catalog, script, {}, listener, {.rejections = true, .displaced = true});
  return std::move(listener).take(std::move(result));
}

}  // namespace

Replay replay_witness(const CompiledCatalog& catalog, const Witness& witness,
                      const Property& property, const Style& style) {
  SilentRun nothing;
  Runner before(catalog, options_of(witness.script), nothing);
  before.begin(witness.script.situation);
  ReplayListener listener(catalog, witness.script, style);
  listener.set(property, witness.due, before.coordinator().state());
  return run(catalog, witness.script, listener);
}

Replay replay_difference(const CompiledCatalog& catalog, const Script& script, const Style& style,
                         Microseconds last_move) {
  ReplayListener listener(catalog, script, style);
  listener.set_last_move(last_move);
  return run(catalog, script, listener);
}

}  // namespace cbc
