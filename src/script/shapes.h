#pragma once

#include "yaml/fields.h"

/// The keys of each kind of mapping in a script.
namespace cbc::shape {

extern const yaml::Shape script;
extern const yaml::Shape event;
extern const yaml::Shape expectation;

}  // namespace cbc::shape
