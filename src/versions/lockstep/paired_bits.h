#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "explore/controls/environments.h"
#include "versions/lockstep/same_as_pair.h"

namespace cbc {

/// One string of bits for the environments of two models: variables and own flags that both have
/// are the same bits, and so are the faults that come by a move of both. What only one has never
/// changes, but each has its own X. A variable that has different values at first has a code of its
/// own for that.
struct PairedBits {
  explicit PairedBits(const ModelPair& models);

  EnvironmentBits of_new;
  EnvironmentBits of_old;
  std::vector<std::uint32_t> kinds;  ///< by fault: see FaultSets
  /// By kind: a behavior, as the models count; new, old.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> repaired;

 private:
  void add_variables(const ModelPair& models);
  void add_own_flags(const ModelPair& models);
  void add_failures(const ModelPair& models);
  void add_faults(const ModelPair& models);
};

}  // namespace cbc
