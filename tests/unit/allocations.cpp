#include "unit/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

// Counts the allocations of this program. The operators are not to be inlined, as GCC would then
// see new answered by free.

namespace {

std::atomic<std::uint64_t> count{0};

}  // namespace

// NOLINTBEGIN(cppcoreguidelines-no-malloc): this is what the operators are made of
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++count;
  if (void* const memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  ++count;
  return std::malloc(size == 0 ? 1 : size);
}

[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}
// NOLINTEND(cppcoreguidelines-no-malloc)

namespace cbc::test {

std::uint64_t allocations() { return count; }

}  // namespace cbc::test
