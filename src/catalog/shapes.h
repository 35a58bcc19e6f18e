#pragma once

#include "yaml/fields.h"

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

}  // namespace cbc::shape
