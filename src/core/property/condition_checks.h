#pragma once

#include <cstdint>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "core/property/properties.h"
#include "core/property/property_reader.h"
#include "core/script/expectation.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

// What a condition of a property file says, with the places that say it, and what of it cannot hold
// together.

/// Parts of conditions that hold together.
struct ConditionClaims {
  struct Requested {
    StateClaims::Task task;
    std::int32_t priority = 0;
  };
  struct Situated {
    StateCondition::Situated part;
    Range range;  ///< of the name of the variable
  };
  struct Own {
    SituationPart::Own part;
    Range range;  ///< of the name of the behavior
  };
  StateClaims values;  ///< of tasks
  std::vector<StateClaims::Behavior> faulty;
  std::vector<Range> none_faulty;  ///< of what says that no behavior is faulty
  std::vector<StateClaims::Behavior> available;
  std::vector<Requested> requested;
  std::vector<Situated> variables;
  std::vector<Own> own;
};

/// A condition as it is written. `negated` and what stands in it may be impossible.
struct WrittenCondition {
  ConditionClaims claims;
  std::vector<WrittenCondition> negated;
  std::vector<WrittenCondition> any;
  std::vector<WrittenCondition> all;
};

/// Reports what can never hold. Parts that contradict one another are errors; so are the
/// alternatives of an `any` if none of them can hold, and if some can, the others are warnings.
/// What the catalog or the assumptions rule out is a warning, or a note where it is to be ruled
/// out. Of very many alternatives only the first ones are looked at.
void check_condition(const WrittenCondition& condition, const ConditionChecks& checks,
                     const CompiledCatalog& catalog, Reporter& reporter);

}  // namespace cbc
