#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "verify/explore.h"
#include "verify/state_store.h"

namespace cbc {

// Breadth-first search over packed states, on all cores, with the same numbers of the states for
// any number of threads: states are numbered as one thread would find them that expands them in
// order and makes the moves in order. So among the shortest paths to a state, the one by parents is
// the first in the order of moves, and the lowest number that has a property has the first of the
// shortest paths to any.

/// Collects the successors of the states of a part of the frontier.
class Successors {
 public:
  explicit Successors(const StateStore& known) : known_(known) {}

  void begin(StateStore::Number parent) { parent_ = parent; }
  /// Room for the successor of one more move.
  [[nodiscard]] std::uint32_t* add();
  /// The successors of the state are complete: keeps those that are not known yet.
  void end();
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
  const StateStore& known_;
  StateStore::Number parent_ = 0;
  std::uint64_t transitions_ = 0;
  std::vector<Candidate> candidates_;
  std::vector<std::uint32_t> words_;
  std::size_t kept_ = 0;  ///< candidates before those of the present state
};

/// Finds the successors of states. Each thread has its own.
class Expander {
 public:
  virtual ~Expander() = default;
  /// `number` is that of the state; they ascend from call to call.
  virtual void expand(const std::uint32_t* state, StateStore::Number number,
                      Successors& successors) = 0;
};

class BreadthFirst {
 public:
  /// `first`: the first state; its length is that of all states.
  BreadthFirst(const std::vector<std::uint32_t>& first, const ExplorationOptions& options);

  /// Expands all states, or ends at a limit. There are as many expanders as jobs in the options.
  /// `other_bytes`: what the limit on memory counts beside the states.
  void run(const std::vector<std::unique_ptr<Expander>>& expanders);

  [[nodiscard]] bool is_complete() const { return expanded_ == store_.size(); }
  /// What ended it; means something only if it is not complete.
  [[nodiscard]] ExplorationEnd end() const { return end_; }
  /// The number of states that were expanded: those with lower numbers.
  [[nodiscard]] StateStore::Number expanded() const { return expanded_; }
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
  [[nodiscard]] bool expand_batch(StateStore::Number begin, StateStore::Number end,
                                  const std::vector<std::unique_ptr<Expander>>& expanders);
  void insert(const Successors& successors);
  [[nodiscard]] bool may_go_on();

  const ExplorationOptions& options_;
  StateStore store_;
  std::vector<Successors> parts_;  ///< of the batch
  std::vector<StateStore::Number> level_begin_;
  StateStore::Number expanded_ = 0;
  std::uint64_t transitions_ = 0;
  double deadline_ = 0;
  ExplorationEnd end_ = ExplorationEnd::stopped;
};

}  // namespace cbc
