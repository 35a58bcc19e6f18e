#pragma once

#include <cstdint>
#include <vector>

#include "explore/sets/diagrams.h"

namespace cbc {

/// What faults and repairs do to sets of environments. There may be as many as there are behaviors,
/// but they do little to a control, so all faults of a set are one operation, and so are all
/// repairs of a kind: those that do the same to a control. Faults are the last bits of a string.
/// The diagrams must outlive it. Not for use by several threads.
class FaultSets {
 public:
  using Set = Diagrams::Set;

  /// `kinds`: by fault. `most`: how many there are at a time. `has_repairs`: false: repairs are
  /// something else, and there are no kinds of them here.
  FaultSets(Diagrams& sets, const std::vector<std::uint32_t>& kinds, std::uint32_t most,
            bool has_repairs = true);

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(kinds_.size()); }
  [[nodiscard]] std::uint32_t most() const { return most_; }
  [[nodiscard]] std::uint32_t bit_of(std::uint32_t fault) const { return first_bit_ + fault; }
  [[nodiscard]] std::uint32_t kind_of(std::uint32_t fault) const { return kinds_[fault]; }
  [[nodiscard]] bool has_repairs() const { return has_repairs_; }
  [[nodiscard]] std::uint32_t kind_count() const {
    return static_cast<std::uint32_t>(faults_of_kind_.size());
  }

  /// The environments that come of a fault, where one more may come.
  [[nodiscard]] Set after_fault(Set set);
  /// The environments that come of a repair of a kind.
  [[nodiscard]] Set after_repair(std::uint32_t kind, Set set);
  [[nodiscard]] Set before_fault(Set set);
  [[nodiscard]] Set before_repair(std::uint32_t kind, Set set);
  /// How many moves there are of faults and repairs, summed over environments.
  [[nodiscard]] std::uint64_t count_moves(Set set);

  /// What must survive Diagrams::collect().
  template <typename Keep>
  void for_each_kept(Keep&& keep) const {
    for (const Set set : exactly_) keep(set);
    keep(room_);
  }

 private:
  Diagrams& sets_;
  const std::vector<std::uint32_t> kinds_;
  const std::uint32_t most_;
  const bool has_repairs_;
  const std::uint32_t first_bit_;
  std::vector<Set> exactly_;    ///< by number of faults, up to the most: the environments with it
  Set room_ = Diagrams::empty;  ///< those in which one more may come
  Diagrams::ValuesNumber all_faults_ = 0;
  std::vector<Diagrams::ValuesNumber> faults_of_kind_;
};

}  // namespace cbc
