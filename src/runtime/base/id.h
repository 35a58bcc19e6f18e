#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace cbc {

/// Stands where there is no number: it converts to each kind of id, and to a plain number.
struct None {
  constexpr operator std::uint32_t() const { return UINT32_MAX; }  // NOLINT: as a number
};
inline constexpr None none;

/// A number that counts things of one kind. It can be used wherever a number can, and lies in
/// memory as one. But no number becomes an id without its name, and one kind of id never becomes
/// another: the compiler rejects both, and the comparison of two kinds.
template <typename Kind>
class Id {
 public:
  constexpr Id() = default;
  constexpr Id(None /*none*/) : number_(none) {}  // NOLINT: as a number
  template <std::integral Number>
  constexpr explicit Id(Number number) : number_(static_cast<std::uint32_t>(number)) {}

  constexpr operator std::uint32_t() const { return number_; }  // NOLINT: as a number
  constexpr Id& operator++() {
    ++number_;
    return *this;
  }

  friend constexpr bool operator==(Id a, Id b) = default;
  friend constexpr auto operator<=>(Id a, Id b) = default;
  /// In the texts of fmt, from its version 10 on.
  friend constexpr std::uint32_t format_as(Id id) { return id.number_; }

 private:
  std::uint32_t number_ = 0;
};

template <typename A, typename B>
bool operator==(Id<A> a, Id<B> b) = delete;
template <typename A, typename B>
std::strong_ordering operator<=>(Id<A> a, Id<B> b) = delete;

}  // namespace cbc

template <typename Kind>
struct std::hash<cbc::Id<Kind>> {
  std::size_t operator()(cbc::Id<Kind> id) const noexcept { return std::hash<std::uint32_t>()(id); }
};
