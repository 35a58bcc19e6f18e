#pragma once

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

/// How catalogs are told from other YAML files, and those of an older format that is not supported.
namespace cbc {

/// Whether a file is a catalog: it has the key `behaviors`, or two other sections of a catalog with
/// values of the right kinds, or is one of the older format.
[[nodiscard]] bool is_catalog(const yaml::Node& root);

/// Whether a file would be a catalog but for misspelt keys.
[[nodiscard]] bool resembles_catalog(const yaml::Node& root);

/// The key that shows that a catalog has the format with capabilities, which is older than tasks.
/// Null if it does not.
[[nodiscard]] const yaml::Node* find_older_format(const yaml::Node& root);

}  // namespace cbc
