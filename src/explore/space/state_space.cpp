// The states of a control are all in one part, by a hash of the control (U. Stern and D. L. Dill,
// "Parallelizing the Murphi verifier", Formal Methods in System Design 18 (2001)). What moves lead
// to in another part is sent there once all moves of a round are made.
//
// The first shortest path to a target: backward, the states of each depth from which it can still
// be reached in time; then forward, in single states, always the first move into those.

#include "explore/space/state_space.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

namespace cbc {

namespace {

using Number = Controls::Number;
using Set = StatePart::Set;
using Layer = StatePart::Layer;
using Parcels = std::vector<StatePart::Parcel>;

/// A number in at most five characters, so that a line of progress fits: "1234", "1234k".
std::string shorten(std::uint64_t number) {
  constexpr std::array units = {"", "k", "M", "G"};
  std::size_t unit = 0;
  for (; number >= 10'000 && unit + 1 < units.size(); ++unit) number /= 1000;
  return std::to_string(number) + units.at(unit);
}

}  // namespace

StateSpace::StateSpace(Systems systems, const Budget& budget, std::string what)
    : budget_(budget.started()), what_(std::move(what)), told_(systems.size()) {
  for (std::unique_ptr<ControlSystem>& system : systems) {
    parts_.push_back(std::make_unique<StatePart>(std::move(system), parts_.size(), systems.size()));
  }
}

void StateSpace::for_each_part(std::uint64_t size,
                               const std::function<void(std::size_t)>& work) const {
  constexpr std::uint64_t worth_a_thread = 16;  // controls
  const std::size_t threads = size < worth_a_thread * parts_.size() ? 1 : parts_.size();
  for_each_in_threads(parts_.size(), threads,
                      [&](std::size_t /*thread*/, std::size_t part) { work(part); });
}

std::uint64_t StateSpace::transitions() const {
  std::uint64_t transitions = 0;
  for (const auto& part : parts_) transitions += part->transitions();
  return transitions;
}

std::uint64_t StateSpace::bytes() const {
  std::uint64_t bytes = 0;
  for (const auto& part : parts_) bytes += part->bytes();
  return bytes;
}

std::uint64_t StateSpace::size_of_layer(std::uint32_t depth) const {
  std::uint64_t size = 0;
  for (const auto& part : parts_) size += part->layers()[depth].size();
  return size;
}

// Limits. Parts ask while others go on.

bool StateSpace::may_go_on(std::size_t part) {
  constexpr std::uint32_t moves_between_looks = 64;
  if (is_stopped_) return false;
  if (++told_[part].asked % moves_between_looks != 0) return true;
  tell(part);
  return look_at_limits();
}

void StateSpace::tell(std::size_t part) {
  told_[part].bytes = parts_[part]->bytes();
  told_[part].transitions = parts_[part]->transitions();
  told_[part].controls = parts_[part]->controls_visited();
}

bool StateSpace::look_at_limits() {
  const std::unique_lock lock(looking_, std::try_to_lock);
  if (!lock.owns_lock()) return !is_stopped_;
  std::uint64_t bytes = bytes_beside_;
  std::uint64_t transitions = 0;
  std::uint64_t controls = 0;
  for (const Told& told : told_) {
    bytes += told.bytes;
    transitions += told.transitions;
    controls += told.controls;
  }
  if (const std::optional<Budget::End> end = budget_.find_end(states_, bytes)) {
    end_ = *end;
    is_stopped_ = true;
    return false;
  }
  if (!budget_.tell) return true;
  budget_.tell(what_, [&] {
    const std::chrono::duration<double> elapsed = Budget::Clock::now() - begin_;
    const double rate = static_cast<double>(transitions) / std::max(elapsed.count(), 1e-6);
    return fmt::format(" (depth {}, {} states, {} controls, {} moves/s)",
                       states_at_depth_.size() - 1, shorten(states_), shorten(controls),
                       shorten(static_cast<std::uint64_t>(rate)));
  });
  return true;
}

/// All states up to a depth were visited, and no more are asked for.
void StateSpace::end_with(std::uint32_t depth) {
  expanded_layers_ = depth + 1;
  is_decided_ = true;
}

/// Brings what was found to its parts.
void StateSpace::end_layer() {
  const std::size_t count = parts_.size();
  const std::uint64_t size = states_at_depth_.empty() ? 0 : states_at_depth_.back();
  std::vector<Parcels> parcels(count, Parcels(count));  // by receiver and sender
  std::vector<std::uint64_t> states(count, 0);
  if (count > 1) {
    for_each_part(size, [&](std::size_t sender) {
      for (std::size_t receiver = 0; receiver < count; ++receiver) {
        if (receiver == sender) continue;
        parcels[receiver][sender] = parts_[sender]->take_found(receiver);
      }
    });
  }
  for_each_part(size, [&](std::size_t part) {
    for (const StatePart::Parcel& parcel : parcels[part]) parts_[part]->add(parcel);
    states[part] = parts_[part]->end_layer();
    tell(part);
  });
  std::uint64_t all = 0;
  for (const std::uint64_t one : states) all += one;
  states_ += all;
  if (all > 0) states_at_depth_.push_back(all);
}

// Going backward.

/// Tells each part of the states of all parts, as far as it knows their controls.
std::vector<Layer> StateSpace::share(const std::vector<Layer>& layers) {
  const std::size_t count = parts_.size();
  if (count == 1) return layers;
  std::uint64_t size = 0;
  for (const Layer& layer : layers) size += layer.size();
  Parcels parcels(count);
  for_each_part(size, [&](std::size_t part) { parcels[part] = parts_[part]->pack(layers[part]); });
  std::vector<Layer> shared(count);
  for_each_part(size, [&](std::size_t part) { shared[part] = parts_[part]->unpack(parcels); });
  return shared;
}

std::uint32_t StateSpace::least_depth(const std::vector<const FirstStates*>& noted) {
  std::uint32_t depth = FirstStates::never;
  for (const FirstStates* const states : noted) depth = std::min(depth, states->depth());
  return depth;
}

/// By depth and part, states from which targets of a depth can be reached in time, before their
/// marks are set and cleared.
std::vector<std::vector<Layer>> StateSpace::layers_before(const std::vector<Layer>& targets,
                                                          std::uint32_t depth) {
  const std::size_t count = parts_.size();
  std::vector<std::vector<Layer>> wanted(depth + 1, std::vector<Layer>(count));
  const auto set_wanted = [&](std::uint32_t at, const std::vector<Layer>& layers) {
    for (std::size_t part = 0; part < count; ++part) {
      wanted[at][part] = parts_[part]->before_marks(layers[part]);
    }
  };
  set_wanted(depth, targets);
  for (std::uint32_t after = depth; after > 0; --after) {
    const std::vector<Layer> shared = share(wanted[after]);
    std::vector<Layer> found(count);
    for_each_part(size_of_layer(after - 1), [&](std::size_t part) {
      const Layer& all = parts_[part]->layers()[after - 1];
      found[part] = parts_[part]->sources_of(shared[part], nullptr, [&](Number control) {
        return StatePart::environments_in(all, control);
      });
    });
    set_wanted(after - 1, found);
  }
  return wanted;
}

StateSpace::Path StateSpace::path_to(const std::vector<const FirstStates*>& noted) {
  const std::uint32_t depth = least_depth(noted);
  std::vector<Layer> targets;
  targets.reserve(noted.size());
  for (const FirstStates* const states : noted) {
    targets.push_back(states->depth() == depth ? states->layer() : Layer());
  }
  const std::vector<std::vector<Layer>> wanted = layers_before(targets, depth);
  Path path{{}, {}, StateWalker(*parts_.front())};
  const auto& moves = parts_.front()->system().moves();
  for (std::uint32_t after = 1; after <= depth; ++after) {
    for (std::size_t place = 0; place < moves.size(); ++place) {
      const auto result = path.end.try_move(place);
      if (!result || result->control == none || !leads_to(path.end, wanted[after])) continue;
      path.moves.push_back(moves[place].move);
      path.places.push_back(place);
      path.end.go_on();
      break;
    }
  }
  return path;
}

/// Whether the move that was made leads to one of these states, by part.
bool StateSpace::leads_to(const StateWalker& walker, const std::vector<Layer>& wanted) const {
  const std::uint32_t* const packed = walker.control_after();
  const std::size_t place = parts_.front()->part_of(packed);
  StatePart& part = *parts_[place];
  const auto control = part.controls().known(packed);
  if (!control) return false;
  return part.system().sets().contains(StatePart::environments_in(wanted[place], *control),
                                       walker.environment_after());
}

std::optional<std::vector<std::vector<Set>>> StateSpace::can_reach(
    const std::vector<Layer>& goals, const MoveSelection* selection,
    std::optional<std::uint32_t> within) {
  std::vector<std::vector<Set>> reaching;
  for (const auto& part : parts_) reaching.emplace_back(part->controls().size(), Diagrams::empty);
  std::vector<Layer> newest = goals;
  const auto add = [&](std::size_t part) {
    Diagrams& sets = parts_[part]->system().sets();
    for (const States& states : newest[part]) {
      Set& known = reaching[part][states.control];
      known = sets.either(known, states.environments);
    }
  };
  const auto has_new = [&] {
    return std::any_of(newest.begin(), newest.end(),
                       [](const Layer& layer) { return !layer.empty(); });
  };
  for_each_part(0, add);
  for (std::uint32_t moves = 0; has_new() && (!within || moves < *within); ++moves) {
    const std::vector<Layer> wanted = share(newest);
    std::uint64_t size = 0;
    for (const Layer& layer : wanted) size += layer.size();
    for_each_part(size, [&](std::size_t place) {
      StatePart& part = *parts_[place];
      newest[place] = part.sources_of(wanted[place], selection, [&](Number control) {
        const bool goes_on = may_go_on(place);
        return !goes_on
                   ? Diagrams::empty
                   : part.system().sets().without(part.visited(control), reaching[place][control]);
      });
      add(place);
    });
    if (!is_stopped_) continue;
    is_complete_ = false;
    return std::nullopt;
  }
  return reaching;
}

}  // namespace cbc
