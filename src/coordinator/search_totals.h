#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "coordinator/record.h"

namespace cbc {

/// Sum, least and greatest of some numbers.
struct Spread {
  std::uint64_t sum = 0;
  std::uint64_t least = UINT64_MAX;
  std::uint64_t greatest = 0;

  void add(std::uint64_t number) { merge({number, number, number}); }
  void merge(const Spread& other) {
    sum += other.sum;
    least = std::min(least, other.least);
    greatest = std::max(greatest, other.greatest);
  }
};

/// What the searches of some events took.
struct SearchEffort {
  std::uint64_t events = 0;
  Spread solutions;
  Spread nodes;
  Spread propagations;
  Spread nanoseconds;

  void merge(const SearchEffort& other);
};

/// What the searches of a run took, or of several: by kind of event, and of all. Events that were
/// not searched for count nowhere.
class SearchTotals {
 public:
  struct Kind {
    Verb verb = Verb::wait;
    Origin origin = Origin::script;
  };
  /// The kinds of events that may be searched for.
  static constexpr std::array<Kind, 6> kinds{{{Verb::start, Origin::script},
                                              {Verb::stop, Origin::script},
                                              {Verb::finish, Origin::script},
                                              {Verb::finish, Origin::timeout},
                                              {Verb::finish, Origin::fault},
                                              {Verb::start, Origin::reactive}}};

  /// An event whose time was measured, if it was searched for.
  void add(const EventRecord& record);
  void merge(const SearchTotals& other);

  [[nodiscard]] const SearchEffort& all() const { return all_; }
  /// Of one of the kinds, by its place.
  [[nodiscard]] const SearchEffort& of_kind(std::size_t kind) const { return by_kind_[kind]; }

 private:
  SearchEffort all_;
  std::array<SearchEffort, kinds.size()> by_kind_;
};

}  // namespace cbc
