// Decision diagrams as K. S. Brace, R. L. Rudell and R. E. Bryant, "Efficient implementation of a
// BDD package", DAC 1990, describe them: one table of all nodes, so that equal sets are one node,
// and a table of remembered results in which a newer one replaces an older one. Complemented edges
// would save a part of the nodes, at more cost for each; nothing here needs the complement of a
// large set. A package with a manager of its own for each thread and exact counts is not among the
// libraries of Debian.

#include "verify/engine/diagrams.h"

#include <algorithm>

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

Diagrams::Diagrams(std::uint32_t bits)
    : bits_(bits), table_(first_table, 0), remembered_(first_table) {
  nodes_.resize(2);
  for (const Set constant : {empty, all}) nodes_[constant].bit = bits;
  counts_ = {0, 1};
}

std::uint64_t Diagrams::hash(std::uint32_t bit, Set no, Set yes) {
  return mix(mix((std::uint64_t{no} << 32U) | yes) ^ bit);
}

std::uint64_t Diagrams::count_from(Set a, std::uint32_t bit) const {
  return scaled(counts_[a], nodes_[a].bit - bit);
}

std::uint64_t Diagrams::count(Set a) const { return count_from(a, 0); }

Diagrams::Set Diagrams::make(std::uint32_t bit, Set no, Set yes) {
  if (no == yes) return no;
  const std::size_t mask = table_.size() - 1;
  std::size_t place = hash(bit, no, yes) & mask;
  for (; table_[place] != 0; place = (place + 1) & mask) {
    const Node& node = nodes_[table_[place]];
    if (node.no == no && node.yes == yes && node.bit == bit) return table_[place];
  }
  Set number = 0;
  if (free_.empty()) {
    number = static_cast<Set>(nodes_.size());
    nodes_.emplace_back();
    counts_.push_back(0);
  } else {
    number = free_.back();
    free_.pop_back();
  }
  nodes_[number] = {bit, no, yes};
  counts_[number] = sum(count_from(no, bit + 1), count_from(yes, bit + 1));
  table_[place] = number;
  if (++in_table_ * 2 > table_.size()) grow_table();
  return number;
}

void Diagrams::add_to_table(Set node) {
  const std::size_t mask = table_.size() - 1;
  std::size_t place = hash(nodes_[node].bit, nodes_[node].no, nodes_[node].yes) & mask;
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
  return value ? make(bit, empty, all) : make(bit, all, empty);
}

Diagrams::Set Diagrams::with(const Values& values) {
  Set result = all;
  for (auto bit = values.bits.rbegin(); bit != values.bits.rend(); ++bit) {
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
  const bool splits_a = nodes_[a].bit == bit;
  const bool splits_b = nodes_[b].bit == bit;
  const Set yes = combine(operation, splits_a ? nodes_[a].yes : a, splits_b ? nodes_[b].yes : b);
  const Set no = combine(operation, splits_a ? nodes_[a].no : a, splits_b ? nodes_[b].no : b);
  const Set result = make(bit, no, yes);
  place_of(key) = {key, result};
  return result;
}

// Changes of bits.

Diagrams::ValuesNumber Diagrams::keep(Values values) {
  cubes_.push_back(with(values));
  values_.push_back(std::move(values));
  return static_cast<ValuesNumber>(values_.size() - 1);
}

/// The strings that differ from one of the set only in these bits.
Diagrams::Set Diagrams::forget(Set a, std::uint32_t number) {
  const auto& bits = values_[number].bits;
  if (bits.empty() || nodes_[a].bit > bits.back().first) return a;
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
  return both(forget(a, values), cubes_[values]);
}

Diagrams::Set Diagrams::before_change(Set a, ValuesNumber values) {
  const auto& bits = values_[values].bits;
  if (bits.empty() || nodes_[a].bit > bits.back().first) return a;
  const Key key = key_of(Operation::before, a, values);
  if (const Remembered& known = place_of(key); known.key == key) return known.result;
  const std::uint32_t bit = nodes_[a].bit;
  const auto listed =
      std::find_if(bits.begin(), bits.end(), [bit](const auto& one) { return one.first == bit; });
  Set result = empty;
  if (listed != bits.end()) {
    result = before_change(listed->second ? nodes_[a].yes : nodes_[a].no, values);
  } else {
    const Set no = before_change(nodes_[a].no, values);
    const Set yes = before_change(nodes_[a].yes, values);
    result = make(bit, no, yes);
  }
  place_of(key) = {key, result};
  return result;
}

Diagrams::ValuesNumber Diagrams::keep_bits(std::vector<bool> bits) {
  bits.resize(bits_, false);
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
  if (bit == bits_) return empty;
  const Key key = key_of(to ? Operation::set : Operation::clear, a, number, bit);
  if (const Remembered& known = place_of(key); known.key == key) return known.result;
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
  while (a > all) a = string[nodes_[a].bit] != 0 ? nodes_[a].yes : nodes_[a].no;
  return a == all;
}

void Diagrams::pick(Set a, std::vector<std::uint8_t>& string) const {
  string.assign(bits_, 0);
  while (a > all) {
    const Node& node = nodes_[a];
    if (node.no != empty) {
      a = node.no;
    } else {
      string[node.bit] = 1;
      a = node.yes;
    }
  }
}

std::size_t Diagrams::bytes() const {
  return nodes_.capacity() * (sizeof(Node) + sizeof(std::uint64_t)) + table_.size() * sizeof(Set) +
         remembered_.size() * sizeof(Remembered);
}

// Collection.

void Diagrams::begin_collection() {
  is_marked_.assign(nodes_.size(), false);
  for (const Set cube : cubes_) mark(cube);
}

void Diagrams::mark(Set kept) {
  to_mark_.push_back(kept);
  while (!to_mark_.empty()) {
    const Set number = to_mark_.back();
    const Node& node = nodes_[number];
    to_mark_.pop_back();
    if (number <= all || is_marked_[number]) continue;
    is_marked_[number] = true;
    to_mark_.push_back(node.no);
    to_mark_.push_back(node.yes);
  }
}

void Diagrams::end_collection() {
  std::fill(table_.begin(), table_.end(), 0);
  std::fill(remembered_.begin(), remembered_.end(), Remembered());
  free_.clear();
  in_table_ = 0;
  for (Set number = static_cast<Set>(nodes_.size()); number-- > 2;) {
    if (!is_marked_[number]) {
      free_.push_back(number);
      continue;
    }
    add_to_table(number);
    ++in_table_;
  }
  most_before_collection_ = std::max(most_before_collection_, nodes() * 2);
}

}  // namespace cbc
