#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cbc {

/// Sets of bit strings of one length, as reduced ordered binary decision diagrams (R. E. Bryant,
/// "Graph-based algorithms for Boolean function manipulation", IEEE Transactions on Computers C-35
/// (1986)). Equal sets are the same number. Each node knows the size of its set. Not for use by
/// several threads.
class Diagrams {
 public:
  using Set = std::uint32_t;
  static constexpr Set empty = 0;
  static constexpr Set all = 1;

  /// A fixed value for some bits.
  struct Values {
    std::vector<std::pair<std::uint32_t, bool>> bits;  ///< by bit, ascending
  };
  using ValuesNumber = std::uint32_t;

  explicit Diagrams(std::uint32_t bits);

  [[nodiscard]] std::uint32_t bits() const { return bits_; }

  /// The strings that have this value of a bit.
  [[nodiscard]] Set with(std::uint32_t bit, bool value);
  /// The strings that have all of these values.
  [[nodiscard]] Set with(const Values& values);
  [[nodiscard]] Set both(Set a, Set b);
  [[nodiscard]] Set either(Set a, Set b);
  /// What is in `a` and not in `b`.
  [[nodiscard]] Set without(Set a, Set b);
  [[nodiscard]] Set complement(Set a) { return without(all, a); }

  /// Values for changed() and before_change(), kept as long as this object.
  [[nodiscard]] ValuesNumber keep(Values values);
  /// The strings of the set after their bits got these values.
  [[nodiscard]] Set changed(Set a, ValuesNumber values);
  /// The strings that are in the set once their bits get these values.
  [[nodiscard]] Set before_change(Set a, ValuesNumber values);

  /// Bits that one_set() and one_cleared() change, kept as long as this object.
  [[nodiscard]] ValuesNumber keep_bits(std::vector<bool> bits);
  /// The strings that come of those of the set by setting (clearing) one of these bits that was not
  /// (was) set.
  [[nodiscard]] Set one_changed(Set a, ValuesNumber bits, bool to);

  /// How many strings a set has; UINT64_MAX if it has at least as many.
  [[nodiscard]] std::uint64_t count(Set a) const;
  [[nodiscard]] bool contains(Set a, const std::vector<std::uint8_t>& string) const;
  /// One of the strings of a set that is not empty.
  void pick(Set a, std::vector<std::uint8_t>& string) const;

  [[nodiscard]] std::size_t nodes() const { return nodes_.size() - free_.size(); }
  [[nodiscard]] std::size_t bytes() const;
  /// Whether collect() may be worth its time.
  [[nodiscard]] bool is_crowded() const { return nodes() > most_before_collection_; }
  /// Forgets all sets but those that `for_each_kept` names, and what with() has returned.
  /// `for_each_kept` calls its argument for each set.
  template <typename ForEachKept>
  void collect(ForEachKept&& for_each_kept) {
    begin_collection();
    for_each_kept([this](Set kept) { mark(kept); });
    end_collection();
  }

 private:
  struct Node {
    std::uint32_t bit = 0;
    Set no = empty;
    Set yes = empty;
  };
  enum class Operation : std::uint32_t {
    nothing,
    both,
    either,
    without,
    forget,
    before,
    set,
    clear
  };
  struct Key {
    Set a = empty;
    std::uint32_t b = 0;
    std::uint32_t operation = 0;  ///< and a third argument

    bool operator==(const Key&) const = default;
  };
  struct Remembered {
    Key key;
    Set result = empty;
  };

  [[nodiscard]] Set make(std::uint32_t bit, Set no, Set yes);
  [[nodiscard]] std::uint64_t count_from(Set a, std::uint32_t bit) const;
  [[nodiscard]] static Key key_of(Operation operation, Set a, std::uint32_t b,
                                  std::uint32_t c = 0) {
    return {a, b, (c << 3U) | static_cast<std::uint32_t>(operation)};
  }
  [[nodiscard]] Remembered& place_of(const Key& key);
  [[nodiscard]] Set combine(Operation operation, Set a, Set b);
  [[nodiscard]] Set forget(Set a, std::uint32_t number);
  [[nodiscard]] Set one_changed(Set a, std::uint32_t number, bool to, std::uint32_t bit);
  [[nodiscard]] static std::uint64_t hash(std::uint32_t bit, Set no, Set yes);
  void add_to_table(Set node);
  void grow_table();
  void begin_collection();
  void mark(Set kept);
  void end_collection();

  const std::uint32_t bits_;
  std::vector<Node> nodes_;
  std::vector<std::uint64_t> counts_;  ///< by node: strings of its bit and those after it
  std::vector<Set> free_;
  std::vector<Set> table_;  ///< of nodes by their hash; 0: none
  std::size_t in_table_ = 0;
  std::vector<Remembered> remembered_;
  std::vector<Values> values_;
  std::vector<Set> cubes_;  ///< by number of values
  std::vector<std::vector<bool>> bit_lists_;
  std::vector<Set> to_mark_;
  std::vector<bool> is_marked_;
  std::size_t most_before_collection_ = std::size_t{1} << 20U;
};

}  // namespace cbc
