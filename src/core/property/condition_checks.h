#pragma once

#include <optional>
#include <vector>

#include "ask/formula.h"
#include "core/diagnostic/diagnostic.h"
#include "core/property/properties.h"
#include "core/script/contradictions.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// Finds what of the conditions of a property file can never hold. Parts that contradict one
/// another are errors; so are the alternatives of an `any` if none of them can hold, and if some
/// can, the others are warnings. What the catalog or the assumptions rule out is a warning, or a
/// note where it is to be ruled out. Of very many alternatives only the first ones are looked at.
class ConditionChecks {
 public:
  /// Both must outlive this object. `assumptions`: null if they have mistakes.
  ConditionChecks(const CompiledCatalog& catalog, const Assumptions* assumptions);

  /// `is_denied`: the condition is never to hold, so it is no mistake if the catalog rules it out.
  void check(const StateCondition& condition, bool is_denied, Reporter& reporter);

 private:
  using Parts = Contradictions::Parts;

  /// Why the condition can never hold with what holds around it; empty if it may, or if that is not
  /// known. `is_doubted`: what holds around it is ruled out already.
  [[nodiscard]] std::vector<Impossible> judge(const StateCondition& condition, Parts parts,
                                              bool is_doubted);
  void judge_alternatives(const StateCondition& condition, const Parts& parts, bool is_doubted,
                          std::vector<Impossible>& found);
  [[nodiscard]] std::vector<Impossible> doubts_about(Parts parts);
  void add_doubtful_priorities(const Parts& parts, std::vector<Impossible>& found) const;
  void report(const Standing& standing, const char* what, const Impossible& finding);

  const CompiledCatalog& catalog_;
  const Assumptions* const assumptions_;
  const Contradictions contradictions_;
  StateAsk any_;                     ///< states, whatever is assumed
  std::optional<StateAsk> assumed_;  ///< those that the assumptions allow
  // Of the present check:
  Ground ground_ = Ground::catalog;
  Reporter* reporter_ = nullptr;
};

}  // namespace cbc
