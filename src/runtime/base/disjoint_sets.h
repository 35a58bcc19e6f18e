#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace cbc {

/// The components of an undirected graph, found by union-find: each set is a tree, of which the
/// root is the smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  /// Unites the sets of two members.
  void join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t root_a = find_root(a);
    const std::uint32_t root_b = find_root(b);
    parent_[std::max(root_a, root_b)] = std::min(root_a, root_b);
  }

  /// By member: the number of its set. Sets count from 0 by their smallest member.
  [[nodiscard]] std::vector<std::uint32_t> numbers() const {
    std::vector<std::uint32_t> number(parent_.size());
    std::uint32_t count = 0;
    for (std::uint32_t member = 0; member < parent_.size(); ++member) {
      // A parent is smaller than its children.
      number[member] = parent_[member] == member ? count++ : number[parent_[member]];
    }
    return number;
  }

 private:
  std::uint32_t find_root(std::uint32_t member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }

  std::vector<std::uint32_t> parent_;
};

}  // namespace cbc
