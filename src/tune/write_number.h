#pragma once

#include "core/check/check.h"
#include "tune/engine/numbers.h"
#include "tune/engine/recording.h"

namespace cbc::cli {

/// Writes another value of a number into the file of the catalog, and changes nothing else there.
/// All expectations of the missions have to hold with the new text. Returns the exit status, after
/// a message if it is not exit_ok; then the file is as it was.
[[nodiscard]] int write_number(const CheckedCatalog& source, const TunableNumber& number,
                               Millionths value, const Missions& missions);

}  // namespace cbc::cli
