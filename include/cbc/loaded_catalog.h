#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "cbc/event.h"

namespace cbc {

struct CatalogLoading;

/// A compiled catalog, as `cbc compile` writes it.
///
/// Its tasks and its behaviors have catalog indices: they are numbered from 0 in the order in which
/// the source first names them.
///
/// A loaded catalog never changes, so any number of threads and coordinators may use it. Copies are
/// cheap and share the content, which stays in memory as long as a copy or a coordinator uses it.
/// All functions accept any argument; the only exception thrown is std::bad_alloc.
class LoadedCatalog {
 public:
  /// Maps a file into memory and verifies all of it. The file may be replaced while it is in use
  /// (`cbc compile` does that), but must not be overwritten in place.
  [[nodiscard]] static CatalogLoading load(const std::string& path);

  // Moving copies, so that an object always holds a catalog.
  LoadedCatalog(const LoadedCatalog&) = default;
  LoadedCatalog& operator=(const LoadedCatalog&) = default;
  ~LoadedCatalog() = default;

  [[nodiscard]] std::size_t task_count() const;
  [[nodiscard]] std::size_t behavior_count() const;

  /// The name of a task or behavior; empty if there is no such index. Valid as long as the catalog
  /// is in memory.
  [[nodiscard]] std::string_view task_name(std::uint32_t index) const;
  [[nodiscard]] std::string_view behavior_name(std::uint32_t index) const;

  /// The catalog index of the task or behavior of this name; none if there is none. Takes time
  /// logarithmic in the size of the catalog.
  [[nodiscard]] std::optional<std::uint32_t> find_task(std::string_view name) const;
  [[nodiscard]] std::optional<std::uint32_t> find_behavior(std::string_view name) const;

  // Situation variables and their values are numbered in the order in which the source declares
  // them. A variable declared without values has "true" and "false".

  [[nodiscard]] std::size_t variable_count() const;
  /// The number of values of a variable; 0 if there is no such variable.
  [[nodiscard]] std::size_t value_count(std::uint32_t variable) const;
  /// The names of a variable and of a value; empty if there is none.
  [[nodiscard]] std::string_view variable_name(std::uint32_t variable) const;
  [[nodiscard]] std::string_view value_name(VariableValue value) const;
  /// Take time linear in the number of variables, of values.
  [[nodiscard]] std::optional<std::uint32_t> find_variable(std::string_view name) const;
  [[nodiscard]] std::optional<std::uint32_t> find_value(std::uint32_t variable,
                                                        std::string_view name) const;

 private:
  friend class LiveCoordinator;
  struct Content;

  explicit LoadedCatalog(std::shared_ptr<const Content> content);

  std::shared_ptr<const Content> content_;
};

/// A catalog, or why there is none.
struct CatalogLoading {
  std::optional<LoadedCatalog> catalog;
  std::string error;  ///< for people, without the path; empty if there is a catalog
};

}  // namespace cbc
