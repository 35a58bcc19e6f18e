#pragma once

#include <cstdint>
#include <vector>

#include "explore/model/model.h"
#include "explore/moves/stepper.h"
#include "explore/sets/diagrams.h"

namespace cbc {

/// Where the parts of an environment stand in a string of bits. The faults, of which there are few
/// at a time, are the last ones.
struct EnvironmentBits {
  struct Variable {
    std::uint32_t first = none;  ///< bit; none: the variable does not change
    std::uint32_t width = 0;
    std::vector<std::uint32_t> codes;  ///< by value; none: the variable never gets it
    std::uint32_t code_at_first = 0;   ///< may be one that no value has
  };
  std::vector<Variable> variables;  ///< as the model counts, and so the own flags and the faults
  std::vector<std::uint32_t> own;   ///< bits, set where the behavior is denied; none: never changes
  std::vector<std::uint32_t> failed;  ///< bits, set where the behavior is in X; none: it never is
  std::vector<std::uint32_t> fault;   ///< bits; none: never faulty
  std::uint32_t mark = none;          ///< a bit that the model does not know
  std::uint32_t count = 0;            ///< of all bits
};

/// `has_mark`: environments have a mark, besides what the model has.
[[nodiscard]] EnvironmentBits bits_of(const Model& model, bool has_mark);

/// Sets of environments of a model: of values of its variables, answers of check_situation, X and
/// faults, as decision diagrams. Moves ask about the environment that they lead to, so each
/// question becomes the set of environments before the move in which the answer is yes. The model
/// and the diagrams must outlive it. Not for use by several threads.
class Environments {
 public:
  using Set = Diagrams::Set;

  Environments(const Model& model, EnvironmentBits bits, Diagrams& sets);

  [[nodiscard]] Diagrams& sets() { return sets_; }
  [[nodiscard]] const EnvironmentBits& bits() const { return bits_; }

  /// Writes that of the first state, all but the mark.
  void write_first(std::vector<std::uint8_t>& string) const;

  // Conditions, as sets of all environments that satisfy them.

  [[nodiscard]] Set fitting(std::uint32_t behavior) const { return fitting_[behavior]; }
  [[nodiscard]] Set available(std::uint32_t behavior) const { return available_[behavior]; }
  /// Available, but for X.
  [[nodiscard]] Set permitted(std::uint32_t behavior) const { return permitted_[behavior]; }
  [[nodiscard]] Set faulty(std::uint32_t behavior) const;
  /// In X.
  [[nodiscard]] Set failed(std::uint32_t behavior);
  [[nodiscard]] Set denied(std::uint32_t behavior);
  [[nodiscard]] Set with_own_flag(std::uint32_t own);
  [[nodiscard]] Set with_value(std::uint32_t variable, std::uint32_t value);

  /// What a move does to environments.
  struct ActionEffect {
    Move move;                       ///< as it is in these environments
    Set condition = Diagrams::all;   ///< in which ones the move exists,
    Set excluded = Diagrams::empty;  ///< unless it leads to where `never` excludes
    bool changes = false;            ///< false: the environment stays as it is
    Diagrams::ValuesNumber values = 0;
    std::uint32_t table = 0;  ///< the same for all without a change
  };
  /// The effects of a move that is no fault. That own(b) becomes true is one, that it
  /// becomes false another. The sets are not kept.
  [[nodiscard]] std::vector<ActionEffect> effects_of(const Model::Choice& choice);
  /// The environments before a move with this effect in which the answer is yes after it; see
  /// EnvironmentOracle.
  [[nodiscard]] Set query(const ActionEffect& effect, EnvironmentQuery query);
  [[nodiscard]] const Stepper::Possible& possible_after(const ActionEffect& effect);

  /// What must survive Diagrams::collect().
  template <typename Keep>
  void for_each_kept(Keep&& keep) const {
    for (const auto* list : {&fitting_, &permitted_, &available_, &faulty_}) {
      for (const Set set : *list) keep(set);
    }
    keep(never_);
    keep(room_in_x_);
    for (const Table& table : tables_) {
      for (const Set set : table.gains) keep(set);
    }
  }

 private:
  /// What is asked about moves with the same effect, found when it is first asked.
  struct Table {
    bool is_known = false;
    std::vector<Set> gains;  ///< by group
    Stepper::Possible possible;
  };

  [[nodiscard]] Set with_code(std::uint32_t variable, std::uint32_t code);
  void find_conditions();
  void find_never();
  void find_room_in_x();
  [[nodiscard]] ActionEffect change(const Move& move, Set condition, Diagrams::Values values);
  [[nodiscard]] ActionEffect joint_change(const Move& move, const Model::JointChange& change);
  [[nodiscard]] Table& table_of(const ActionEffect& effect);
  [[nodiscard]] Set after_to_before(const ActionEffect& effect, Set set);

  const Model& model_;
  const EnvironmentBits bits_;
  Diagrams& sets_;
  std::vector<Set> fitting_;
  std::vector<Set> permitted_;
  std::vector<Set> available_;
  std::vector<Set> faulty_;        ///< by number of the fault
  Set room_in_x_ = Diagrams::all;  ///< where a finish may put one more behavior into X
  Set never_ = Diagrams::empty;
  std::vector<Table> tables_;
};

}  // namespace cbc
