#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "explore/moves/stepper.h"
#include "versions/lockstep/same_as.h"
#include "versions/lockstep/same_as_pair.h"

namespace cbc {

/// Compares what one move does in both catalogs, task by task. Events and changes of what only one
/// of them has are left out.
class AnswerComparison {
 public:
  using Differences = ComparisonScope::Differences;
  using Aspect = TaskDifference::Aspect;
  using Happening = MoveTrace::Happening;

  /// One thing that differs about a task.
  struct Note {
    std::uint32_t task = 0;  ///< place in ModelPair::tasks
    Aspect aspect = Aspect::outcome;
    std::string line;  ///< see TaskDifference; only if lines are asked for
  };

  /// `allow_missing`: that a task runs which only one of them has is no difference.
  AnswerComparison(const ModelPair& models, Differences differences, bool allow_missing)
      : models_(models), differences_(differences), allow_missing_(allow_missing) {}

  /// `new_cells`, `old_cells`: the states after the move.
  void compare(const MoveTrace& of_new, const MoveTrace& of_old, const std::uint16_t* new_cells,
               const std::uint16_t* old_cells);
  void set_with_lines(bool with_lines) { with_lines_ = with_lines; }

  /// What differs; a task may stand more than once.
  [[nodiscard]] const std::vector<Note>& notes() const { return notes_; }
  /// Whether nothing differs about tasks that both have.
  [[nodiscard]] bool is_alike() const { return is_alike_; }
  /// Whether a start, stop or finish was made in both.
  [[nodiscard]] bool is_compared() const { return is_compared_; }
  [[nodiscard]] std::string name_of(std::uint32_t task) const;

 private:
  using Part = std::span<const std::uint16_t>;

  void compare_events(const std::vector<Happening>& ours, const std::vector<Happening>& theirs);
  void compare_answers(const Happening& ours, const Happening& theirs);
  void compare_changes(const Happening& ours, const Happening& theirs);
  void compare_stops(const Happening& ours, const Happening& theirs);
  void compare_running(const std::uint16_t* new_cells, const std::uint16_t* old_cells);
  void compare_suspended(const Happening& ours, const Happening& theirs);
  void compare_queues(Part new_queue, Part old_queue, Part new_waiting, Part old_waiting);

  [[nodiscard]] bool is_in_both(const Happening& event, bool is_new) const;
  [[nodiscard]] bool is_same_event(const Happening& ours, const Happening& theirs) const;
  [[nodiscard]] bool is_same_change(const MoveTrace::Change& ours,
                                    const MoveTrace::Change& theirs) const;

  /// `to_line` makes the line, if it is asked for.
  template <typename ToLine>
  void note(std::uint32_t task, Aspect aspect, const ToLine& to_line);
  /// For each task of a behavior, or of an event.
  template <typename ToLine>
  void note_behavior(std::uint32_t behavior, bool is_new, Aspect aspect, const ToLine& to_line);
  template <typename ToLine>
  void note_event(const Happening& event, bool is_new, Aspect aspect, const ToLine& to_line);
  bool note_lone_event(const Happening& event, bool is_new, const std::vector<Happening>& others);
  bool note_lone_changes(const Happening& event, bool is_new, const Happening& other);

  [[nodiscard]] const Model& model(bool is_new) const {
    return is_new ? models_.new_model : models_.old_model;
  }
  [[nodiscard]] std::string file(bool is_new) const;
  [[nodiscard]] std::string behavior_name(std::uint32_t behavior, bool is_new) const;
  [[nodiscard]] std::string label_of(std::uint32_t task) const;
  [[nodiscard]] std::string describe(const Happening& event, bool is_new) const;

  const ModelPair& models_;
  const Differences differences_;
  const bool allow_missing_;
  bool with_lines_ = false;
  std::vector<Note> notes_;
  Happening our_skipped_;
  Happening their_skipped_;
  bool is_alike_ = true;
  bool is_compared_ = false;
};

}  // namespace cbc
