#include "core/words/move_words.h"

#include <limits>

#include "core/words/words.h"

namespace cbc {
namespace {

class MoveWords final : public RunListener {
 public:
  MoveWords(const CompiledCatalog& catalog, std::span<const Microseconds> due,
            std::vector<std::string>& moves)
      : catalog_(catalog), due_(due), moves_(moves) {}

  void on_event(const ExplainedRecord& record, const Step* step, const State& /*state*/) override {
    if (step == nullptr) return;
    add_due(record.time);
    moves_.push_back(describe_event(catalog_, record, step));
  }
  void on_end(const State& /*state*/) override {
    add_due(std::numeric_limits<Microseconds>::max());
  }

 private:
  void add_due(Microseconds until) {
    for (; !due_.empty() && due_.front() < until; due_ = due_.subspan(1)) {
      moves_.emplace_back("the queue comes due");
    }
  }

  const CompiledCatalog& catalog_;
  std::span<const Microseconds> due_;  ///< still to come
  std::vector<std::string>& moves_;
};

}  // namespace

RunResult describe_moves(const CompiledCatalog& catalog, const Script& script,
                         std::span<const Microseconds> due, std::vector<std::string>& moves) {
  MoveWords words(catalog, due, moves);
  return run_script(catalog, script, {}, words);
}

}  // namespace cbc
