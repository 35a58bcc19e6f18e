#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "cbc/units.h"
#include "runtime/compiled/compiled_catalog.h"
#include "versions/names/renames.h"

/// What two catalogs do not have in common, as they are written: for pictures and tables of a
/// difference, and for proofs that two catalogs answer alike, in which no event shows some of it.
namespace cbc {

/// What an attribute is set to: nothing, a boolean, a percentage, a time or a text.
using AttributeValue = std::variant<std::monostate, bool, Millionths, Microseconds, std::string>;

/// An attribute that differs between the catalogs, or that only one of them has.
struct AttributeChange {
  /// As the catalog spells it; "parameter NAME" for one of a task, "situation NAME" for the values
  /// of a situation variable in which a behavior fits.
  std::string name;
  AttributeValue before;
  AttributeValue after;
};

/// One difference between two catalogs.
struct CatalogChange {
  enum class Kind : std::uint8_t { removed, added, changed };
  enum class Subject : std::uint8_t {
    task,         ///< `task`
    behavior,     ///< `behavior`
    performs,     ///< `behavior` performs `task`; attribute "suitability"
    requirement,  ///< `behavior` requires `task`; attribute "minimum_performance"
    variable,     ///< situation variable `variable`
    limit,        ///< of the tasks, listed by name in `task`, several may run; attribute "at_most"
    exclusion     ///< `task` excludes `other_task`, whose name comes later
  };
  Kind kind = Kind::changed;
  Subject subject = Subject::task;
  std::string task;
  std::string other_task;
  std::string behavior;
  std::string variable;
  /// Of `changed`, at least one; otherwise all that are set: `before` of removed, `after` of added.
  std::vector<AttributeChange> attributes;
};
using ChangeSubject = CatalogChange::Subject;

[[nodiscard]] std::string_view name_of(CatalogChange::Kind kind);
[[nodiscard]] std::string_view name_of(CatalogChange::Subject subject);

/// A task, behavior or variable that has another name in the newer catalog.
struct NewName {
  CatalogChange::Subject subject = CatalogChange::Subject::task;
  std::string before;
  std::string after;
};

/// The differences between two catalogs, by subject, then by name.
struct CatalogDiff {
  std::vector<NewName> renamed;  ///< all else is told with the new names
  std::vector<CatalogChange> changes;
  /// The number of differing exclusions that are not listed.
  std::uint64_t further_exclusions = 0;

  [[nodiscard]] std::uint64_t size() const {
    return renamed.size() + changes.size() + further_exclusions;
  }
};

/// The number of exclusions that are listed at most: two lists of n tasks may differ in n² of them.
inline constexpr std::size_t most_listed_exclusions = 100'000;

/// Compares the meaning of two catalogs. Names tell what belongs together, but for what was
/// renamed; order, layout, comments, older keys, and how exclusions are put into lists do not
/// count.
[[nodiscard]] CatalogDiff compare_catalogs(const CompiledCatalog& before,
                                           const CompiledCatalog& after,
                                           const Renames& renames = {});

/// What only the older catalog has and what only the newer one has are the same thing with another
/// name if they have the same content: attributes, performances, requirements, exclusivity, and
/// conditions, with each other's new names in them. Of several with the same content none is found.
/// `given` are known to be renamed, and come first.
[[nodiscard]] Renames find_renames(const CompiledCatalog& before, const CompiledCatalog& after,
                                   const Renames& given = {});

/// The behaviors that can perform a task in a value of a situation variable, if these are not the
/// same in both catalogs.
struct FittingChange {
  std::string task;
  std::string variable;
  std::string value;
  /// With their suitabilities, the best first: "GPS 90 %, SLAM 70 %"; "none"; or "no such value".
  std::string before;
  std::string after;
};
/// The changes of tasks and variables that both have, if a behavior of the task names the variable
/// in either catalog.
[[nodiscard]] std::vector<FittingChange> compare_fitting(const CompiledCatalog& before,
                                                         const CompiledCatalog& after,
                                                         const Renames& renames);

/// "5 s"; "any" of an empty text, "none" of nothing.
[[nodiscard]] std::string describe(const AttributeValue& value);
/// An attribute of a difference in words: "timeout 5 s -> 10 s" if it has changed, "timeout 5 s" if
/// only one catalog has it.
[[nodiscard]] std::string describe(const CatalogChange& change, const AttributeChange& attribute);

}  // namespace cbc
