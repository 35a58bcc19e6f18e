#pragma once

#include <cstdint>

#include "explore/space/state_part.h"

namespace cbc {

/// The states of a part in which something was seen first, of least depth: a path to one of them is
/// the shortest script that shows it. The part, which keeps them, must outlive it.
class FirstStates {
 public:
  static constexpr std::uint32_t never = UINT32_MAX;

  explicit FirstStates(StatePart& part) : part_(&part) {}

  /// Notes states, in the order of their controls at each depth.
  void add(const StatePart::States& states, std::uint32_t depth) {
    if (states.environments == Diagrams::empty || depth_ < depth) return;
    depth_ = depth;
    if (layer_.empty() || layer_.back().control != states.control) {
      layer_.push_back({states.control, Diagrams::empty});
    }
    StatePart::Set& known = layer_.back().environments;
    known = part_->system().sets().either(known, states.environments);
    part_->keep(layer_.back());
  }

  /// The least depth; never: nothing was noted.
  [[nodiscard]] std::uint32_t depth() const { return depth_; }
  [[nodiscard]] const StatePart::Layer& layer() const { return layer_; }

 private:
  StatePart* part_;
  std::uint32_t depth_ = never;
  StatePart::Layer layer_;
};

}  // namespace cbc
