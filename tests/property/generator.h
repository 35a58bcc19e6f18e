// Random catalogs and scripts. The same seed gives the same case, on any machine.
#pragma once

#include <cstddef>
#include <cstdint>

#include "model.h"
#include "random.h"

namespace cbc::oracle {

struct Case {
  Catalog catalog;
  Script script;
};

// The catalog has no finding of severity error; the product of the domain sizes of each of its
// groups is small enough to be enumerated. The script is made with the oracle at hand, so that most
// of its events do something.
Case generate_case(Random& random);
Case generate_case(std::uint64_t seed);

// All times of a case are multiples of one of these, so that many things fall due together.
Microseconds pick_time_unit(Random& random);

Catalog generate_catalog(Random& random);
// With at least one task, and as many as given.
Catalog generate_catalog(Random& random, std::size_t tasks);
// Keys of the third edition of the definition, for a catalog without any.
void add_further_keys(Random& random, Catalog& catalog);
Case generate_case_with_keys(std::uint64_t seed);
Script generate_script(Random& random, const Catalog& catalog);

}  // namespace cbc::oracle
