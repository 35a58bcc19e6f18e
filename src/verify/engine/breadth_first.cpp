#include "verify/engine/breadth_first.h"

#include <algorithm>
#include <chrono>

#include "core/support/threads.h"

namespace cbc {

namespace {

/// States that one thread expands at a time.
constexpr StateStore::Number part_size = 128;
/// States that are expanded before their successors are inserted.
constexpr StateStore::Number batch_size = 16384;
/// Successors that one state may have before those are dropped that are known.
constexpr std::size_t most_unsifted = 1024;
/// Moves between two looks at the limits.
constexpr std::uint32_t moves_between_looks = 64;
/// Parts that take more memory for their successors give it back.
constexpr std::size_t most_words_kept = std::size_t{1} << 18U;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

bool Successors::may_go_on() {
  if (++asked_ % moves_between_looks == 0) search_.look_at_limits();
  return !search_.is_cut_;
}

std::uint32_t* Successors::add() {
  if (candidates_.size() - kept_ >= most_unsifted) sift();
  ++transitions_;
  candidates_.push_back({0, parent_});
  const std::size_t width = search_.store_.words();
  words_.resize(candidates_.size() * width);
  return words_.data() + words_.size() - width;
}

/// Keeps the successors that are not known yet.
void Successors::sift() {
  const StateStore& known = search_.store_;
  const std::size_t width = known.words();
  const std::size_t before = kept_;
  for (std::size_t place = kept_; place < candidates_.size(); ++place) {
    candidates_[place].hash = known.hash(words_.data() + place * width);
    known.prefetch(candidates_[place].hash);
  }
  for (std::size_t place = kept_; place < candidates_.size(); ++place) {
    const std::uint32_t* const state = words_.data() + place * width;
    if (known.contains(state, candidates_[place].hash)) continue;
    candidates_[kept_] = candidates_[place];
    std::copy_n(state, width, words_.data() + kept_ * width);
    ++kept_;
  }
  candidates_.resize(kept_);
  words_.resize(kept_ * width);
  search_.candidates_ += kept_ - before;
}

void Successors::clear() {
  candidates_.clear();
  words_.clear();
  if (words_.capacity() > most_words_kept) {
    candidates_.shrink_to_fit();
    words_.shrink_to_fit();
  }
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

/// False if the search ends. Then its successors are not inserted.
bool BreadthFirst::expand_batch(StateStore::Number begin, StateStore::Number end,
                                const std::vector<std::unique_ptr<Expander>>& expanders) {
  const std::size_t parts = (end - begin + part_size - 1) / part_size;
  while (parts_.size() < parts) parts_.emplace_back(*this);
  std::atomic<std::size_t> next{0};
  std::atomic<bool> is_done{false};
  run_in_threads(std::min(expanders.size(), parts), [&](std::size_t job) {
    Expander& expander = *expanders[job];
    while (!is_done && !is_cut_) {
      const std::size_t part = next++;  // is expanded then, as those before it are
      if (part >= parts) break;
      Successors& successors = parts_[part];
      const auto first = begin + static_cast<StateStore::Number>(part) * part_size;
      const StateStore::Number last = std::min(end, first + part_size);
      for (StateStore::Number number = first; number < last && !is_cut_ && !expander.is_done();
           ++number) {
        successors.begin(number);
        expander.expand(store_.state(number), number, successors);
        successors.end();
      }
      if (expander.is_done()) {
        is_done = true;
      } else {
        look_at_limits();
      }
    }
  });
  if (is_done || is_cut_) return false;
  // Once more, so that it does not depend on the threads.
  if (!has_memory()) return false;
  for (std::size_t part = 0; part < parts; ++part) {
    insert(parts_[part]);
    parts_[part].clear();
  }
  candidates_ = 0;
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

/// Of several threads one looks at a time; the others go on with their work.
void BreadthFirst::look_at_limits() {
  if (is_cut_) return;
  const std::unique_lock lock(looking_, std::try_to_lock);
  if (lock && !may_go_on()) is_cut_ = true;
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
  if (!has_memory()) return false;
  if (deadline_ > 0 && seconds_now() >= deadline_) return end_by(ExplorationEnd::time_limit);
  if (!options_.on_progress) return true;
  return options_.on_progress({store_.size(), transitions_, store_.size() - expanded_,
                               static_cast<std::uint32_t>(level_begin_.size() - 1)}) ||
         end_by(ExplorationEnd::stopped);
}

/// Whether the memory suffices for what is there, and as many new states as a batch usually finds.
bool BreadthFirst::has_memory() {
  const std::uint64_t most = options_.limits.max_memory;
  if (most == 0) return true;
  const std::uint64_t room = std::max<std::uint64_t>(candidates_, std::uint64_t{batch_size} * 8);
  // An array that grows takes twice its size.
  const std::uint64_t of_candidate =
      2 * (sizeof(Successors::Candidate) + store_.words() * sizeof(std::uint32_t));
  if (store_.bytes_for(store_.size() + room) + candidates_ * of_candidate <= most) return true;
  end_ = ExplorationEnd::max_memory;
  return false;
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
