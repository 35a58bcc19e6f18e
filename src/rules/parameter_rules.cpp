#include "rules/topics.h"

namespace cbc {
namespace {

constexpr Rule parameter_table[] = {
    {.name = rule::duplicate_parameter,
     .severity = Severity::warning,
     .summary = "A parameter is listed twice in one task.",
     .explanation =
         "Two entries of one name say twice what the parameter may be, perhaps differently. Often "
         "the second one was copied, and not renamed: then the parameter that it was to be is not "
         "declared, and a request that gives it breaks undeclared-parameter.",
     .example = R"(behaviors:
- behavior: ROTATE_WITH_PID
  task: ROTATE
tasks:
- task: ROTATE
  parameters:
  - parameter: angle
    allowed_values: [-360, 360]
  - parameter: angle
    allowed_values: [0, 90]
)",
     .mending = "Give the second entry the name that is meant, or remove one of the two.",
     .mended = R"(behaviors:
- behavior: ROTATE_WITH_PID
  task: ROTATE
tasks:
- task: ROTATE
  parameters:
  - parameter: angle
    allowed_values: [-360, 360]
  - parameter: speed
    allowed_values: [0, 90]
)"},

    {.name = rule::empty_range,
     .severity = Severity::warning,
     .summary = "A range of allowed values contains nothing.",
     .explanation =
         "Two numbers as allowed_values are a range: from the first to the second, both of them "
         "included. Here the first is the greater one, so that no value is allowed, and every "
         "request that gives the parameter breaks parameter-value.",
     .example = R"(behaviors:
- behavior: ROTATE_WITH_PID
  task: ROTATE
tasks:
- task: ROTATE
  parameters:
  - parameter: angle
    allowed_values: [360, -360]
)",
     .mending = "Give the lowest value first.",
     .mended = R"(behaviors:
- behavior: ROTATE_WITH_PID
  task: ROTATE
tasks:
- task: ROTATE
  parameters:
  - parameter: angle
    allowed_values: [-360, 360]
)"},

    {.name = rule::unknown_type,
     .severity = Severity::note,
     .summary = "Allowed values are given as a type that is not known.",
     .explanation =
         "allowed_values is a range of numbers, a list of words, or a single word, which is the "
         "name of a type. The types that cbc knows are string, boolean, integer, number and point, "
         "and lists of them, such as list_of_strings and point_list. With any other name every "
         "value is accepted, as there is nothing to check it against; the robot may still refuse "
         "it.",
     .example = R"(behaviors:
- behavior: SPEAK_WITH_LOUDSPEAKER
  task: SPEAK
tasks:
- task: SPEAK
  parameters:
  - parameter: message
    allowed_values: sentence
)",
     .mending =
         "Name a known type. A single allowed word is written as a list, in brackets. If the type "
         "is one of your own, keep it and allow the rule there.",
     .mended = R"(behaviors:
- behavior: SPEAK_WITH_LOUDSPEAKER
  task: SPEAK
tasks:
- task: SPEAK
  parameters:
  - parameter: message
    allowed_values: string
)"},
};

}  // namespace

std::span<const Rule> parameter_rules() { return parameter_table; }

}  // namespace cbc
