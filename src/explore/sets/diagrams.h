#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "explore/sets/bit_sets.h"
#include "explore/sets/sparse_strings.h"

namespace cbc {

/// Sets of bit strings of one length, as reduced ordered binary decision diagrams (R. E. Bryant,
/// "Graph-based algorithms for Boolean function manipulation", IEEE Transactions on Computers C-35
/// (1986)), but that the last bits, the tail, of which few are ones, are decided at once. Equal
/// sets are the same number. Each node knows the size of its set. So an exploration keeps millions
/// of environments of a control as one number. Not for use by several threads.
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

  /// Strings with more than `most_ones` ones among the last `tail` of the bits do not exist. The
  /// others of the tail take a bit of memory each in a leaf; see tail_for().
  explicit Diagrams(std::uint32_t bits, std::uint32_t tail = 0, std::uint32_t most_ones = 0);

  /// The longest tail of at most so many bits for which leaves stay small.
  [[nodiscard]] static std::uint32_t tail_for(std::uint32_t bits, std::uint32_t most_ones);

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

  /// Values for changed() and before_change(), of the tail only zeros; kept as long as this object.
  [[nodiscard]] ValuesNumber keep(Values values);
  /// All that two give, which agree where they give a bit both.
  [[nodiscard]] ValuesNumber keep_both(ValuesNumber a, ValuesNumber b);
  /// The strings of the set after their bits got these values.
  [[nodiscard]] Set changed(Set a, ValuesNumber values);
  /// The strings that are in the set once their bits get these values.
  [[nodiscard]] Set before_change(Set a, ValuesNumber values);
  /// Gives the bits of one string these values.
  void change(std::vector<std::uint8_t>& string, ValuesNumber values) const;

  /// Bits that one_changed() changes, kept as long as this object.
  [[nodiscard]] ValuesNumber keep_bits(std::vector<bool> bits);
  /// The strings that come of those of the set by setting (clearing) one of these bits that was not
  /// (was) set.
  [[nodiscard]] Set one_changed(Set a, ValuesNumber bits, bool to);

  /// How many strings a set has; UINT64_MAX if it has at least as many.
  [[nodiscard]] std::uint64_t count(Set a) const;
  [[nodiscard]] bool contains(Set a, const std::vector<std::uint8_t>& string) const;
  /// One of the strings of a set that is not empty.
  void pick(Set a, std::vector<std::uint8_t>& string) const;

  /// Sets on their way to another object, of sets of strings of the same form.
  class Parcel {
   public:
    [[nodiscard]] std::size_t size() const { return sets_.size(); }

   private:
    friend class Diagrams;
    struct Node {
      std::uint32_t bit = 0;
      std::uint32_t no = 0;  ///< places in `nodes_`, plus 2; of a leaf: its row
      std::uint32_t yes = 0;
    };
    std::vector<Node> nodes_;  ///< each after those that it refers to
    std::vector<Word> rows_;
    std::vector<std::uint32_t> sets_;                          ///< 0 and 1, places plus 2
    std::unordered_map<std::uint32_t, std::uint32_t> places_;  ///< plus 2, by node of the sender
  };
  void put(Set set, Parcel& parcel) const;
  /// The sets of a parcel, in the order in which they were put.
  [[nodiscard]] std::vector<Set> take(const Parcel& parcel);

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
    std::uint32_t bit = 0;  ///< of a leaf: the first of the tail
    Set no = empty;         ///< of a leaf: the number of its row
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
  [[nodiscard]] bool is_leaf(Set a) const { return nodes_[a].bit == first_of_tail_; }
  [[nodiscard]] const Word* row_of(Set leaf) const { return &rows_[nodes_[leaf].no * row_words_]; }
  [[nodiscard]] Set add_node(std::size_t place, const Node& node, std::uint64_t count);
  [[nodiscard]] Set make_leaf();
  [[nodiscard]] Set add_leaf(std::size_t place, std::uint64_t count);
  [[nodiscard]] Set combine_leaves(Operation operation, Set a, Set b);
  [[nodiscard]] std::uint64_t count_from(Set a, std::uint32_t bit) const;
  [[nodiscard]] static Key key_of(Operation operation, Set a, std::uint32_t b,
                                  std::uint32_t c = 0) {
    return {a, b, (c << 3U) | static_cast<std::uint32_t>(operation)};
  }
  [[nodiscard]] Remembered& place_of(const Key& key);
  [[nodiscard]] Set combine(Operation operation, Set a, Set b);
  [[nodiscard]] Set forget(Set a, std::uint32_t number);
  [[nodiscard]] Set before_head_change(Set a, std::uint32_t number);
  [[nodiscard]] bool is_past_head(Set a, std::uint32_t number) const;
  [[nodiscard]] Set one_changed(Set a, std::uint32_t number, bool to, std::uint32_t bit);
  [[nodiscard]] std::uint64_t hash(const Node& node) const;
  [[nodiscard]] std::uint64_t hash(const Word* row) const;
  void add_to_table(Set node);
  void grow_table();
  void begin_collection();
  void mark(Set kept);
  void end_collection();

  const std::uint32_t bits_;
  const SparseStrings tails_;
  const std::uint32_t first_of_tail_;
  const std::size_t row_words_;
  std::vector<Node> nodes_;
  std::vector<std::uint64_t> counts_;  ///< by node: strings of its bit and those after it
  std::vector<Word> rows_;             ///< of leaves: the tails that they have
  std::vector<Word> row_;              ///< a new one
  std::vector<Set> free_;
  std::vector<std::uint32_t> free_rows_;
  std::vector<Set> table_;  ///< of nodes by their hash; 0: none
  std::size_t in_table_ = 0;
  std::vector<Remembered> remembered_;
  std::vector<Values> values_;  ///< kept ones
  std::vector<Set> cubes_;      ///< of these, what precedes the tail
  /// And each bit of the tail.
  struct Cleared {
    ValuesNumber bit = 0;  ///< alone, as kept bits
    Set ones = empty;      ///< the strings that have it
  };
  std::vector<std::vector<Cleared>> cleared_;
  std::vector<std::vector<bool>> bit_lists_;
  std::vector<std::vector<bool>> tail_lists_;  ///< of those, the tail
  std::vector<Set> to_mark_;
  std::vector<bool> is_marked_;
  std::size_t most_before_collection_ = std::size_t{1} << 20U;
};

}  // namespace cbc
