#pragma once

#include <optional>

#include "core/yaml/document.h"
#include "core/yaml/values.h"

/// The keys of each kind of mapping in a catalog.
namespace cbc::shape {

extern const yaml::Shape catalog;
extern const yaml::Shape default_values;
extern const yaml::Shape task_defaults;
extern const yaml::Shape behavior_defaults;
extern const yaml::Shape behavior;
extern const yaml::Shape performance;
extern const yaml::Shape requirement;
extern const yaml::Shape task;
extern const yaml::Shape parameter;
extern const yaml::Shape exclusivity_list;
extern const yaml::Shape variable;

}  // namespace cbc::shape

/// How catalogs are told from other YAML files.
namespace cbc {

/// Whether a file is a catalog: it has the key `behaviors`, or two other sections of a catalog with
/// values of the right kinds, or one with entries that no other file has, or it has an older
/// format.
[[nodiscard]] bool is_catalog(const yaml::Node& root);

/// Whether a file would be a catalog but for misspelt keys.
[[nodiscard]] bool resembles_catalog(const yaml::Node& root);

/// Whether a node is a list of behaviors with their tasks, whatever the key is under which it
/// stands.
[[nodiscard]] bool is_list_of_behaviors(const yaml::Node& node);

/// A section of a catalog that does not stand at the top of a file.
struct InnerSection {
  const yaml::Node* key = nullptr;
  const yaml::Node* outer = nullptr;  ///< the key under which it stands; null: a list has it
};
/// The first one whose entries no other file has. Empty if there is none.
[[nodiscard]] std::optional<InnerSection> find_inner_section(const yaml::Node& root);

}  // namespace cbc
