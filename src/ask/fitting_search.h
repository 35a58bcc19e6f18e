#pragma once

#include <cstdint>
#include <vector>

#include "ask/group_search.h"
#include "ask/situation_space.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// Searches for assignments of some groups that satisfy all constraints, with behaviors that fit in
/// one situation.
class FittingSearch {
 public:
  using Answer = GroupSearch::Answer;

  /// The catalog must outlive this object.
  FittingSearch(const CompiledCatalog& catalog, std::vector<GroupId> groups);

  /// Looks for assignments that do what is demanded, in one of the situations that has values of
  /// the sets.
  [[nodiscard]] Answer find(const SituationSpace& situations, const GroupDemand& demand,
                            const ValueSets& sets, const GroupSearch::KeepOn& keep_on);

  // What was found:
  [[nodiscard]] const BehaviorSet& active() const { return active_; }
  [[nodiscard]] const VariableValues& situation() const { return situation_; }

 private:
  /// The condition of a behavior on a variable.
  struct Split {
    BehaviorId behavior;
    std::uint32_t variable = 0;
  };

  [[nodiscard]] GroupDemand with_fitting(const SituationSpace& situations, GroupDemand demand,
                                         const ValueSets& sets) const;
  [[nodiscard]] Split choose_split(const SituationSpace& situations, const ValueSets& sets,
                                   const ValueSets& fitting) const;

  const CompiledCatalog& catalog_;
  const std::vector<GroupId> groups_;
  std::vector<GroupSearch> searches_;  ///< by group
  /// By variable: how often there was no assignment on either side of its condition.
  std::vector<std::uint64_t> refuted_;
  BehaviorSet active_;
  VariableValues situation_;
};

}  // namespace cbc
