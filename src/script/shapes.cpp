#include "script/shapes.h"

namespace cbc::shape {
namespace {

using yaml::Key;
using yaml::Shape;

constexpr Key script_keys[] = {{"catalog"}, {"reactive_delay"}, {"situation"}, {"events"}};
constexpr Key event_keys[] = {{"start"}, {"stop"},     {"finish"},     {"situation"},
                              {"fault"}, {"repair"},   {"expect"},     {"at"},
                              {"wait"},  {"priority"}, {"parameters"}, {"cause"}};
constexpr Key expectation_keys[] = {{"outcome"}, {"running"}, {"stopped"}, {"active"}};

constexpr const Shape* in_event[] = {&expectation};

}  // namespace

const Shape script{"a script", script_keys};
const Shape event{"an event", event_keys, nullptr, in_event};
const Shape expectation{"an expect", expectation_keys, &event};

}  // namespace cbc::shape
