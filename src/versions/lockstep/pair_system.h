#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "explore/controls/control_stepper.h"
#include "explore/controls/control_system.h"
#include "explore/moves/stepper.h"
#include "versions/lockstep/paired_bits.h"
#include "versions/lockstep/same_as.h"
#include "versions/lockstep/same_as_answers.h"
#include "versions/lockstep/same_as_pair.h"

namespace cbc {

/// Pairs of states that the same moves lead to in the models of two catalogs. A move is made in
/// both; one that is decided differently leads nowhere. A result's note says about which tasks
/// something differs. Models, bits and scope must outlive it.
class PairSystem final : public ControlSystem {
 public:
  PairSystem(const ModelPair& models, const PairedBits& bits, const ComparisonScope& scope,
             const Stepper::Options& options);

  /// The tasks that a note is about, as ModelPair::tasks has them, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& tasks_of(std::uint32_t note) const {
    return tasks_of_notes_[note];
  }
  /// Whether a start, stop or finish was made in both.
  [[nodiscard]] bool is_compared() const { return is_compared_; }
  /// Makes a move of the loaded control in one environment again, so that answers() has lines.
  void describe(const StateMove& move, const std::vector<std::uint8_t>& environment);
  /// What differs in the last move.
  [[nodiscard]] const AnswerComparison& answers() const { return answers_; }

  [[nodiscard]] const std::vector<std::uint32_t>& first_control() const override { return first_; }
  [[nodiscard]] std::vector<std::uint8_t> first_environment() const override;
  void load(const std::uint32_t* control) override;
  [[nodiscard]] bool may_have(std::uint32_t action) const override;
  [[nodiscard]] MoveResult take(std::uint32_t action, SystemOracle& oracle) override;
  [[nodiscard]] MoveResult take_fault() override;
  [[nodiscard]] MoveResult take_repair(std::uint32_t kind) override;
  void for_each_kept(const std::function<void(Set)>& keep) const override;

 private:
  /// One of the two catalogs.
  struct Side {
    Side(const Model& model, const Stepper::Options& options, const EnvironmentBits& bits,
         Diagrams& sets);
    /// `choice`: null: it does not have the move.
    void take(const Model::Choice* choice, const Environments::ActionEffect& effect,
              SystemOracle& oracle);

    ControlStepper controls;
    MoveTrace trace;
  };
  /// What an action tries in both.
  struct PairedAction {
    const Model::Choice* of_new = nullptr;
    const Model::Choice* of_old = nullptr;
    Environments::ActionEffect new_effect;
    Environments::ActionEffect old_effect;
  };

  void add_moves();
  void add_actions(const ModelPair::PairedMove& move);
  [[nodiscard]] MoveResult compare();
  [[nodiscard]] Diagrams::ValuesNumber both_values(Diagrams::ValuesNumber a,
                                                   Diagrams::ValuesNumber b);
  [[nodiscard]] bool has_too_many_suspended() const;
  [[nodiscard]] std::uint32_t note_of(const std::vector<AnswerComparison::Note>& notes);

  const ModelPair& models_;
  const PairedBits& bits_;
  Side new_;
  Side old_;
  AnswerComparison answers_;
  bool is_compared_ = false;
  std::vector<PairedAction> paired_;   ///< by action
  std::vector<std::uint32_t> first_;   ///< control of the new catalog, then that of the old one
  std::vector<std::uint32_t> packed_;  ///< after the move
  std::map<std::pair<Diagrams::ValuesNumber, Diagrams::ValuesNumber>, Diagrams::ValuesNumber>
      both_values_;
  std::vector<std::vector<std::uint32_t>> tasks_of_notes_{1};
  std::map<std::vector<std::uint32_t>, std::uint32_t> notes_;  ///< by tasks
};

}  // namespace cbc
