#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/solver/literal.h"

namespace cbc {

/// What has been decided and inferred, for an analysis of conflicts.
class Inferences {
 public:
  virtual ~Inferences() = default;

  /// What holds, in the order of inference.
  [[nodiscard]] virtual std::span<const Literal> literals() const = 0;
  /// By variable that has a value: the number of decisions before it.
  [[nodiscard]] virtual std::span<const std::uint32_t> levels() const = 0;
  /// Whether a literal that holds is a decision or a fact.
  [[nodiscard]] virtual bool is_given(Literal literal) const = 0;
  /// Appends what a literal that holds, and is not given, follows from.
  virtual void append_reason(Literal literal, std::vector<Literal>& reason) const = 0;
};

/// Derives a no-good from a conflict: resolves the conflict with the reasons of its literals, last
/// inference first, until one literal of the conflict level is left (the first unique implication
/// point), and drops literals that follow from the others.
class ConflictAnalysis {
 public:
  /// For problems of up to this number of variables.
  void resize(std::size_t variables);

  /// The highest level of the literals of a conflict.
  [[nodiscard]] static std::uint32_t level_of(std::span<const Literal> conflict,
                                              const Inferences& inferences);

  /// `conflict`: literals that hold and cannot all hold. One of them at least is of the highest
  /// level that there is, which is above 0.
  void analyze(std::span<const Literal> conflict, const Inferences& inferences);

  /// The no-good as a clause: first the literal that it implies after going back to back_level(),
  /// then one of that level, if there is any other.
  [[nodiscard]] std::span<const Literal> learned() const { return learned_; }
  [[nodiscard]] std::uint32_t back_level() const { return back_level_; }
  /// The number of levels of the literals of the no-good.
  [[nodiscard]] std::uint32_t level_count() const { return level_count_; }

  // The derivation.

  /// Variables above level 0 that the analysis met.
  [[nodiscard]] std::span<const std::uint32_t> variables() const { return variables_; }
  /// The literals whose reasons it resolved with.
  [[nodiscard]] std::span<const Literal> resolved() const { return resolved_; }
  /// The literals of level 0 that it rests on; some may be there several times.
  [[nodiscard]] std::span<const Literal> facts() const { return facts_; }

 private:
  void trace(std::span<const Literal> conflict, const Inferences& inferences);
  void note(Literal literal, std::span<const std::uint32_t> levels);
  void drop_implied_literals(const Inferences& inferences);
  void count_levels(std::span<const std::uint32_t> levels);

  std::uint32_t conflict_level_ = 0;
  std::uint32_t open_ = 0;  ///< noted literals of the conflict level, not yet resolved
  std::uint32_t back_level_ = 0;
  std::uint32_t level_count_ = 0;
  std::vector<Literal> learned_;
  std::vector<Literal> resolved_;
  std::vector<Literal> facts_;
  std::vector<std::uint32_t> variables_;
  std::vector<std::uint8_t> is_noted_;  ///< by variable
  std::vector<Literal> reason_;
  std::vector<std::uint64_t> counted_;  ///< by level
  std::uint64_t count_number_ = 0;
};

}  // namespace cbc
