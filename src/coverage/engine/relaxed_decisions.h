#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "coverage/engine/goals.h"
#include "explore/model/model.h"
#include "explore/moves/decisions.h"
#include "explore/moves/stepper.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// Asks which constraints decide the events of an exploration: what would be answered without each.
/// It exists beside ConstraintRelaxation, as a move stands for many environments, whose domains
/// differ. Not for use by several threads.
class RelaxedDecisions {
 public:
  /// `wanted`: by goal. Beyond `most_bytes` of answers, all are forgotten. Model and goals must
  /// outlive this object.
  RelaxedDecisions(const Model& model, std::span<const Goal> goals,
                   const std::vector<std::uint8_t>& wanted, std::size_t most_bytes);

  /// Calls `meet` with each goal that the answer meets, but for those that `is_open` leaves out,
  /// and marks those of which the answer may have been another one.
  void ask(Stepper& stepper, const Stepper::Answer& answer,
           const std::function<bool(std::uint32_t)>& is_open,
           const std::function<void(std::uint32_t)>& meet, std::vector<std::uint8_t>& was_asked);

 private:
  struct Variant {
    Variant(const Model& model, CompiledCatalog without, std::size_t most_bytes)
        : catalog(std::move(without)), decisions(model, catalog, most_bytes) {}

    CompiledCatalog catalog;
    Decisions decisions;
  };
  using Values = std::function<bool(std::uint32_t)>;

  [[nodiscard]] bool may_matter(const Goal& goal, const Values& may_have) const;
  void note_asked(Stepper& stepper, const Stepper::Trigger& trigger,
                  std::vector<std::uint8_t>& was_asked);
  [[nodiscard]] bool differs(Stepper& stepper, const Stepper::Answer& answer, std::uint32_t goal,
                             bool is_asked);
  [[nodiscard]] const std::vector<std::uint32_t>& suspects(
      Stepper& stepper, const Stepper::Answer& answer,
      const std::function<bool(std::uint32_t)>& is_open);
  void write_key(const Stepper& stepper, const Stepper::Trigger& trigger);

  const Model& model_;
  const std::span<const Goal> goals_;
  std::vector<std::vector<std::uint32_t>> deciding_;  ///< by group of the model: wanted goals
  std::vector<std::vector<std::uint32_t>> unasked_;   ///< of these
  std::size_t bytes_of_variant_ = 0;
  std::size_t most_variants_;
  std::unordered_map<std::uint32_t, std::unique_ptr<Variant>> variants_;  ///< by goal
  /// By what an answer depends on: goals without whose constraint it may be another one.
  std::unordered_map<std::string, std::vector<std::uint32_t>> suspects_;
  std::size_t most_suspects_;
  std::string key_;
};

}  // namespace cbc
