#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "explore/space/state_part.h"

namespace cbc {

/// Goes from the first state to others, one move at a time: sets of environments answer questions,
/// but a script is about single states. It uses the controls of a part, which must outlive it, but
/// its states may be of any part.
class StateWalker {
 public:
  explicit StateWalker(StatePart& part);

  /// Goes to a state without a mark, whose control has this number in the part.
  void go_to(Controls::Number control, const std::vector<std::uint8_t>& environment);
  /// Takes up the control of the state in the system of the part.
  void load() { part_->controls().load(control_); }
  [[nodiscard]] const std::uint32_t* control() const { return part_->controls().packed(control_); }
  [[nodiscard]] const std::vector<std::uint8_t>& environment() const { return environment_; }

  /// Makes a move from the state, by its place in ControlSystem::moves(). Nothing: the state does
  /// not have it.
  [[nodiscard]] std::optional<Controls::NumberedResult> try_move(std::size_t place);
  // What the move led to, if it led anywhere.
  [[nodiscard]] const std::uint32_t* control_after() const {
    return part_->controls().packed(result_.control);
  }
  /// Its mark is still that of the state before.
  [[nodiscard]] const std::vector<std::uint8_t>& environment_after() const { return after_; }
  /// Goes on to there.
  void go_on();

 private:
  StatePart* part_;
  Controls::Number control_ = none;
  std::vector<std::uint8_t> environment_;
  Controls::NumberedResult result_;
  std::vector<std::uint8_t> after_;
};

}  // namespace cbc
