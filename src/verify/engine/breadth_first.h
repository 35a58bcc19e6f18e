#pragma once

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace cbc {

// The engine that explores states, for everything that does: properties, comparisons of two
// catalogs, proofs about goals, missions that are missing. It can be exchanged behind four answers:
//
// - What is a state? Some 32-bit words, of which only a TransitionSystem knows the meaning.
// - What are its moves? The system makes them; two states are one if their words are the same.
// - Who looks at states and moves? A StateVisitor, which is told each state and each move once.
// - What ended it? BreadthFirst says whether all was seen, and how far it came otherwise.

/// Makes the moves of states.
template <typename System>
concept TransitionSystem = requires(System& system, const System& seen, const std::uint32_t* state,
                                    std::uint32_t* successor) {
  system.load(state);                         // takes up a state, whose words are read at once
  seen.choices();                             // all moves that some state may have, in order
  seen.pack(successor);                       // writes the state after the move
  seen.move_of(*std::begin(seen.choices()));  // what a choice stands for in the loaded state
  { system.try_move(*std::begin(seen.choices())) } -> std::same_as<bool>;  // if it has the move
};

/// The states that an exploration has found, numbered in the order in which they were found, each
/// with the one that it was found from. A state is a fixed number of 32-bit words.
///
/// The index is a hash table of buckets of one cache line: of each of up to 12 states, 8 bits of
/// its hash and its number. A full bucket overflows into the next.
class StateStore {
 public:
  using Number = std::uint32_t;
  static constexpr Number most_states = UINT32_MAX - 1;

  explicit StateStore(std::size_t words);

  [[nodiscard]] Number size() const { return size_; }
  [[nodiscard]] std::size_t words() const { return words_; }
  [[nodiscard]] const std::uint32_t* state(Number number) const {
    return states_[number / segment].get() + (number % segment) * words_;
  }
  /// The first state has itself.
  [[nodiscard]] Number parent(Number number) const {
    return parents_[number / segment][number % segment];
  }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_for(size_); }
  /// Memory that so many states take.
  [[nodiscard]] std::uint64_t bytes_for(std::uint64_t states) const;

  [[nodiscard]] std::uint64_t hash(const std::uint32_t* state) const;
  void prefetch(std::uint64_t hash) const { __builtin_prefetch(&buckets_[hash & bucket_mask_]); }
  [[nodiscard]] bool contains(const std::uint32_t* state, std::uint64_t hash) const;
  /// The number of the state, if it is known.
  [[nodiscard]] std::optional<Number> find(const std::uint32_t* state, std::uint64_t hash) const;
  /// The number of the state, which is added if it is new.
  Number insert(const std::uint32_t* state, std::uint64_t hash, Number parent);

 private:
  static constexpr std::size_t segment = std::size_t{1} << 16U;
  static constexpr std::size_t bucket_size = 12;

  struct alignas(64) Bucket {
    std::uint8_t tags[bucket_size] = {};
    std::uint32_t count = 0;
    Number numbers[bucket_size] = {};
  };
  static_assert(sizeof(Bucket) == 64);

  [[nodiscard]] static std::uint8_t tag_of(std::uint64_t hash) {
    return static_cast<std::uint8_t>(hash >> 56U);
  }
  [[nodiscard]] bool is_same(Number number, const std::uint32_t* other) const {
    return std::equal(other, other + words_, state(number));
  }
  /// The number of the state, or size(); and the bucket that it is in, or belongs into.
  [[nodiscard]] Number find(const std::uint32_t* state, std::uint64_t hash,
                            std::size_t& bucket) const;
  void add_to_bucket(std::size_t place, std::uint64_t hash, Number number);
  /// At most 5 of 6 places are taken, so that few buckets overflow.
  [[nodiscard]] static bool is_crowded(std::uint64_t states, std::size_t buckets) {
    return states > buckets * (bucket_size - 2);
  }
  void grow();

  const std::size_t words_;
  Number size_ = 0;
  std::vector<std::unique_ptr<std::uint32_t[]>> states_;
  std::vector<std::unique_ptr<Number[]>> parents_;
  std::vector<Bucket> buckets_;
  std::size_t bucket_mask_ = 0;
};

/// Where an exploration ends although states are left. 0: no limit.
struct ExplorationLimits {
  std::uint64_t max_states = 0;
  std::uint64_t max_memory = 0;  ///< bytes, of states, successors, tables and remembered decisions
  double seconds = 0;
};

/// What ended an exploration before its end.
enum class ExplorationEnd : std::uint8_t {
  max_states,
  max_memory,
  time_limit,
  too_many,  ///< there are no numbers left for states
  stopped    ///< by who was told the progress
};

struct ExplorationProgress {
  std::uint64_t states = 0;
  std::uint64_t transitions = 0;
  std::uint64_t waiting = 0;  ///< states that are not expanded yet
  std::uint32_t depth = 0;
  std::uint64_t controls = 0;  ///< of states that are kept in sets; 0: they are kept one by one
};

class BreadthFirst;

/// Collects the successors of the states of a part of the frontier.
class Successors {
 public:
  explicit Successors(BreadthFirst& search) : search_(search) {}

  void begin(StateStore::Number parent);
  /// Asked between two moves, as a state may have very many. False: a limit has ended the search,
  /// and none of these successors count.
  [[nodiscard]] bool may_go_on();
  /// Room for the successor of one more move, until the next call.
  [[nodiscard]] std::uint32_t* add();
  /// The number of the successor that was added last. Only in a search in order.
  [[nodiscard]] StateStore::Number number_last();
  /// The successors of the state are complete.
  void end() { sift(); }
  void clear();

  [[nodiscard]] std::uint64_t transitions() const { return transitions_; }

 private:
  friend class BreadthFirst;
  struct Candidate {
    std::uint64_t hash = 0;
    StateStore::Number parent = 0;
  };
  void sift();

  BreadthFirst& search_;
  StateStore::Number parent_ = 0;
  std::uint64_t transitions_ = 0;
  std::uint32_t asked_ = 0;
  std::vector<Candidate> candidates_;
  std::vector<std::uint32_t> words_;
  std::size_t kept_ = 0;  ///< candidates that are known to be new
};

/// Looks at what a search finds. Each thread has its own visitor with its own system; the numbers
/// of its states ascend.
template <typename Visitor>
concept StateVisitor = requires(Visitor& visitor, const Visitor& seen, Successors& successors,
                                StateStore::Number number) {
  requires TransitionSystem<std::remove_reference_t<decltype(visitor.system())>>;
  // The system has loaded the state. If looking takes long, it asks successors.may_go_on().
  visitor.visit(number, successors);
  // Whether it has found what ends the search. All states with lower numbers than its last one are
  // expanded all the same.
  { seen.is_done() } -> std::same_as<bool>;
  // Also, after each move: on_move(number, choice, words of the successor) or, with
  // BreadthFirst::run_in_order, on_move(number, choice, number of the successor).
};

class BreadthFirst {
 public:
  using Number = StateStore::Number;

  /// Called now and then, by one thread at a time; false ends the exploration as a limit does. May
  /// be empty.
  using OnProgress = std::function<bool(const ExplorationProgress&)>;

  /// `first`: the first state; its length is that of all states.
  BreadthFirst(const std::vector<std::uint32_t>& first, const ExplorationLimits& limits,
               OnProgress on_progress);

  /// Expands all states, or ends at a limit, or when a visitor is done. A thread for each visitor.
  template <StateVisitor Visitor>
  void run(std::deque<Visitor>& visitors) {
    run(visitors.size(), [&](std::size_t job, Number number, Successors& successors) {
      return expand<false>(visitors[job], number, successors);
    });
  }
  /// The same for one visitor that is told the numbers of successors. So these are found one by
  /// one, which is slower, and a limit counts what was found of the state that it ended in.
  template <StateVisitor Visitor>
  void run_in_order(Visitor& visitor) {
    is_in_order_ = true;
    run(1, [&](std::size_t /*job*/, Number number, Successors& successors) {
      return expand<true>(visitor, number, successors);
    });
  }

  [[nodiscard]] bool is_complete() const { return expanded_ == store_.size(); }
  /// What ended it; means something only if it is not complete.
  [[nodiscard]] ExplorationEnd end() const { return end_; }
  /// The number of states that were expanded: those with lower numbers.
  [[nodiscard]] Number expanded() const { return expanded_; }
  /// Whether a limit came while states were expanded, so that of expanded() and the states after it
  /// some were seen, and others before them not.
  [[nodiscard]] bool was_cut_short() const { return is_cut_; }
  [[nodiscard]] std::uint64_t transitions() const { return transitions_; }
  [[nodiscard]] const StateStore& store() const { return store_; }
  [[nodiscard]] std::uint32_t depth_of(Number number) const;
  /// The depth up to which all states were expanded.
  [[nodiscard]] std::uint32_t expanded_depth() const;
  /// By depth: the number of states. If a limit ended the search, of the depths whose states are
  /// all known.
  [[nodiscard]] std::vector<std::uint64_t> states_at_depth() const;
  /// The states on the path to this one, which is the last.
  [[nodiscard]] std::vector<Number> path_to(Number number) const;
  /// The moves on that path: of several that lead from one state to the next, the first.
  template <TransitionSystem System>
  [[nodiscard]] auto moves_to(System& system, Number number) const;

 private:
  friend class Successors;
  /// Expands a state; false: the search is done.
  using Expand = std::function<bool(std::size_t job, Number, Successors&)>;

  template <bool in_order, typename Visitor>
  [[nodiscard]] bool expand(Visitor& visitor, Number number, Successors& successors);
  void run(std::size_t jobs, const Expand& expand);
  [[nodiscard]] bool expand_batch(Number begin, Number end, std::size_t jobs, const Expand& expand);
  void insert(const Successors& successors);
  [[nodiscard]] bool may_go_on();
  [[nodiscard]] bool has_memory();
  void look_at_limits();

  const ExplorationLimits limits_;
  const OnProgress on_progress_;
  StateStore store_;
  bool is_in_order_ = false;
  std::vector<Successors> parts_;             ///< of the batch
  std::atomic<std::uint64_t> candidates_{0};  ///< that are kept in them
  std::atomic<bool> is_cut_{false};           ///< by a limit
  std::mutex looking_;                        ///< held by the thread that looks at the limits
  std::vector<Number> level_begin_;
  Number expanded_ = 0;
  std::uint64_t transitions_ = 0;
  double deadline_ = 0;
  ExplorationEnd end_ = ExplorationEnd::stopped;
};

template <bool in_order, typename Visitor>
bool BreadthFirst::expand(Visitor& visitor, Number number, Successors& successors) {
  auto& system = visitor.system();
  system.load(store_.state(number));
  visitor.visit(number, successors);
  for (const auto& choice : system.choices()) {
    if (!successors.may_go_on()) return true;
    if (!system.try_move(choice)) continue;
    std::uint32_t* const words = successors.add();
    system.pack(words);
    if constexpr (in_order) {
      visitor.on_move(number, choice, successors.number_last());
    } else {
      visitor.on_move(number, choice, words);
    }
    if (visitor.is_done()) return false;
  }
  return !visitor.is_done();
}

template <TransitionSystem System>
auto BreadthFirst::moves_to(System& system, Number number) const {
  std::vector<decltype(system.move_of(*std::begin(system.choices())))> moves;
  std::vector<std::uint32_t> words(store_.words());
  const std::vector<Number> path = path_to(number);
  for (std::size_t place = 1; place < path.size(); ++place) {
    system.load(store_.state(path[place - 1]));
    for (const auto& choice : system.choices()) {
      if (!system.try_move(choice)) continue;
      system.pack(words.data());
      if (!std::equal(words.begin(), words.end(), store_.state(path[place]))) continue;
      moves.push_back(system.move_of(choice));
      break;
    }
  }
  return moves;
}

}  // namespace cbc
