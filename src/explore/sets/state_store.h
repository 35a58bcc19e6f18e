#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace cbc {

/// What an exploration has found, states or controls, numbered in the order in which they were
/// found. Each is the same number of 32-bit words.
///
/// The index is a hash table of buckets of one cache line: of each of up to 12 states, 8 bits of
/// its hash and its number. A full bucket overflows into the next.
class StateStore {
 public:
  using Number = std::uint32_t;

  explicit StateStore(std::size_t words);

  [[nodiscard]] Number size() const { return size_; }
  [[nodiscard]] std::size_t words() const { return words_; }
  [[nodiscard]] const std::uint32_t* state(Number number) const {
    return states_[number / segment].get() + (number % segment) * words_;
  }
  [[nodiscard]] std::uint64_t bytes() const {
    return states_.size() * segment * words_ * sizeof(std::uint32_t) +
           buckets_.size() * sizeof(Bucket);
  }

  [[nodiscard]] std::uint64_t hash(const std::uint32_t* state) const;
  /// The number of the state, if it is known.
  [[nodiscard]] std::optional<Number> find(const std::uint32_t* state, std::uint64_t hash) const;
  /// The number of the state, which is added if it is new.
  Number insert(const std::uint32_t* state, std::uint64_t hash);

 private:
  static constexpr std::size_t segment = std::size_t{1} << 16U;
  static constexpr std::size_t bucket_size = 12;

  struct alignas(64) Bucket {
    std::uint8_t tags[bucket_size] = {};
    std::uint32_t count = 0;
    Number numbers[bucket_size] = {};
  };
  static_assert(sizeof(Bucket) == 64);

  [[nodiscard]] static std::uint8_t tag_of(std::uint64_t hash) {
    return static_cast<std::uint8_t>(hash >> 56U);
  }
  [[nodiscard]] bool is_same(Number number, const std::uint32_t* other) const {
    return std::equal(other, other + words_, state(number));
  }
  /// The number of the state, or size(); and the bucket that it is in, or belongs into.
  [[nodiscard]] Number find(const std::uint32_t* state, std::uint64_t hash,
                            std::size_t& bucket) const;
  void add_to_bucket(std::size_t place, std::uint64_t hash, Number number);
  /// At most 5 of 6 places are taken, so that few buckets overflow.
  [[nodiscard]] static bool is_crowded(std::uint64_t states, std::size_t buckets) {
    return states > buckets * (bucket_size - 2);
  }
  void grow();

  const std::size_t words_;
  Number size_ = 0;
  std::vector<std::unique_ptr<std::uint32_t[]>> states_;
  std::vector<Bucket> buckets_;
  std::size_t bucket_mask_ = 0;
};

}  // namespace cbc
