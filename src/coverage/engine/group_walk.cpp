#include "coverage/engine/group_walk.h"

#include <string_view>

namespace cbc {

GroupWalk::GroupWalk(const CompiledCatalog& catalog, std::uint32_t group,
                     const Assumptions& assumptions, GoalWatch& watch,
                     const GroupWalkOptions& options)
    : group_(group),
      options_(options),
      model_(catalog, {group}, assumptions),
      stepper_(model_, {.reduce = true}),
      replay_(model_, watch),
      watch_(watch),
      race_(catalog, group),
      packed_(model_.packed_words()) {}

GroupWalkResult GroupWalk::run(Listener& listener) {
  model_.pack(model_.first_state().data(), packed_.data());
  find(packed_);
  result_.is_complete = true;
  for (Number state = 0; state < states_.size() && result_.is_complete; ++state) {
    leave(state, listener);
  }
  if (result_.is_complete) race_.tell(watch_);
  result_.states = states_.size();
  return result_;
}

bool GroupWalk::may_go_on() const {
  // A state is there twice, and has a place in two tables.
  const std::size_t bytes = 2 * packed_.size() * sizeof(packed_.front()) + 128;
  return states_.size() <= options_.max_states && states_.size() <= options_.max_memory / bytes &&
         (!options_.on_progress || options_.on_progress(group_, states_.size()));
}

/// A limit may come before all of its moves are made.
void GroupWalk::leave(Number state, Listener& listener) {
  constexpr std::size_t moves_between_looks = 64;
  std::size_t moves = 0;
  stepper_.load(states_[state].data());
  replay_.load(stepper_);
  for (const Model::Choice& choice : model_.moves()) {
    if (moves++ % moves_between_looks == 0 && !may_go_on()) {
      result_.is_complete = false;
      return;
    }
    if (!stepper_.has_move(choice)) continue;
    const Move move = stepper_.move_of(choice);
    if (!stepper_.take(choice)) continue;
    ++result_.moves;
    stepper_.pack(packed_.data());
    listener.before_move();
    replay_.take(move);
    race_.note(replay_, move);
    listener.on_move(state, find(packed_), move, replay_);
  }
}

GroupWalk::Number GroupWalk::find(const std::vector<std::uint32_t>& packed) {
  const std::string_view bytes(reinterpret_cast<const char*>(packed.data()),
                               packed.size() * sizeof(packed.front()));
  const auto [entry, is_new] =
      numbers_.try_emplace(std::string(bytes), static_cast<Number>(states_.size()));
  if (is_new) states_.push_back(packed);
  return entry->second;
}

}  // namespace cbc
