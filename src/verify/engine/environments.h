#pragma once

#include <cstdint>
#include <vector>

#include "core/property/properties.h"
#include "verify/engine/diagrams.h"
#include "verify/engine/model.h"
#include "verify/engine/stepper.h"

namespace cbc {

/// Sets of environments of a model: of values of its variables, answers of check_situation and
/// faults, as decision diagrams; and what moves make of them. The model must outlive it. Not for
/// use by several threads.
class Environments {
 public:
  using Set = Diagrams::Set;

  /// `has_mark`: environments have a mark, besides what the model has.
  explicit Environments(const Model& model, bool has_mark = false);

  [[nodiscard]] Diagrams& sets() { return sets_; }
  [[nodiscard]] const Diagrams& sets() const { return sets_; }

  /// The environment of a state alone.
  [[nodiscard]] Set environment_of(const std::uint16_t* cells);
  /// The environment of a state as a string of bits.
  void read(const std::uint16_t* cells, std::vector<std::uint8_t>& string) const;

  // Conditions, as sets of all environments that satisfy them.

  [[nodiscard]] Set available(std::uint32_t behavior) const { return available_[behavior]; }
  [[nodiscard]] Set faulty(std::uint32_t behavior) const;
  [[nodiscard]] Set denied(std::uint32_t behavior);
  [[nodiscard]] Set with_value(std::uint32_t variable, std::uint32_t value);

  /// Those with the mark.
  [[nodiscard]] Set marked() const { return marked_; }
  /// Sets the mark in one part of a set, and clears it in another.
  [[nodiscard]] Set with_mark(Set set, Set to_set, Set to_clear);
  /// What with_mark() makes a part of `set`.
  [[nodiscard]] Set before_mark(Set set, Set to_set, Set to_clear);
  void write_mark(bool mark, std::vector<std::uint8_t>& string) const {
    string[mark_bit_] = mark ? 1 : 0;
  }

  /// What a move does to environments.
  struct Effect {
    std::uint32_t choice = 0;       ///< place in Model::moves()
    Set condition = Diagrams::all;  ///< in which environments the move exists
    bool changes = false;           ///< false: the environment stays as it is
    Diagrams::ValuesNumber values = 0;
    std::uint32_t table = 0;  ///< the same for all without a change
  };
  /// The moves but for faults and repairs, in order. Whether own(b) becomes true or false are two.
  [[nodiscard]] const std::vector<Effect>& effects() const { return effects_; }
  /// The environments before a move with this effect in which the answer is yes after it; see
  /// EnvironmentOracle.
  [[nodiscard]] Set query(const Effect& effect, EnvironmentQuery query);
  [[nodiscard]] const Stepper::Possible& possible_after(const Effect& effect);
  /// The environments that come of some in which the move exists.
  [[nodiscard]] Set after(const Effect& effect, Set set);
  /// Those that become one of the set, if the move exists in them.
  [[nodiscard]] Set before(const Effect& effect, Set set);

  /// The environments that come of a fault, where one more behavior may become faulty.
  [[nodiscard]] Set after_fault(Set set);
  /// Those that come of the repair of a behavior of a group.
  [[nodiscard]] Set after_repair(std::uint32_t group, Set set);
  [[nodiscard]] Set before_fault(Set set);
  [[nodiscard]] Set before_repair(std::uint32_t group, Set set);
  /// How many moves there are of faults and of repairs, summed over environments.
  [[nodiscard]] std::uint64_t count_faults(Set set);
  [[nodiscard]] std::uint64_t count_repairs(Set set);

  /// What must survive Diagrams::collect().
  template <typename Keep>
  void for_each_kept(Keep&& keep) const {
    for (const auto* list : {&fitting_, &available_, &faulty_, &exactly_}) {
      for (const Set set : *list) keep(set);
    }
    keep(never_);
    keep(marked_);
    keep(room_);
    for (const Effect& effect : effects_) keep(effect.condition);
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

  [[nodiscard]] Diagrams::Values values_of(std::uint32_t variable, std::uint32_t value) const;
  void find_conditions();
  void find_never();
  void count_faults_in_all();
  void add_effects();
  void add_effect(std::uint32_t choice, Set condition, const Diagrams::Values& values);
  void add_joint_effect(std::uint32_t choice, const Model::JointChange& change);
  [[nodiscard]] Table& table_of(const Effect& effect);
  [[nodiscard]] Set after_to_before(const Effect& effect, Set set);

  const Model& model_;
  std::vector<std::uint32_t> first_bit_;  ///< by variable; none: it does not change
  std::uint32_t first_own_ = 0;
  std::uint32_t mark_bit_ = 0;
  std::uint32_t first_fault_ = 0;
  Diagrams sets_;
  std::vector<Set> fitting_;
  std::vector<Set> available_;
  std::vector<Set> faulty_;  ///< by number of the fault
  Set never_ = Diagrams::empty;
  Set marked_ = Diagrams::empty;
  Diagrams::ValuesNumber mark_set_ = 0;
  Diagrams::ValuesNumber mark_cleared_ = 0;
  std::vector<Set> exactly_;    ///< by number of faults, up to the most: the environments with it
  Set room_ = Diagrams::empty;  ///< those in which one more behavior may become faulty
  Diagrams::ValuesNumber all_faults_ = 0;
  std::vector<Diagrams::ValuesNumber> faults_of_group_;
  std::vector<Effect> effects_;
  std::vector<Table> tables_;
};

}  // namespace cbc
