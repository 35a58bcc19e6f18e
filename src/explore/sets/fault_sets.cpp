#include "explore/sets/fault_sets.h"

#include <algorithm>
#include <utility>

namespace cbc {

FaultSets::FaultSets(Diagrams& sets, const std::vector<std::uint32_t>& kinds, std::uint32_t most,
                     bool has_repairs)
    : sets_(sets),
      kinds_(kinds),
      most_(std::min(most, static_cast<std::uint32_t>(kinds.size()))),
      has_repairs_(has_repairs),
      first_bit_(sets.bits() - static_cast<std::uint32_t>(kinds.size())) {
  exactly_.assign(most_ + 1, Diagrams::empty);
  exactly_[0] = Diagrams::all;
  for (std::uint32_t fault = this->count(); fault-- > 0;) {
    const Set faulty = sets_.with(bit_of(fault), true);
    for (std::uint32_t count = most_ + 1; count-- > 0;) {
      const Set one_more = count > 0 ? sets_.both(exactly_[count - 1], faulty) : Diagrams::empty;
      exactly_[count] = sets_.either(sets_.without(exactly_[count], faulty), one_more);
    }
  }
  for (std::uint32_t count = 0; count < most_; ++count) {
    room_ = sets_.either(room_, exactly_[count]);
  }
  std::vector<bool> all_bits(sets_.bits(), false);
  std::vector<std::vector<bool>> bits;
  for (const std::uint32_t kind : kinds_) {
    if (kind >= bits.size()) bits.resize(kind + std::size_t{1}, all_bits);
  }
  for (std::uint32_t fault = 0; fault < kinds_.size(); ++fault) {
    all_bits[bit_of(fault)] = true;
    bits[kinds_[fault]][bit_of(fault)] = true;
  }
  if (has_repairs) {
    for (std::vector<bool>& of_kind : bits) {
      faults_of_kind_.push_back(sets_.keep_bits(std::move(of_kind)));
    }
  }
  all_faults_ = sets_.keep_bits(std::move(all_bits));
}

FaultSets::Set FaultSets::after_fault(Set set) {
  return sets_.one_changed(sets_.both(set, room_), all_faults_, true);
}
FaultSets::Set FaultSets::before_fault(Set set) {
  return sets_.both(sets_.one_changed(set, all_faults_, false), room_);
}
FaultSets::Set FaultSets::after_repair(std::uint32_t kind, Set set) {
  return sets_.one_changed(set, faults_of_kind_[kind], false);
}
FaultSets::Set FaultSets::before_repair(std::uint32_t kind, Set set) {
  return sets_.one_changed(set, faults_of_kind_[kind], true);
}

std::uint64_t FaultSets::count_moves(Set set) {
  std::uint64_t moves = 0;
  for (std::uint32_t faults = 0; faults <= most_; ++faults) {
    const std::uint32_t of_each =
        (has_repairs_ ? faults : 0) + (faults < most_ ? count() - faults : 0);
    moves += sets_.count(sets_.both(set, exactly_[faults])) * of_each;
  }
  return moves;
}

}  // namespace cbc
