// Decision diagrams as K. S. Brace, R. L. Rudell and R. E. Bryant, "Efficient implementation of a
// BDD package", DAC 1990, describe them: one table of all nodes, so that equal sets are one node,
// and a table of remembered results in which a newer one replaces an older one. Complemented edges
// would save a part of the nodes, at more cost for each; nothing here needs the complement of a
// large set. A package with a manager of its own for each thread and exact counts is not among the
// libraries of Debian.
//
// Bits of which few are ones make long chains of nodes, so the tail is a table at the end of each
// path: diagrams whose ends are more than two constants (R. I. Bahar and others, "Algebraic
// decision diagrams and their applications", ICCAD 1993), here the sets of tails.

#include "explore/sets/diagrams.h"

#include <algorithm>
#include <bit>

namespace cbc {

namespace {

constexpr std::size_t first_table = 1024;
constexpr std::size_t most_remembered = std::size_t{1} << 20U;

std::uint64_t mix(std::uint64_t value) {
  value *= 0x9e3779b97f4a7c15U;
  value ^= value >> 32U;
  return value * 0xd6e8feb86659fd93U;
}

std::uint64_t sum(std::uint64_t a, std::uint64_t b) {
  return a > UINT64_MAX - b ? UINT64_MAX : a + b;
}

/// `value` times two to the power of `shift`.
std::uint64_t scaled(std::uint64_t value, std::uint32_t shift) {
  if (value == 0) return 0;
  return shift >= 64 || value > (UINT64_MAX >> shift) ? UINT64_MAX : value << shift;
}

}  // namespace

std::uint32_t Diagrams::tail_for(std::uint32_t bits, std::uint32_t most_ones) {
  constexpr std::uint64_t most_strings = std::uint64_t{1} << 15U;
  while (SparseStrings::count(bits, most_ones) > most_strings) --bits;
  return bits;
}

Diagrams::Diagrams(std::uint32_t bits, std::uint32_t tail, std::uint32_t most_ones)
    : bits_(bits),
      tails_(tail, most_ones),
      first_of_tail_(bits - tail),
      row_words_(tails_.words()),
      row_(row_words_, 0),
      table_(first_table, 0),
      remembered_(first_table) {
  static_cast<void>(add_leaf(0, 0));
  for (std::uint32_t string = 0; string < tails_.count(); ++string) set_bit(row_.data(), string);
  static_cast<void>(make_leaf());
}

std::uint64_t Diagrams::hash(const Node& node) const {
  if (node.bit == first_of_tail_) return hash(&rows_[node.no * row_words_]);
  return mix(mix((std::uint64_t{node.no} << 32U) | node.yes) ^ node.bit);
}

std::uint64_t Diagrams::hash(const Word* row) const {
  std::uint64_t hash = 0;
  for (std::size_t word = 0; word < row_words_; ++word) hash = mix(hash ^ row[word]);
  return hash;
}

std::uint64_t Diagrams::count_from(Set a, std::uint32_t bit) const {
  return scaled(counts_[a], nodes_[a].bit - bit);
}

std::uint64_t Diagrams::count(Set a) const { return count_from(a, 0); }

Diagrams::Set Diagrams::make(std::uint32_t bit, Set no, Set yes) {
  if (no == yes) return no;
  const Node made{bit, no, yes};
  const std::size_t mask = table_.size() - 1;
  std::size_t place = hash(made) & mask;
  for (; table_[place] != 0; place = (place + 1) & mask) {
    const Node& node = nodes_[table_[place]];
    if (node.no == no && node.yes == yes && node.bit == bit) return table_[place];
  }
  return add_node(place, made, sum(count_from(no, bit + 1), count_from(yes, bit + 1)));
}

/// The leaf of `row_`. The empty one is in no table.
Diagrams::Set Diagrams::make_leaf() {
  std::uint64_t count = 0;
  for (const Word word : row_) count += static_cast<std::uint64_t>(std::popcount(word));
  if (count == 0) return empty;
  const std::size_t mask = table_.size() - 1;
  std::size_t place = hash(row_.data()) & mask;
  for (; table_[place] != 0; place = (place + 1) & mask) {
    const Set known = table_[place];
    if (is_leaf(known) && std::equal(row_.begin(), row_.end(), row_of(known))) return known;
  }
  return add_leaf(place, count);
}

Diagrams::Set Diagrams::add_leaf(std::size_t place, std::uint64_t count) {
  auto row = static_cast<std::uint32_t>(rows_.size() / row_words_);
  if (free_rows_.empty()) {
    rows_.insert(rows_.end(), row_.begin(), row_.end());
  } else {
    row = free_rows_.back();
    free_rows_.pop_back();
    std::copy(row_.begin(), row_.end(), &rows_[row * row_words_]);
  }
  return add_node(place, {first_of_tail_, row, 0}, count);
}

Diagrams::Set Diagrams::add_node(std::size_t place, const Node& node, std::uint64_t count) {
  auto number = static_cast<Set>(nodes_.size());
  if (free_.empty()) {
    nodes_.push_back(node);
    counts_.push_back(count);
  } else {
    number = free_.back();
    free_.pop_back();
    nodes_[number] = node;
    counts_[number] = count;
  }
  table_[place] = number;
  if (++in_table_ * 2 > table_.size()) grow_table();
  return number;
}

void Diagrams::add_to_table(Set node) {
  const std::size_t mask = table_.size() - 1;
  std::size_t place = hash(nodes_[node]) & mask;
  while (table_[place] != 0) place = (place + 1) & mask;
  table_[place] = node;
}

/// Results are remembered in proportion to the nodes.
void Diagrams::grow_table() {
  const std::vector<Set> old = std::exchange(table_, std::vector<Set>(table_.size() * 2, 0));
  for (const Set node : old) {
    if (node != 0) add_to_table(node);
  }
  if (remembered_.size() >= most_remembered) return;
  const std::vector<Remembered> results =
      std::exchange(remembered_, std::vector<Remembered>(remembered_.size() * 2));
  for (const Remembered& result : results) {
    if (result.key != Key()) place_of(result.key) = result;
  }
}

Diagrams::Remembered& Diagrams::place_of(const Key& key) {
  return remembered_[mix(((std::uint64_t{key.a} << 32U) | key.b) ^ mix(key.operation)) &
                     (remembered_.size() - 1)];
}

Diagrams::Set Diagrams::with(std::uint32_t bit, bool value) {
  if (bit >= first_of_tail_) {
    std::fill(row_.begin(), row_.end(), 0);
    for (std::uint32_t string = 0; string < tails_.count(); ++string) {
      const auto ones = tails_.ones_of(string);
      const bool is_one = std::binary_search(ones.begin(), ones.end(), bit - first_of_tail_);
      if (is_one == value) set_bit(row_.data(), string);
    }
    return make_leaf();
  }
  return value ? make(bit, empty, all) : make(bit, all, empty);
}

Diagrams::Set Diagrams::with(const Values& values) {
  Set result = all;
  for (auto bit = values.bits.rbegin(); bit != values.bits.rend(); ++bit) {
    if (bit->first >= first_of_tail_) {
      result = both(result, with(bit->first, bit->second));
      continue;
    }
    result = bit->second ? make(bit->first, empty, result) : make(bit->first, result, empty);
  }
  return result;
}

Diagrams::Set Diagrams::both(Set a, Set b) { return combine(Operation::both, a, b); }
Diagrams::Set Diagrams::either(Set a, Set b) { return combine(Operation::either, a, b); }
Diagrams::Set Diagrams::without(Set a, Set b) { return combine(Operation::without, a, b); }

Diagrams::Set Diagrams::combine(Operation operation, Set a, Set b) {
  switch (operation) {
    case Operation::both:
      if (a == b || b == all) return a;
      if (a == all) return b;
      if (a == empty || b == empty) return empty;
      if (a > b) std::swap(a, b);
      break;
    case Operation::either:
      if (a == b || b == empty) return a;
      if (a == empty) return b;
      if (a == all || b == all) return all;
      if (a > b) std::swap(a, b);
      break;
    default:  // without
      if (a == empty || b == all || a == b) return empty;
      if (b == empty) return a;
      break;
  }
  const Key key = key_of(operation, a, b);
  if (const Remembered& known = place_of(key); known.key == key) return known.result;
  const std::uint32_t bit = std::min(nodes_[a].bit, nodes_[b].bit);
  if (bit == first_of_tail_) {
    const Set result = combine_leaves(operation, a, b);
    place_of(key) = {key, result};
    return result;
  }
  const bool splits_a = nodes_[a].bit == bit;
  const bool splits_b = nodes_[b].bit == bit;
  const Set yes = combine(operation, splits_a ? nodes_[a].yes : a, splits_b ? nodes_[b].yes : b);
  const Set no = combine(operation, splits_a ? nodes_[a].no : a, splits_b ? nodes_[b].no : b);
  const Set result = make(bit, no, yes);
  place_of(key) = {key, result};
  return result;
}

Diagrams::Set Diagrams::combine_leaves(Operation operation, Set a, Set b) {
  const Word* const of_a = row_of(a);
  const Word* const of_b = row_of(b);
  for (std::size_t word = 0; word < row_words_; ++word) {
    row_[word] = operation == Operation::both     ? of_a[word] & of_b[word]
                 : operation == Operation::either ? of_a[word] | of_b[word]
                                                  : of_a[word] & ~of_b[word];
  }
  return make_leaf();
}

// Changes of bits.

Diagrams::ValuesNumber Diagrams::keep(Values values) {
  Values head = values;
  std::vector<Cleared>& cleared = cleared_.emplace_back();
  for (; !head.bits.empty() && head.bits.back().first >= first_of_tail_; head.bits.pop_back()) {
    const std::uint32_t bit = head.bits.back().first;
    std::vector<bool> bits(bits_, false);
    bits[bit] = true;
    cleared.push_back({keep_bits(std::move(bits)), with(bit, true)});
  }
  cubes_.push_back(with(head));
  values_.push_back(std::move(values));
  return static_cast<ValuesNumber>(values_.size() - 1);
}

Diagrams::ValuesNumber Diagrams::keep_both(ValuesNumber a, ValuesNumber b) {
  Values both;
  std::set_union(values_[a].bits.begin(), values_[a].bits.end(), values_[b].bits.begin(),
                 values_[b].bits.end(), std::back_inserter(both.bits));
  return keep(std::move(both));
}

/// Whether no bit before the tail that the values give is mentioned from here on.
bool Diagrams::is_past_head(Set a, std::uint32_t number) const {
  const auto& bits = values_[number].bits;
  const std::size_t head = bits.size() - cleared_[number].size();
  return head == 0 || nodes_[a].bit > bits[head - 1].first;
}

/// The strings that differ from one of the set only in these bits, of those before the tail.
Diagrams::Set Diagrams::forget(Set a, std::uint32_t number) {
  if (is_past_head(a, number)) return a;
  const auto& bits = values_[number].bits;
  const Key key = key_of(Operation::forget, a, number);
  if (const Remembered& known = place_of(key); known.key == key) return known.result;
  const std::uint32_t bit = nodes_[a].bit;
  const Set no = forget(nodes_[a].no, number);
  const Set yes = forget(nodes_[a].yes, number);
  const bool is_listed =
      std::any_of(bits.begin(), bits.end(), [bit](const auto& one) { return one.first == bit; });
  const Set result = is_listed ? either(no, yes) : make(bit, no, yes);
  place_of(key) = {key, result};
  return result;
}

Diagrams::Set Diagrams::changed(Set a, ValuesNumber values) {
  Set result = both(forget(a, values), cubes_[values]);
  for (const Cleared& bit : cleared_[values]) {
    const Set were_ones = one_changed(result, bit.bit, false);
    result = either(without(result, bit.ones), were_ones);
  }
  return result;
}

Diagrams::Set Diagrams::before_change(Set a, ValuesNumber values) {
  for (const Cleared& bit : cleared_[values]) {
    const Set zeros = without(a, bit.ones);
    a = either(zeros, one_changed(zeros, bit.bit, true));
  }
  return before_head_change(a, values);
}

Diagrams::Set Diagrams::before_head_change(Set a, std::uint32_t values) {
  if (is_past_head(a, values)) return a;
  const auto& bits = values_[values].bits;
  const Key key = key_of(Operation::before, a, values);
  if (const Remembered& known = place_of(key); known.key == key) return known.result;
  const std::uint32_t bit = nodes_[a].bit;
  const auto listed =
      std::find_if(bits.begin(), bits.end(), [bit](const auto& one) { return one.first == bit; });
  Set result = empty;
  if (listed != bits.end()) {
    result = before_head_change(listed->second ? nodes_[a].yes : nodes_[a].no, values);
  } else {
    const Set no = before_head_change(nodes_[a].no, values);
    const Set yes = before_head_change(nodes_[a].yes, values);
    result = make(bit, no, yes);
  }
  place_of(key) = {key, result};
  return result;
}

void Diagrams::change(std::vector<std::uint8_t>& string, ValuesNumber values) const {
  for (const auto& [bit, value] : values_[values].bits) string[bit] = value ? 1 : 0;
}

Diagrams::ValuesNumber Diagrams::keep_bits(std::vector<bool> bits) {
  bits.resize(bits_, false);
  tail_lists_.emplace_back(bits.begin() + first_of_tail_, bits.end());
  bit_lists_.push_back(std::move(bits));
  return static_cast<ValuesNumber>(bit_lists_.size() - 1);
}

Diagrams::Set Diagrams::one_changed(Set a, ValuesNumber bits, bool to) {
  return one_changed(a, bits, to, 0);
}

/// Of the bits from `bit` on.
Diagrams::Set Diagrams::one_changed(Set a, std::uint32_t number, bool to, std::uint32_t bit) {
  if (a == empty) return empty;
  const std::vector<bool>& listed = bit_lists_[number];
  // A node does not mention bits on which nothing depends, but these may change.
  while (bit < nodes_[a].bit && !listed[bit]) ++bit;
  const Key key = key_of(to ? Operation::set : Operation::clear, a, number, bit);
  if (const Remembered& known = place_of(key); known.key == key) return known.result;
  if (bit == first_of_tail_) {
    std::fill(row_.begin(), row_.end(), 0);
    tails_.add_one_changed(row_of(a), tail_lists_[number], to, row_.data());
    const Set result = make_leaf();
    place_of(key) = {key, result};
    return result;
  }
  const bool splits = nodes_[a].bit == bit;
  const Set no = splits ? nodes_[a].no : a;
  const Set yes = splits ? nodes_[a].yes : a;
  Set new_no = one_changed(no, number, to, bit + 1);
  Set new_yes = one_changed(yes, number, to, bit + 1);
  if (listed[bit]) {
    if (to) {
      new_yes = either(new_yes, no);
    } else {
      new_no = either(new_no, yes);
    }
  }
  const Set result = make(bit, new_no, new_yes);
  place_of(key) = {key, result};
  return result;
}

bool Diagrams::contains(Set a, const std::vector<std::uint8_t>& string) const {
  while (!is_leaf(a)) a = string[nodes_[a].bit] != 0 ? nodes_[a].yes : nodes_[a].no;
  if (a == empty) return false;
  const std::uint32_t tail = tails_.find(string.data() + first_of_tail_);
  return tail < tails_.count() && has_bit(row_of(a), tail);
}

void Diagrams::pick(Set a, std::vector<std::uint8_t>& string) const {
  string.assign(bits_, 0);
  while (!is_leaf(a)) {
    const Node& node = nodes_[a];
    if (node.no != empty) {
      a = node.no;
    } else {
      string[node.bit] = 1;
      a = node.yes;
    }
  }
  const Word* word = row_of(a);
  while (*word == 0) ++word;
  const std::size_t first = static_cast<std::size_t>(word - row_of(a)) * 64 +
                            static_cast<std::size_t>(std::countr_zero(*word));
  for (const std::uint32_t place : tails_.ones_of(static_cast<std::uint32_t>(first))) {
    string[first_of_tail_ + place] = 1;
  }
}

// Parcels.

void Diagrams::put(Set set, Parcel& parcel) const {
  const auto place_of = [&](Set node) {
    if (node <= all) return node;
    const auto found = parcel.places_.find(node);
    return found != parcel.places_.end() ? found->second : 0;
  };
  std::vector<Set> open = {set};
  while (!open.empty()) {
    const Set number = open.back();
    const Node& node = nodes_[number];
    if (place_of(number) != 0 || number == empty) {
      open.pop_back();
      continue;
    }
    Parcel::Node copy{node.bit, node.no, node.yes};
    if (is_leaf(number)) {
      copy.no = static_cast<std::uint32_t>(parcel.rows_.size() / row_words_);
      parcel.rows_.insert(parcel.rows_.end(), row_of(number), row_of(number) + row_words_);
    } else {
      copy.no = place_of(node.no);
      copy.yes = place_of(node.yes);
      if (copy.no == 0 && node.no != empty) open.push_back(node.no);
      if (copy.yes == 0 && node.yes != empty) open.push_back(node.yes);
      if (open.back() != number) continue;
    }
    open.pop_back();
    parcel.nodes_.push_back(copy);
    parcel.places_.emplace(number, static_cast<std::uint32_t>(parcel.nodes_.size() + 1));
  }
  parcel.sets_.push_back(place_of(set));
}

std::vector<Diagrams::Set> Diagrams::take(const Parcel& parcel) {
  std::vector<Set> nodes = {empty, all};
  for (const Parcel::Node& node : parcel.nodes_) {
    if (node.bit < first_of_tail_) {
      nodes.push_back(make(node.bit, nodes[node.no], nodes[node.yes]));
      continue;
    }
    std::copy_n(&parcel.rows_[node.no * row_words_], row_words_, row_.begin());
    nodes.push_back(make_leaf());
  }
  std::vector<Set> sets;
  sets.reserve(parcel.sets_.size());
  for (const std::uint32_t place : parcel.sets_) sets.push_back(nodes[place]);
  return sets;
}

std::size_t Diagrams::bytes() const {
  return nodes_.capacity() * (sizeof(Node) + sizeof(std::uint64_t)) +
         rows_.capacity() * sizeof(Word) + table_.size() * sizeof(Set) +
         remembered_.size() * sizeof(Remembered);
}

// Collection.

void Diagrams::begin_collection() {
  is_marked_.assign(nodes_.size(), false);
  for (const Set cube : cubes_) mark(cube);
  for (const std::vector<Cleared>& cleared : cleared_) {
    for (const Cleared& bit : cleared) mark(bit.ones);
  }
}

void Diagrams::mark(Set kept) {
  to_mark_.push_back(kept);
  while (!to_mark_.empty()) {
    const Set number = to_mark_.back();
    const Node& node = nodes_[number];
    to_mark_.pop_back();
    if (number <= all || is_marked_[number]) continue;
    is_marked_[number] = true;
    if (is_leaf(number)) continue;
    to_mark_.push_back(node.no);
    to_mark_.push_back(node.yes);
  }
}

void Diagrams::end_collection() {
  std::fill(table_.begin(), table_.end(), 0);
  std::fill(remembered_.begin(), remembered_.end(), Remembered());
  add_to_table(all);
  in_table_ = 1;
  std::vector<bool> is_free(nodes_.size(), false);
  for (const Set number : free_) is_free[number] = true;
  for (Set number = static_cast<Set>(nodes_.size()); number-- > 2;) {
    if (!is_marked_[number]) {
      if (is_free[number]) continue;
      free_.push_back(number);
      if (is_leaf(number)) free_rows_.push_back(nodes_[number].no);
      continue;
    }
    add_to_table(number);
    ++in_table_;
  }
  most_before_collection_ = std::max(most_before_collection_, nodes() * 2);
}

}  // namespace cbc
