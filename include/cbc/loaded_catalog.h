#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace cbc {

struct CatalogLoading;

/// A compiled catalog, as `cbc compile` writes it.
///
/// Its tasks and behaviors are identified by their place in the catalog: they are numbered from 0
/// in the order in which the source first names them.
///
/// A loaded catalog never changes, so any number of threads may use it, and any number of
/// coordinators. Copies are cheap and share it; it stays in memory as long as one of them, or a
/// coordinator on it, is there. All functions accept any argument, and none throws, but for
/// std::bad_alloc when memory runs out.
class LoadedCatalog {
 public:
  /// Maps a file into memory and verifies it, once and as a whole. The file may be replaced while
  /// it is in use (`cbc compile` does that), but must not be written over.
  [[nodiscard]] static CatalogLoading load(const std::string& path);

  // Copied where it could be moved, too, so that there is always a catalog in it.
  LoadedCatalog(const LoadedCatalog&) = default;
  LoadedCatalog& operator=(const LoadedCatalog&) = default;
  ~LoadedCatalog() = default;

  [[nodiscard]] std::size_t task_count() const;
  [[nodiscard]] std::size_t behavior_count() const;

  /// The name of the task, the behavior at a place; empty if there is no such place. It is valid as
  /// long as the catalog is in memory.
  [[nodiscard]] std::string_view task_name(std::uint32_t place) const;
  [[nodiscard]] std::string_view behavior_name(std::uint32_t place) const;

  /// The place of the task, the behavior with this name; none if there is none. Takes time
  /// logarithmic in the size of the catalog.
  [[nodiscard]] std::optional<std::uint32_t> find_task(std::string_view name) const;
  [[nodiscard]] std::optional<std::uint32_t> find_behavior(std::string_view name) const;

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
