#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "runtime/solver/trail.h"

namespace cbc::nogoods_test {
namespace {

/// Four clauses, all of which may be forgotten, and which of them are kept.
class FourNogoods {
 public:
  FourNogoods() {
    nogoods_.clear(std::size_t{2} * count);
    for (std::uint32_t number = 0; number < count; ++number) {
      const std::array<Literal, 2> literals = {positive(2 * number), positive(2 * number + 1)};
      nogoods_.add(literals, 3);
    }
  }

  void use(std::uint32_t nogood, int times) {
    for (int i = 0; i < times; ++i) nogoods_.note_use(nogood);
  }

  /// Until what was used so far is next to nothing.
  void age() {
    for (int i = 0; i < 227'700; ++i) nogoods_.age();  // 1.001^227'700 is 6.9e98
  }

  [[nodiscard]] std::vector<std::uint32_t> kept() {
    nogoods_.forget_half();
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t kept = 0; kept < nogoods_.size(); ++kept) {
      numbers.push_back(nogoods_.literals(kept)[0] / 4);
    }
    return numbers;
  }

 private:
  static constexpr std::uint32_t count = 4;
  static Literal positive(std::uint32_t variable) { return 2 * variable; }

  Nogoods nogoods_;
};

using Numbers = std::vector<std::uint32_t>;

TEST(Nogoods, ForgetsWhatIsUsedLeast) {
  FourNogoods nogoods;
  nogoods.use(1, 2);
  nogoods.use(3, 1);
  EXPECT_EQ(nogoods.kept(), (Numbers{1, 3}));
}

TEST(Nogoods, LaterUseCountsMore) {
  FourNogoods nogoods;
  nogoods.use(0, 1'000);
  nogoods.use(1, 1'000);
  nogoods.age();
  nogoods.use(2, 1);
  nogoods.use(3, 1);
  EXPECT_EQ(nogoods.kept(), (Numbers{2, 3}));
}

// Beyond 1e100 all activities are scaled down, and nothing else may come of it.

TEST(Nogoods, UseCountsTheSameBeforeAndAfterScaling) {
  FourNogoods nogoods;
  nogoods.age();
  nogoods.use(0, 20);  // is scaled down at the 15th time
  nogoods.use(1, 30);
  nogoods.use(2, 19);
  nogoods.use(3, 21);
  EXPECT_EQ(nogoods.kept(), (Numbers{1, 3}));
}

TEST(Nogoods, ScalingDownIsForAll) {
  FourNogoods nogoods;
  nogoods.age();
  nogoods.use(0, 14);
  nogoods.use(1, 13);
  nogoods.use(2, 20);  // is scaled down at the 15th time
  nogoods.use(3, 19);
  EXPECT_EQ(nogoods.kept(), (Numbers{2, 3}));
}

}  // namespace
}  // namespace cbc::nogoods_test
