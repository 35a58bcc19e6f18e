#include "core/script/repetition.h"

namespace cbc {
namespace {

class PassOn final : public RunListener {
 public:
  explicit PassOn(const TakeEvent& take) : take_(take) {}
  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override {
    take_(record, step, state);
  }

 private:
  const TakeEvent& take_;
};

}  // namespace

Call clock_call(Microseconds time) {
  Call call;
  call.is_clock = true;
  call.step.time = time;
  call.step.expect.emplace();
  return call;
}

bool make_call(Runner& runner, const Call& call) {
  runner.restart_count();
  return runner.take(call.step) && (!call.is_clock || runner.settle());
}

void repeat(const CompiledCatalog& catalog, const CoordinatorOptions& options,
            const Snapshot& before, const Call& call, const Questions& questions,
            const TakeEvent& take) {
  PassOn listener(take);
  Runner runner(catalog, options, listener, questions);
  runner.resume(before);
  (void)make_call(runner, call);  // it was done before, or is stopped
}

}  // namespace cbc
