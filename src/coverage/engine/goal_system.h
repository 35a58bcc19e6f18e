#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "coverage/engine/goal_notes.h"
#include "coverage/engine/goals.h"
#include "coverage/engine/relaxed_decisions.h"
#include "coverage/engine/timeout_race.h"
#include "explore/controls/catalog_system.h"
#include "explore/model/model.h"
#include "explore/moves/stepper.h"

namespace cbc {

/// Which goals an exploration asks about.
struct GoalQuestion {
  std::span<const Goal> goals;       ///< those of find_goals
  std::vector<std::uint8_t> wanted;  ///< by goal
  /// Whether all moves that meet a goal count; otherwise one is enough.
  bool is_about_moves = false;
};

/// The states of a model whose moves are watched for goals: what a move meets is its note. So goals
/// are found where moves are made, once for all environments in which the same comes of a move, and
/// meets the same goals. Any failure may be a timeout, as there are no times.
class GoalSystem final : public CatalogSystem, private AnswerListener {
 public:
  /// Model and question must outlive it.
  GoalSystem(const Model& model, const Stepper::Options& options, const GoalQuestion& question);

  /// What a move meets: goals, ascending. A return (Goal::Kind::reactive_returned) counts only if
  /// the task has given way before on the path: a number beyond those of goals says that of the
  /// goal that is so much less.
  [[nodiscard]] const std::vector<std::uint32_t>& items_of(std::uint32_t note) const {
    return items_of_notes_[note];
  }
  /// By goal: whether a move has met it; of returns, and of values of variables nothing is known.
  [[nodiscard]] const std::vector<std::uint8_t>& met() const { return met_; }
  [[nodiscard]] const GoalFacts& facts() const { return notes_.facts(); }
  [[nodiscard]] const TimeoutRace& race() const { return race_; }
  /// Takes note of the situations of reachable states.
  void note_situations(Set environments);

  [[nodiscard]] MoveResult take(std::uint32_t action, SystemOracle& oracle) override;
  void for_each_kept(const std::function<void(Set)>& keep) const override;

 private:
  /// What a change of the situation does to a behavior.
  struct Fit {
    std::uint32_t behavior = none;  ///< as the model counts
    Set begins = Diagrams::empty;
    Set ceases = Diagrams::empty;
  };

  void find_changes();
  void on_answer(Stepper& stepper, const Stepper::Answer& answer) override;
  void note_answer(const Stepper& stepper, const Trigger& trigger, std::uint32_t group,
                   const Word* solution);
  [[nodiscard]] bool is_open(std::uint32_t goal) const {
    return goal != none && question_.wanted[goal] != 0 &&
           (question_.is_about_moves || met_[goal] == 0);
  }
  void note_fits(std::uint32_t action, SystemOracle& oracle);
  [[nodiscard]] std::uint32_t note_of_move(std::uint32_t action);

  const GoalQuestion& question_;
  GoalNotes notes_;
  RelaxedDecisions relaxed_;
  TimeoutRace race_;
  std::vector<std::uint8_t> met_;
  std::vector<std::uint32_t> returns_;              ///< by task: its goal of returning, if wanted
  std::vector<std::uint32_t> conditional_;          ///< behaviors that name variables
  std::vector<std::vector<Fit>> changes_;           ///< by action
  std::vector<std::vector<std::uint32_t>> values_;  ///< by action: goals of values that it sets
  std::vector<std::vector<std::uint32_t>> items_of_notes_{1};
  std::map<std::vector<std::uint32_t>, std::uint32_t> numbers_of_notes_;

  // Of the present move.
  MoveTrace trace_;
  TimeoutRace::Changes changed_;
  std::vector<TaskId> started_;  ///< reactive tasks, by themselves
  // Of the present event; kept for their memory.
  std::vector<BehaviorId> behaviors_;
  std::vector<std::optional<std::int32_t>> requests_;
  Assignment solution_;
  std::vector<std::uint32_t> items_;
};

}  // namespace cbc
