#pragma once

#include <cstddef>
#include <cstdlib>
#include <fcntl.h>
#include <span>
#include <sys/mman.h>
#include <sys/stat.h>
#include <type_traits>
#include <unistd.h>

// What mutated sources call (tests/mutants/points.py says where). Each mutant has a number; that in
// the environment variable CBC_MUTANT is active, and all other places do what the source says. The
// file in CBC_MUTANTS_REACHED, if there is one, has a byte for each mutant, which becomes 1 when
// its place is reached; the processes of a test share it. In constant expressions no mutant is
// active.
namespace cbc::mutant {

using Number = unsigned;

inline Number read_active() {
  const char* const text = std::getenv("CBC_MUTANT");
  return text == nullptr ? 0 : static_cast<Number>(std::strtoul(text, nullptr, 10));
}

/// The bytes of that file.
inline std::span<unsigned char> map_reached() {
  const char* const path = std::getenv("CBC_MUTANTS_REACHED");
  if (path == nullptr) return {};
  const int file = open(path, O_RDWR | O_CLOEXEC);
  struct stat status {};
  if (file < 0 || fstat(file, &status) != 0) std::abort();
  const auto size = static_cast<std::size_t>(status.st_size);
  void* const bytes = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  if (bytes == MAP_FAILED) std::abort();
  return {static_cast<unsigned char*>(bytes), size};
}

inline const Number active = read_active();
inline unsigned char* const reached = map_reached().data();

[[gnu::always_inline]] constexpr bool is_on(Number number) {
  if (std::is_constant_evaluated()) return false;
  if (reached != nullptr) [[unlikely]] {
    // Threads may write the same.
    __atomic_store_n(reached + number, static_cast<unsigned char>(1), __ATOMIC_RELAXED);
  }
  return active == number;
}

/// A literal. The numbers of its mutants begin at `number`.
template <typename T>
[[gnu::always_inline]] constexpr T constant(Number /*number*/, T value) {
  return value;
}
template <typename T, typename Other, typename... Others>
[[gnu::always_inline]] constexpr T constant(Number number, T value, Other other, Others... others) {
  if (is_on(number)) return static_cast<T>(other);
  return constant(number + 1, value, others...);
}

/// An operator with its operands; the others are what its mutants do instead.
template <typename A, typename B, typename Operation>
[[gnu::always_inline]] constexpr auto apply(Number /*number*/, const A& a, const B& b,
                                            Operation operation) {
  return operation(a, b);
}
template <typename A, typename B, typename Operation, typename Other, typename... Others>
[[gnu::always_inline]] constexpr auto apply(Number number, const A& a, const B& b,
                                            Operation operation, Other other, Others... others) {
  if (is_on(number)) return static_cast<decltype(operation(a, b))>(other(a, b));
  return apply(number + 1, a, b, operation, others...);
}

/// `a += b`, or what `other` does.
template <typename A, typename B, typename Operation, typename Other>
[[gnu::always_inline]] constexpr A& assign(Number number, A& a, const B& b, Operation operation,
                                           Other other) {
  is_on(number) ? other(a, b) : operation(a, b);
  return a;
}

/// A condition, or its negation.
[[gnu::always_inline]] constexpr bool truth(Number number, bool value) {
  return is_on(number) ? !value : value;
}

// `a && b` becomes `(ends_and(n, a) ? is_on(n) : b)`, and `a || b` `(ends_or(n, a) ? !is_on(n) :
// b)`.
[[gnu::always_inline]] constexpr bool ends_and(Number number, bool value) {
  return is_on(number) ? value : !value;
}
[[gnu::always_inline]] constexpr bool ends_or(Number number, bool value) {
  return is_on(number) ? !value : value;
}

}  // namespace cbc::mutant

// NOLINTBEGIN(cppcoreguidelines-macro-usage): operators cannot be passed in another way.
#define CBC_OPERATION(op) \
  [](const auto& a, const auto& b) __attribute__((always_inline)) { return a op b; }
#define CBC_SWAPPED(op) \
  [](const auto& a, const auto& b) __attribute__((always_inline)) { return b op a; }
#define CBC_ASSIGNMENT(op) \
  [](auto& a, const auto& b) __attribute__((always_inline)) { a op b; }
// NOLINTEND(cppcoreguidelines-macro-usage)
