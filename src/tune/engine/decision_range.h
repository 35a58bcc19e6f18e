#pragma once

#include "core/catalog/catalog.h"
#include "tune/engine/numbers.h"
#include "tune/engine/recording.h"

namespace cbc {

/// How far a number may go from `value`, upwards or downwards, so that all decisions stay as they
/// were recorded. `catalog`: the source of what was recorded, where the number has this value.
[[nodiscard]] Millionths last_unchanged(const Catalog& catalog, const TunableNumber& number,
                                        Millionths value, const Recording& recording, bool upwards);

}  // namespace cbc
