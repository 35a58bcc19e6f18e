#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/catalog/reader.h"
#include "tune/engine/numbers.h"
#include "tune/engine/recording.h"

namespace cbc {

/// Values of a number, both ends included.
struct Interval {
  Millionths low = 0;
  Millionths high = 0;

  /// The value that is nearest to `value`, and at least `margin` away from ends beyond which others
  /// lie; the middle where there is no room for that.
  [[nodiscard]] Millionths nearest(Millionths value, Millionths margin) const;
};

/// The values of a number with which all events are as they are now, and what comes beyond them.
struct Tolerance {
  Interval values;
  std::optional<RunDifference> below;  ///< empty: the lower end is 0
  std::optional<RunDifference> above;  ///< empty: the upper end is 100 %

  /// How far the number may be wrong; empty: it changes nothing.
  [[nodiscard]] std::optional<Millionths> distance(Millionths value) const;
};

/// The values of a number with which all expectations hold.
struct NumberRepair {
  Interval values;
  Millionths nearest = 0;
  std::vector<std::vector<std::uint32_t>> changed;  ///< by mission: lines, see differing_lines
};
struct Repairs {
  std::vector<NumberRepair> intervals;  ///< ascending
  bool is_complete = true;              ///< all values were looked at
};

/// Changes the numbers of a catalog, one at a time, and runs its missions. May be asked by several
/// threads at once.
class Tuner {
 public:
  /// `catalog` has no errors. It, the numbers and the missions must outlive the tuner.
  Tuner(const Catalog& catalog, const std::vector<TunableNumber>& numbers, Missions missions,
        Millionths margin);

  /// The missions with the numbers as they are.
  [[nodiscard]] const Recording& present() const { return present_; }

  [[nodiscard]] Tolerance tolerance(std::size_t number) const;
  /// Where expectations fail.
  [[nodiscard]] Repairs repairs(std::size_t number) const;

 private:
  using Visit = std::function<bool(const Recording& recording, Interval piece)>;
  bool visit_pieces(const Recording& present, std::size_t number, bool upwards, Until until,
                    const Visit& visit) const;
  [[nodiscard]] Recording run(const Catalog& catalog, Until until) const;

  const Catalog& catalog_;
  const std::vector<TunableNumber>& numbers_;
  const Missions missions_;
  const Millionths margin_;
  const Recording present_;
  Missions failing_first_;
  Recording first_failure_;  ///< as far as the first expectation that fails
};

}  // namespace cbc
