
#include "core/report/explanation_json.h"
#include "core/report/failure_explanation.h"
#include "core/report/run_text.h"
#include "core/support/json_description.h"
#include "core/support/system.h"
#include "runtime/coordinator/record.h"
#include "verify/report/verify_report.h"

namespace cbc {
namespace {

/// What a property demands of the last state, as far as an expectation can say it.
Expectation demand_of(const CompiledCatalog& catalog, const Property& property) {
  Expectation demand;
  if (property.kind == Property::Kind::can_start) demand.outcome = Outcome::accepted;
  if (property.kind != Property::Kind::always) return demand;
  for (const auto& [task, behavior] : property.condition.running) {
    auto& running = demand.running.emplace_back();
    running.task = catalog.tasks[task].catalog_index;
    if (behavior != none) running.behavior = catalog.behaviors[behavior].catalog_index;
  }
  return demand;
}

/// Writes a run in the words of `cbc solve`, and notes what led to its end.
class ReplayListener final : public RunListener {
 public:
  /// `property`: that the script is about, or null.
  ReplayListener(const CompiledCatalog& catalog, const Script& script, const Property* property,
                 const Style& style, Microseconds last_move)
      : catalog_(catalog),
        property_(property),
        last_move_(last_move),
        text_(style, memory_.stream()) {
    text_.begin_run(catalog, script);
    explanation_.begin_run(catalog, script);
  }

  void on_event(const EventRecord& record, const Step* step, const State& state) override {
    if (record.time >= last_move_) begin_last_move();
    text_.on_event(record, step, state);
    explanation_.add(record, step, state);
    if (record.origin != Origin::script || record.verb != Verb::start) return;
    conflict_.clear();
    JsonWriter json(conflict_);
    json::list(json::pointed(json::reason))
        .write(json, order_reasons(catalog_, record.conflict, std::span(&record.task, 1)),
               json::ReasonContext{catalog_, record});
  }
  void on_failure(const Failure& failure) override { text_.on_failure(failure); }
  void on_end(const State& state) override {
    begin_last_move();
    text_.on_end(state);
    if (property_ != nullptr)
      explanation_lines_ = explanation_.tell(demand_of(catalog_, *property_));
  }

  Replay take(RunResult result) && {
    begin_last_move();
    std::string text(memory_.text());
    // The report says which script this is.
    const std::size_t title = text.find("\n\n") + 2;
    text.erase(0, title);
    return {std::move(result), std::move(text), *last_move_begin_ - title, std::move(conflict_),
            std::move(explanation_lines_)};
  }

 private:
  void begin_last_move() {
    if (!last_move_begin_) last_move_begin_ = memory_.size();
  }

  const CompiledCatalog& catalog_;
  const Property* const property_;
  const Microseconds last_move_;
  std::optional<std::size_t> last_move_begin_;
  MemoryFile memory_;
  TextReport text_;
  FailureExplanation explanation_;
  std::string conflict_ = "[]";
  std::vector<std::string> explanation_lines_;
};

}  // namespace

Replay replay(const CompiledCatalog& catalog, const Script& script, const Property* property,
              const Style& style, Microseconds last_move) {
  CoordinatorOptions options;
  options.explain.displaced = true;
  ReplayListener listener(catalog, script, property, style, last_move);
  RunResult result = run_script(catalog, script, options, listener);
  return std::move(listener).take(std::move(result));
}

}  // namespace cbc
