// The states of a control are all in one part, by a hash of the control (U. Stern and D. L. Dill,
// "Parallelizing the Murphi verifier", Formal Methods in System Design 18 (2001)). What moves lead
// to in another part is sent there once all moves of a round are made.
//
// The first shortest path to a target: backward, the states of each depth from which it can still
// be reached in time; then forward, in single states, always the first move into those.

#include "verify/engine/state_space.h"

#include <algorithm>
#include <utility>

namespace cbc {

namespace {

using Number = Controls::Number;
using Set = Environments::Set;
using Layer = StatePart::Layer;
using Parcels = std::vector<StatePart::Parcel>;

}  // namespace

StateSpace::StateSpace(const Model& model, const Stepper::Options& options,
                       const ExplorationLimits& limits, unsigned threads, OnProgress on_progress,
                       const std::optional<StatePart::Mark>& mark)
    : model_(model),
      options_(options),
      limits_(limits),
      on_progress_(std::move(on_progress)),
      told_(threads) {
  Stepper::Options of_part = options;
  of_part.decision_bytes /= threads;
  for (unsigned place = 0; place < threads; ++place) {
    parts_.push_back(std::make_unique<StatePart>(model, of_part, mark, place, threads));
  }
  if (limits_.seconds > 0) {
    deadline_ = std::chrono::steady_clock::now() +
                std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                    std::chrono::duration<double>(limits_.seconds));
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
  if (limits_.max_states > 0 && states_ >= limits_.max_states) {
    return end_by(ExplorationEnd::max_states);
  }
  std::uint64_t bytes = 0;
  std::uint64_t transitions = 0;
  std::uint64_t controls = 0;
  for (const Told& told : told_) {
    bytes += told.bytes;
    transitions += told.transitions;
    controls += told.controls;
  }
  if (limits_.max_memory > 0 && bytes >= limits_.max_memory) {
    return end_by(ExplorationEnd::max_memory);
  }
  if (deadline_ && std::chrono::steady_clock::now() >= *deadline_) {
    return end_by(ExplorationEnd::time_limit);
  }
  if (!on_progress_) return true;
  return on_progress_({states_, transitions, states_at_depth_.back(),
                       static_cast<std::uint32_t>(states_at_depth_.size() - 1), controls}) ||
         end_by(ExplorationEnd::stopped);
}

bool StateSpace::end_by(ExplorationEnd end) {
  end_ = end;
  is_stopped_ = true;
  return false;
}

/// All states up to a depth were visited, and no more are asked for.
void StateSpace::end_with(std::uint32_t depth) {
  expanded_depth_ = depth;
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

StateSpace::Path StateSpace::path_to(const std::vector<Layer>& targets, std::uint32_t depth) {
  const std::size_t count = parts_.size();
  // By depth and part, states from which targets can be reached in time, before their marks are set
  // and cleared.
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

  Path path{{}, model_.packed_first()};
  Stepper stepper(model_, options_);
  std::vector<std::uint8_t> string;
  const auto part_of = [&](const std::uint16_t* cells) {
    StatePart& any = *parts_.front();
    return any.part_of(any.controls().pack(cells));
  };
  bool is_marked = false;
  for (std::uint32_t after = 0;; ++after) {
    stepper.load(path.end.data());
    if (StatePart& part = *parts_.front(); part.has_mark()) {
      const Diagrams& sets = part.environments().sets();
      part.environments().read(stepper.cells(), string);
      const StatePart::MarkSets marks = part.find_marks(stepper);
      is_marked = !sets.contains(marks.to_clear, string) &&
                  (is_marked || sets.contains(marks.to_set, string));
    }
    if (after == depth) return path;
    for (const Model::Choice& choice : model_.moves()) {
      if (!stepper.try_move(choice)) continue;
      const std::size_t place = part_of(stepper.cells_after());
      StatePart& part = *parts_[place];
      const Number control = part.controls().find(stepper.cells_after());
      part.environments().read(stepper.cells_after(), string);
      if (part.has_mark()) part.environments().write_mark(is_marked, string);
      const Set set = StatePart::environments_in(wanted[after + 1][place], control);
      if (!part.environments().sets().contains(set, string)) continue;
      path.moves.push_back(stepper.move_of(choice));
      stepper.pack(path.end.data());
      break;
    }
  }
}

std::optional<std::vector<std::vector<Set>>> StateSpace::can_reach(
    const std::vector<Layer>& goals, const MoveKinds* kinds, std::optional<std::uint32_t> within) {
  std::vector<std::vector<Set>> reaching;
  for (const auto& part : parts_) reaching.emplace_back(part->controls().size(), Diagrams::empty);
  std::vector<Layer> newest = goals;
  const auto add = [&](std::size_t part) {
    Diagrams& sets = parts_[part]->environments().sets();
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
      newest[place] = part.sources_of(wanted[place], kinds, [&](Number control) {
        const bool goes_on = may_go_on(place);
        return !goes_on ? Diagrams::empty
                        : part.environments().sets().without(part.visited(control),
                                                             reaching[place][control]);
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
