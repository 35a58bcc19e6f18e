// The values of a number fall into pieces in each of which the missions run alike. From a value,
// its piece reaches as far as all decisions stay, and the next one begins a ten-thousandth of a
// percent further. The tolerance is the piece of the present value, with neighbors that differ only
// in what the solver was asked. To repair expectations is inverse optimization in one parameter:
// all pieces are visited, each as far as its first expectation that fails. So most numbers have one
// piece, and that no single number is enough is proved.
//
// To try values on a coarse grid would be simpler, and would miss intervals and prove nothing.

#include "tune/engine/tuner.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "core/compile/compile.h"
#include "tune/engine/decision_range.h"

namespace cbc {
namespace {

constexpr std::size_t most_pieces = 100'000;

}  // namespace

Millionths Interval::nearest(Millionths value, Millionths margin) const {
  const std::int64_t least = low == 0 ? 0 : std::int64_t{low} + margin;
  const std::int64_t most = high == one_million ? high : std::int64_t{high} - margin;
  if (least > most) return std::midpoint(low, high);
  return static_cast<Millionths>(std::clamp<std::int64_t>(value, least, most));
}

std::optional<Millionths> Tolerance::distance(Millionths value) const {
  std::optional<Millionths> least;
  if (below) least = value - values.low;
  if (above) least = std::min(least.value_or(one_million), values.high - value);
  return least;
}

Tuner::Tuner(const Catalog& catalog, const std::vector<TunableNumber>& numbers, Missions missions,
             Millionths margin)
    : catalog_(catalog),
      numbers_(numbers),
      missions_(std::move(missions)),
      margin_(margin),
      present_(run(catalog, Until::end)),
      failing_first_(missions_) {
  if (present_.failures.empty()) return;
  const auto first =
      failing_first_.begin() + static_cast<std::ptrdiff_t>(present_.failures.front().mission);
  std::rotate(failing_first_.begin(), first, first + 1);
  first_failure_ = run(catalog, Until::failure);
}

Tolerance Tuner::tolerance(std::size_t number) const {
  Tolerance tolerance;
  const auto find_end = [&](bool upwards, Millionths& end, std::optional<RunDifference>& beyond) {
    visit_pieces(present_, number, upwards, Until::end,
                 [&](const Recording& recording, Interval piece) {
                   if (&recording != &present_) beyond = find_difference(present_, recording);
                   if (!beyond) end = upwards ? piece.high : piece.low;
                   return !beyond;
                 });
  };
  find_end(false, tolerance.values.low, tolerance.below);
  find_end(true, tolerance.values.high, tolerance.above);
  return tolerance;
}

Repairs Tuner::repairs(std::size_t number) const {
  if (present_.failures.empty()) return {};
  Repairs repairs;
  std::vector<Interval> found;
  for (const bool upwards : {false, true}) {
    repairs.is_complete &= visit_pieces(first_failure_, number, upwards, Until::failure,
                                        [&](const Recording& recording, Interval piece) {
                                          if (recording.holds()) found.push_back(piece);
                                          return true;
                                        });
  }
  std::sort(found.begin(), found.end(),
            [](const Interval& a, const Interval& b) { return a.low < b.low; });
  for (const Interval& piece : found) {
    if (repairs.intervals.empty() || repairs.intervals.back().values.high + 1 < piece.low) {
      repairs.intervals.push_back({piece, 0, {}});
    } else {
      repairs.intervals.back().values.high = piece.high;
    }
  }
  for (NumberRepair& repair : repairs.intervals) {
    repair.nearest = repair.values.nearest(numbers_[number].value, margin_);
    Catalog changed = catalog_;
    set_number(changed, numbers_[number], repair.nearest);
    const Recording recording = run(changed, Until::end);
    for (std::size_t mission = 0; mission < missions_.size(); ++mission) {
      repair.changed.push_back(differing_lines(present_, recording, mission));
    }
  }
  return repairs;
}

/// Visits the piece of the present value, and those beyond it, until `visit` returns false. False
/// if there are too many.
bool Tuner::visit_pieces(const Recording& present, std::size_t number, bool upwards, Until until,
                         const Visit& visit) const {
  const TunableNumber& changed = numbers_[number];
  Catalog catalog = catalog_;
  const Recording* recording = &present;
  Recording further;
  Millionths value = changed.value;
  for (std::size_t count = 0; count < most_pieces; ++count) {
    const Millionths end =
        last_unchanged(catalog, changed, value, recording->catalog, recording->decisions, upwards);
    if (!visit(*recording, {std::min(value, end), std::max(value, end)})) return true;
    if (end == (upwards ? one_million : 0)) return true;
    value = upwards ? end + 1 : end - 1;
    set_number(catalog, changed, value);
    further = run(catalog, until);
    recording = &further;
  }
  return false;
}

Recording Tuner::run(const Catalog& catalog, Until until) const {
  Recording recording =
      record(compile(catalog), until == Until::end ? missions_ : failing_first_, until);
  if (recording.status == Coordinator::Status::refused_answer) {
    throw std::logic_error(recording.internal_error);
  }
  return recording;
}

}  // namespace cbc
