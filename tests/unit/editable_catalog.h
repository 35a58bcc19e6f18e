#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "catalog_generated.h"
#include "core/catalog/catalog.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/compiled/derive.h"

namespace cbc::test {

/// The names of the arrays in the schema, which has two fields before them.
inline constexpr auto first_array_name = flat::Catalog::Traits::field_names.begin() + 2;

/// The arrays of a compiled catalog, to be changed at will.
class EditableCatalog {
 public:
  explicit EditableCatalog(const CompiledCatalog& catalog);

  /// A catalog of copies of the arrays that are as long as they are, so that a sanitizer sees what
  /// reads beyond them. If they have a fault, the catalog has no names.
  [[nodiscard]] CompiledCatalog catalog() const;

  /// A number in the arrays, or a character.
  struct Number {
    std::string_view field;
    void* place = nullptr;
    std::size_t bytes = 0;

    [[nodiscard]] std::uint64_t get() const;
    void set(std::uint64_t value) const;
  };
  /// All of them.
  [[nodiscard]] std::vector<Number> numbers();

  /// Calls visit(name, vector) for each array, with its name in the schema.
  template <typename Visit>
  void for_each_array(Visit visit) {
    const auto* name = first_array_name;
    std::apply([&](auto&... array) { (visit(std::string_view(*name++), array), ...); },
               arrays_of(arrays));
  }

  GrowingCatalog arrays;
};

/// The catalog that the arrays describe, without what they do not say (ranges but for lines).
[[nodiscard]] Catalog describe_compiled(const CompiledCatalog& compiled);

/// An array in which two catalogs differ, or nothing. Texts are compared where they are
/// used: their places do not count.
[[nodiscard]] std::string difference(const CompiledCatalog& a, const CompiledCatalog& b);

}  // namespace cbc::test
