#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/catalog/name_place.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"

/// Reads catalogs.
namespace cbc {

/// The name of a required or excluded task that no task has.
struct UndefinedTask {
  std::string name;
  Range range;
  std::optional<BehaviorIndex> behavior;  ///< that requires it; empty: an exclusivity list has it
  Millionths minimum_performance = 0;     ///< of the requirement; 0: none
  std::size_t list = 0;                   ///< place in Catalog::exclusivity, if one has it
};

/// A place where a suitability or a minimum performance stands.
struct NumberPlace {
  enum class Kind : std::uint8_t { suitability, minimum_performance };
  Kind kind = Kind::suitability;
  bool is_default = false;  ///< a suitability among the default values
  Millionths value = 0;
  Range range;  ///< of the scalar
};

/// The key of the catalog.
[[nodiscard]] constexpr std::string_view name_of(NumberPlace::Kind kind) {
  return kind == NumberPlace::Kind::suitability ? "suitability" : "minimum_performance";
}

/// What could be made of a catalog.
struct CatalogReading {
  /// As far as it was understood.
  Catalog catalog;
  /// The names in requirements and exclusivity lists that it leaves out.
  std::vector<UndefinedTask> undefined_tasks;
  /// Every place where a name stands, whatever became of the entry that has it.
  std::vector<NamePlace> names;
  /// Every suitability and minimum performance, whether something has it or another one counts. An
  /// alias repeats its place.
  std::vector<NumberPlace> numbers;
  /// Whether all of it was understood, though it may break rules about its meaning.
  bool is_complete = false;
  /// Whether all entries and names were understood. Values may be missing, and then exclude
  /// nothing.
  bool has_all_names = false;
  /// Whether all behaviors were understood, except that named ones may lack their tasks.
  bool has_all_behaviors = false;
  /// Whether its requirements have no cycle.
  bool is_acyclic = false;
};

/// Understands as much of a catalog as possible. All problems of the text are reported into
/// `diagnostics` at once.
[[nodiscard]] CatalogReading understand_catalog(const yaml::Document& document,
                                                Diagnostics& diagnostics);

/// Understands a catalog. All problems of the text are reported into `diagnostics` at once; the
/// result is empty if one of them is an error.
[[nodiscard]] std::optional<Catalog> read_catalog(const yaml::Document& document,
                                                  Diagnostics& diagnostics);

/// The same from YAML text. `file` is the name used in messages.
[[nodiscard]] std::optional<Catalog> read_catalog(std::string_view text, std::string file,
                                                  Diagnostics& diagnostics);

}  // namespace cbc
