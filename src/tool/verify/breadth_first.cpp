#include "verify/breadth_first.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>

#include "support/threads.h"

namespace cbc {

namespace {

/// States that one thread expands at a time.
constexpr StateStore::Number part_size = 128;
/// States that are expanded before their successors are inserted.
constexpr StateStore::Number batch_size = 16384;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

std::uint32_t* Successors::add() {
  ++transitions_;
  candidates_.push_back({0, parent_});
  words_.resize(candidates_.size() * known_.words());
  return words_.data() + words_.size() - known_.words();
}

void Successors::end() {
  const std::size_t width = known_.words();
  for (std::size_t place = kept_; place < candidates_.size(); ++place) {
    candidates_[place].hash = known_.hash(words_.data() + place * width);
    known_.prefetch(candidates_[place].hash);
  }
  for (std::size_t place = kept_; place < candidates_.size(); ++place) {
    const std::uint32_t* const state = words_.data() + place * width;
    if (known_.contains(state, candidates_[place].hash)) continue;
    candidates_[kept_] = candidates_[place];
    std::copy_n(state, width, words_.data() + kept_ * width);
    ++kept_;
  }
  candidates_.resize(kept_);
  words_.resize(kept_ * width);
}

void Successors::clear() {
  candidates_.clear();
  words_.clear();
  kept_ = 0;
  transitions_ = 0;
}

BreadthFirst::BreadthFirst(const std::vector<std::uint32_t>& first,
                           const ExplorationOptions& options)
    : options_(options), store_(first.size()), level_begin_{0} {
  store_.insert(first.data(), store_.hash(first.data()), 0);
}

void BreadthFirst::run(const std::vector<std::unique_ptr<Expander>>& expanders) {
  if (options_.limits.seconds > 0) deadline_ = seconds_now() + options_.limits.seconds;
  while (expanded_ < store_.size()) {
    if (!may_go_on()) return;
    const StateStore::Number level_end = store_.size();
    level_begin_.push_back(level_end);
    while (expanded_ < level_end) {
      const StateStore::Number end = std::min(level_end, expanded_ + batch_size);
      if (!expand_batch(expanded_, end, expanders)) return;
      expanded_ = end;
      if (expanded_ < level_end && !may_go_on()) return;
    }
  }
  level_begin_.pop_back();
}

/// False if a limit ended it. Then its successors are not inserted.
bool BreadthFirst::expand_batch(StateStore::Number begin, StateStore::Number end,
                                const std::vector<std::unique_ptr<Expander>>& expanders) {
  const std::size_t parts = (end - begin + part_size - 1) / part_size;
  while (parts_.size() < parts) parts_.emplace_back(store_);
  std::atomic<std::size_t> next{0};
  std::atomic<bool> is_stopped{false};
  run_in_threads(std::min(expanders.size(), parts), [&](std::size_t job) {
    Expander& expander = *expanders[job];
    for (std::size_t part = next++; part < parts && !is_stopped; part = next++) {
      Successors& successors = parts_[part];
      successors.clear();
      const auto first = begin + static_cast<StateStore::Number>(part) * part_size;
      for (StateStore::Number number = first; number < std::min(end, first + part_size); ++number) {
        successors.begin(number);
        expander.expand(store_.state(number), number, successors);
        successors.end();
      }
      if (job == 0 && !may_go_on()) is_stopped = true;
    }
  });
  if (is_stopped) return false;
  for (std::size_t part = 0; part < parts; ++part) insert(parts_[part]);
  return true;
}

void BreadthFirst::insert(const Successors& successors) {
  transitions_ += successors.transitions();
  constexpr std::size_t ahead = 16;
  const auto& candidates = successors.candidates_;
  for (std::size_t place = 0; place < candidates.size(); ++place) {
    if (place + ahead < candidates.size()) store_.prefetch(candidates[place + ahead].hash);
    store_.insert(successors.words_.data() + place * store_.words(), candidates[place].hash,
                  candidates[place].parent);
  }
}

bool BreadthFirst::may_go_on() {
  const ExplorationLimits& limits = options_.limits;
  const auto end_by = [this](ExplorationEnd end) {
    end_ = end;
    return false;
  };
  if (limits.max_states > 0 && store_.size() >= limits.max_states) {
    return end_by(ExplorationEnd::max_states);
  }
  if (store_.size() >= StateStore::most_states - batch_size * 64) {
    return end_by(ExplorationEnd::too_many);
  }
  // With as many new states as a batch usually finds.
  constexpr std::uint64_t room = std::uint64_t{batch_size} * 8;
  if (limits.max_memory > 0 && store_.bytes_for(store_.size() + room) > limits.max_memory) {
    return end_by(ExplorationEnd::max_memory);
  }
  if (deadline_ > 0 && seconds_now() >= deadline_) return end_by(ExplorationEnd::time_limit);
  if (!options_.on_progress) return true;
  return options_.on_progress({store_.size(), transitions_, store_.size() - expanded_,
                               static_cast<std::uint32_t>(level_begin_.size() - 1)}) ||
         end_by(ExplorationEnd::stopped);
}

std::uint32_t BreadthFirst::depth_of(StateStore::Number number) const {
  const auto after = std::upper_bound(level_begin_.begin(), level_begin_.end(), number);
  return static_cast<std::uint32_t>(after - level_begin_.begin() - 1);
}

std::uint32_t BreadthFirst::expanded_depth() const {
  if (expanded_ == 0) return 0;
  // The last level of which a state was expanded, unless others of it were not.
  const std::uint32_t last = depth_of(expanded_ - 1);
  const bool is_whole = last + 1 >= level_begin_.size() || expanded_ >= level_begin_[last + 1];
  return is_whole || last == 0 ? last : last - 1;
}

std::vector<std::uint64_t> BreadthFirst::states_at_depth() const {
  std::vector<std::uint64_t> counts;
  for (std::size_t depth = 0; depth < level_begin_.size(); ++depth) {
    const bool is_last = depth + 1 == level_begin_.size();
    const StateStore::Number end = is_last ? store_.size() : level_begin_[depth + 1];
    if (is_last && !is_complete() && expanded_ < level_begin_[depth]) break;
    counts.push_back(end - level_begin_[depth]);
  }
  return counts;
}

std::vector<StateStore::Number> BreadthFirst::path_to(StateStore::Number number) const {
  std::vector<StateStore::Number> path{number};
  while (path.back() != 0) path.push_back(store_.parent(path.back()));
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace cbc
