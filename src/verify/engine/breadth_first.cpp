// Breadth-first search by several threads, with the same result for any number of them. Threads
// expand a batch of the frontier in parts, and each drops the successors that are known already,
// which are most of them. Then one thread inserts what is left, in the order of states and moves.
// So states have the same numbers in every run, and so has the path by which each was found.
//
// Threads that insert into one table themselves (A. Laarman, J. van de Pol and M. Weber, "Boosting
// multi-core reachability performance with shared hash tables", FMCAD 2010) hardly wait for one
// another, but number the states by chance, and with them the counterexamples that people read. To
// keep a few bits of each state only (G. J. Holzmann, "An analysis of bitstate hashing", Formal
// Methods in System Design 13 (1998)) would take less memory, but takes some states for others, and
// so proves nothing.

#include "verify/engine/breadth_first.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/support/system.h"

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

StateStore::StateStore(std::size_t words)
    : words_(words), buckets_(64), bucket_mask_(buckets_.size() - 1) {}

std::uint64_t StateStore::bytes_for(std::uint64_t states) const {
  std::size_t buckets = buckets_.size();
  while (is_crowded(states, buckets)) buckets *= 2;
  const std::uint64_t segments = (states + segment - 1) / segment;
  return segments * segment * (words_ + 1) * sizeof(std::uint32_t) + buckets * sizeof(Bucket);
}

std::uint64_t StateStore::hash(const std::uint32_t* state) const {
  constexpr std::uint64_t factor = 0x9e3779b97f4a7c15U;
  std::uint64_t hash = 0;
  for (std::size_t word = 0; word < words_; ++word) {
    hash = (hash ^ state[word]) * factor;
    hash ^= hash >> 32U;
  }
  return hash * factor ^ hash >> 29U;
}

StateStore::Number StateStore::find(const std::uint32_t* state, std::uint64_t hash,
                                    std::size_t& bucket) const {
  const std::uint8_t tag = tag_of(hash);
  for (bucket = hash & bucket_mask_;; bucket = (bucket + 1) & bucket_mask_) {
    const Bucket& here = buckets_[bucket];
    for (std::uint32_t entry = 0; entry < here.count; ++entry) {
      if (here.tags[entry] == tag && is_same(here.numbers[entry], state))
        return here.numbers[entry];
    }
    if (here.count < bucket_size) return size_;
  }
}

bool StateStore::contains(const std::uint32_t* state, std::uint64_t hash) const {
  std::size_t bucket = 0;
  return find(state, hash, bucket) != size_;
}

std::optional<StateStore::Number> StateStore::find(const std::uint32_t* state,
                                                   std::uint64_t hash) const {
  std::size_t bucket = 0;
  const Number number = find(state, hash, bucket);
  return number == size_ ? std::nullopt : std::optional(number);
}

StateStore::Number StateStore::insert(const std::uint32_t* state, std::uint64_t hash,
                                      Number parent) {
  std::size_t bucket = 0;
  const Number number = find(state, hash, bucket);
  if (number != size_) return number;
  const std::size_t offset = size_ % segment;
  if (offset == 0) {
    states_.push_back(std::make_unique_for_overwrite<std::uint32_t[]>(segment * words_));
    parents_.push_back(std::make_unique_for_overwrite<Number[]>(segment));
  }
  std::copy_n(state, words_, states_.back().get() + offset * words_);
  parents_.back()[offset] = parent;
  add_to_bucket(bucket, hash, size_++);
  if (is_crowded(size_, buckets_.size())) grow();
  return number;
}

void StateStore::add_to_bucket(std::size_t place, std::uint64_t hash, Number number) {
  Bucket& bucket = buckets_[place];
  bucket.tags[bucket.count] = tag_of(hash);
  bucket.numbers[bucket.count] = number;
  ++bucket.count;
}

void StateStore::grow() {
  const std::size_t count = buckets_.size() * 2;
  buckets_ = {};
  buckets_.resize(count);
  bucket_mask_ = count - 1;
  constexpr Number ahead = 16;
  std::uint64_t hashes[ahead] = {};
  for (Number number = 0; number < size_ + ahead; ++number) {
    // A few states ahead, so that memory has time to answer.
    const Number ready = number - ahead;
    if (number >= ahead && ready < size_) {
      std::size_t place = hashes[ready % ahead] & bucket_mask_;
      while (buckets_[place].count == bucket_size) place = (place + 1) & bucket_mask_;
      add_to_bucket(place, hashes[ready % ahead], ready);
    }
    if (number >= size_) continue;
    hashes[number % ahead] = hash(state(number));
    prefetch(hashes[number % ahead]);
  }
}

void Successors::begin(StateStore::Number parent) {
  parent_ = parent;
  // States whose successors count one by one are ended by a limit where it comes.
  if (search_.is_in_order_) asked_ = moves_between_looks - 1;
}

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

StateStore::Number Successors::number_last() {
  const std::uint32_t* const state = words_.data() + words_.size() - search_.store_.words();
  const StateStore::Number number =
      search_.store_.insert(state, search_.store_.hash(state), parent_);
  candidates_.pop_back();
  words_.resize(words_.size() - search_.store_.words());
  // Counts even if a limit comes before the other moves of the state.
  --transitions_;
  ++search_.transitions_;
  return number;
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

BreadthFirst::BreadthFirst(const std::vector<std::uint32_t>& first, const ExplorationLimits& limits,
                           OnProgress on_progress)
    : limits_(limits), on_progress_(std::move(on_progress)), store_(first.size()), level_begin_{0} {
  store_.insert(first.data(), store_.hash(first.data()), 0);
}

void BreadthFirst::run(std::size_t jobs, const Expand& expand) {
  if (limits_.seconds > 0) deadline_ = seconds_now() + limits_.seconds;
  while (expanded_ < store_.size()) {
    if (!may_go_on()) return;
    const Number level_end = store_.size();
    level_begin_.push_back(level_end);
    while (expanded_ < level_end) {
      const Number end = std::min(level_end, expanded_ + batch_size);
      if (!expand_batch(expanded_, end, jobs, expand)) return;
      expanded_ = end;
      if (expanded_ < level_end && !may_go_on()) return;
    }
  }
  level_begin_.pop_back();
}

/// False if the search ends. Then its successors are not inserted.
bool BreadthFirst::expand_batch(Number begin, Number end, std::size_t jobs, const Expand& expand) {
  const std::size_t parts = (end - begin + part_size - 1) / part_size;
  while (parts_.size() < parts) parts_.emplace_back(*this);
  std::atomic<std::size_t> next{0};
  std::atomic<bool> is_done{false};
  run_in_threads(std::min(jobs, parts), [&](std::size_t job) {
    while (!is_done && !is_cut_) {
      const std::size_t part = next++;  // is expanded then, as those before it are
      if (part >= parts) break;
      Successors& successors = parts_[part];
      const Number first = begin + static_cast<Number>(part) * part_size;
      const Number last = std::min(end, first + part_size);
      bool goes_on = true;
      for (Number number = first; number < last && !is_cut_ && goes_on; ++number) {
        successors.begin(number);
        goes_on = expand(job, number, successors);
        successors.end();
      }
      if (!goes_on) {
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
  const auto end_by = [this](ExplorationEnd end) {
    end_ = end;
    return false;
  };
  if (limits_.max_states > 0 && store_.size() >= limits_.max_states) {
    return end_by(ExplorationEnd::max_states);
  }
  if (store_.size() >= StateStore::most_states - batch_size * 64) {
    return end_by(ExplorationEnd::too_many);
  }
  if (!has_memory()) return false;
  if (deadline_ > 0 && seconds_now() >= deadline_) return end_by(ExplorationEnd::time_limit);
  if (!on_progress_) return true;
  return on_progress_({store_.size(), transitions_, store_.size() - expanded_,
                       static_cast<std::uint32_t>(level_begin_.size() - 1)}) ||
         end_by(ExplorationEnd::stopped);
}

/// Whether the memory suffices for what is there, and as many new states as a batch usually finds.
bool BreadthFirst::has_memory() {
  const std::uint64_t most = limits_.max_memory;
  if (most == 0) return true;
  const std::uint64_t room =
      is_in_order_ ? 1 : std::max<std::uint64_t>(candidates_, std::uint64_t{batch_size} * 8);
  // An array that grows takes twice its size.
  const std::uint64_t of_candidate =
      2 * (sizeof(Successors::Candidate) + store_.words() * sizeof(std::uint32_t));
  if (store_.bytes_for(store_.size() + room) + candidates_ * of_candidate <= most) return true;
  end_ = ExplorationEnd::max_memory;
  return false;
}

std::uint32_t BreadthFirst::depth_of(Number number) const {
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
    const Number end = is_last ? store_.size() : level_begin_[depth + 1];
    if (is_last && !is_complete() && expanded_ < level_begin_[depth]) break;
    counts.push_back(end - level_begin_[depth]);
  }
  return counts;
}

std::vector<BreadthFirst::Number> BreadthFirst::path_to(Number number) const {
  std::vector<Number> path{number};
  while (path.back() != 0) path.push_back(store_.parent(path.back()));
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace cbc
