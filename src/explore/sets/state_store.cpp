#include "explore/sets/state_store.h"

#include <algorithm>

namespace cbc {

StateStore::StateStore(std::size_t words)
    : words_(words), buckets_(64), bucket_mask_(buckets_.size() - 1) {}

std::uint64_t StateStore::hash(const std::uint32_t* state) const {
  constexpr std::uint64_t factor = 0x9e3779b97f4a7c15U;
  std::uint64_t hash = 0;
  for (std::size_t word = 0; word < words_; ++word) {
    hash = (hash ^ state[word]) * factor;
    hash ^= hash >> 32U;
  }
  return hash * factor ^ hash >> 29U;
}

StateStore::Number StateStore::find(const std::uint32_t* state, std::uint64_t hash,
                                    std::size_t& bucket) const {
  const std::uint8_t tag = tag_of(hash);
  for (bucket = hash & bucket_mask_;; bucket = (bucket + 1) & bucket_mask_) {
    const Bucket& here = buckets_[bucket];
    for (std::uint32_t entry = 0; entry < here.count; ++entry) {
      if (here.tags[entry] == tag && is_same(here.numbers[entry], state))
        return here.numbers[entry];
    }
    if (here.count < bucket_size) return size_;
  }
}

std::optional<StateStore::Number> StateStore::find(const std::uint32_t* state,
                                                   std::uint64_t hash) const {
  std::size_t bucket = 0;
  const Number number = find(state, hash, bucket);
  return number == size_ ? std::nullopt : std::optional(number);
}

StateStore::Number StateStore::insert(const std::uint32_t* state, std::uint64_t hash) {
  std::size_t bucket = 0;
  const Number number = find(state, hash, bucket);
  if (number != size_) return number;
  const std::size_t offset = size_ % segment;
  if (offset == 0) {
    states_.emplace_back(new std::uint32_t[segment * words_]);  // not set to zero
  }
  std::copy_n(state, words_, states_.back().get() + offset * words_);
  add_to_bucket(bucket, hash, size_++);
  if (is_crowded(size_, buckets_.size())) grow();
  return number;
}

void StateStore::add_to_bucket(std::size_t place, std::uint64_t hash, Number number) {
  Bucket& bucket = buckets_[place];
  bucket.tags[bucket.count] = tag_of(hash);
  bucket.numbers[bucket.count] = number;
  ++bucket.count;
}

void StateStore::grow() {
  const std::size_t count = buckets_.size() * 2;
  buckets_ = {};
  buckets_.resize(count);
  bucket_mask_ = count - 1;
  constexpr Number ahead = 16;
  std::uint64_t hashes[ahead] = {};
  for (Number number = 0; number < size_ + ahead; ++number) {
    // A few states ahead, so that memory has time to answer.
    const Number ready = number - ahead;
    if (number >= ahead && ready < size_) {
      std::size_t place = hashes[ready % ahead] & bucket_mask_;
      while (buckets_[place].count == bucket_size) place = (place + 1) & bucket_mask_;
      add_to_bucket(place, hashes[ready % ahead], ready);
    }
    if (number >= size_) continue;
    hashes[number % ahead] = hash(state(number));
    __builtin_prefetch(&buckets_[hashes[number % ahead] & bucket_mask_]);
  }
}

}  // namespace cbc
