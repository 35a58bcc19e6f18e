#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "verify/engine/explore.h"
#include "verify/engine/state_store.h"

namespace cbc {

// Breadth-first search over packed states, on all cores, with the same numbers of the states for
// any number of threads: states are numbered as one thread would find them that expands them in
// order and makes the moves in order. So among the shortest paths to a state, the one by parents is
// the first in the order of moves, and the lowest number that has a property has the first of the
// shortest paths to any.

class BreadthFirst;

/// Collects the successors of the states of a part of the frontier.
class Successors {
 public:
  explicit Successors(BreadthFirst& search) : search_(search) {}

  void begin(StateStore::Number parent) { parent_ = parent; }
  /// Asked between two moves, as a state may have very many. False: a limit has ended the search,
  /// and none of these successors count.
  [[nodiscard]] bool may_go_on();
  /// Room for the successor of one more move, until the next call.
  [[nodiscard]] std::uint32_t* add();
  /// The successors of the state are complete.
  void end() { sift(); }
  void clear();

  /// A move of the state that begin named leads back to itself.
  void add_loop() { ++transitions_; }
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

/// Finds the successors of states. Each thread has its own.
class Expander {
 public:
  virtual ~Expander() = default;
  /// `number` is that of the state; they ascend from call to call.
  virtual void expand(const std::uint32_t* state, StateStore::Number number,
                      Successors& successors) = 0;
  /// Whether it has found what ends the search. All states with lower numbers than its last one
  /// are expanded all the same.
  [[nodiscard]] virtual bool is_done() const { return false; }
};

class BreadthFirst {
 public:
  /// `first`: the first state; its length is that of all states.
  BreadthFirst(const std::vector<std::uint32_t>& first, const ExplorationOptions& options);

  /// Expands all states, or ends at a limit, or when an expander is done. There are as many
  /// expanders as jobs in the options.
  void run(const std::vector<std::unique_ptr<Expander>>& expanders);

  [[nodiscard]] bool is_complete() const { return expanded_ == store_.size(); }
  /// What ended it; means something only if it is not complete.
  [[nodiscard]] ExplorationEnd end() const { return end_; }
  /// The number of states that were expanded: those with lower numbers.
  [[nodiscard]] StateStore::Number expanded() const { return expanded_; }
  /// Whether a limit came while states were expanded, so that of expanded() and the states after it
  /// some were seen, and others before them not.
  [[nodiscard]] bool was_cut_short() const { return is_cut_; }
  [[nodiscard]] std::uint64_t transitions() const { return transitions_; }
  [[nodiscard]] const StateStore& store() const { return store_; }
  [[nodiscard]] std::uint32_t depth_of(StateStore::Number number) const;
  /// The depth up to which all states were expanded.
  [[nodiscard]] std::uint32_t expanded_depth() const;
  /// By depth: the number of states. If a limit ended the search, of the depths whose states are
  /// all known.
  [[nodiscard]] std::vector<std::uint64_t> states_at_depth() const;
  /// The states on the path to this one, which is the last.
  [[nodiscard]] std::vector<StateStore::Number> path_to(StateStore::Number number) const;

 private:
  friend class Successors;
  [[nodiscard]] bool expand_batch(StateStore::Number begin, StateStore::Number end,
                                  const std::vector<std::unique_ptr<Expander>>& expanders);
  void insert(const Successors& successors);
  [[nodiscard]] bool may_go_on();
  [[nodiscard]] bool has_memory();
  void look_at_limits();

  const ExplorationOptions& options_;
  StateStore store_;
  std::vector<Successors> parts_;             ///< of the batch
  std::atomic<std::uint64_t> candidates_{0};  ///< that are kept in them
  std::atomic<bool> is_cut_{false};           ///< by a limit
  std::mutex looking_;                        ///< held by the thread that looks at the limits
  std::vector<StateStore::Number> level_begin_;
  StateStore::Number expanded_ = 0;
  std::uint64_t transitions_ = 0;
  double deadline_ = 0;
  ExplorationEnd end_ = ExplorationEnd::stopped;
};

}  // namespace cbc
