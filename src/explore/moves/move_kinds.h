#pragma once

#include "core/property/properties.h"
#include "explore/model/model.h"

namespace cbc {

/// Whether a move counts for a property that names the moves by which something is possible: it is
/// of one of the kinds, and about one of their tasks.
[[nodiscard]] bool is_of_kinds(const MoveKinds& kinds, const Model::Choice& choice,
                               const Model& model);

}  // namespace cbc
