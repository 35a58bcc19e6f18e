// Rules about situation variables.

#include "core/diagnostic/rules.h"

namespace cbc::rule {

const Rule duplicate_situation = {
    .name = "duplicate-situation",
    .severity = Severity::error,
    .is_fixed = true,
    .summary = "A situation variable is declared twice, or has the name of a behavior.",
    .explanation =
        "An event 'situation' names variables and behaviors in the same place, so each name must "
        "mean one thing. Of two declarations with the same name it is not clear which values the "
        "variable has.",
    .example = R"(behaviors:
- behavior: FOLLOW_WITH_CAMERA
  task: FOLLOW
  situation: {LIGHT: day}
tasks:
- task: FOLLOW
situation:
- variable: LIGHT
  values: [day, night]
- variable: LIGHT
  values: [day, dusk, night]
)",
    .mending = "Keep one declaration, with all values, or rename the variable.",
    .mended = R"(behaviors:
- behavior: FOLLOW_WITH_CAMERA
  task: FOLLOW
  situation: {LIGHT: day}
tasks:
- task: FOLLOW
situation:
- variable: LIGHT
  values: [day, dusk, night]
)",
};

const Rule situation_value = {
    .name = "situation-value",
    .severity = Severity::error,
    .is_fixed = true,
    .summary = "A situation variable has no such value, or its values cannot be told apart.",
    .explanation =
        "A variable has two values or more, each once. A behavior, an event or a condition names "
        "one of them (a behavior also a list of some). Values are texts as they are written: 'on' "
        "is not true, "
        "and 1.0 is not 1. Only a variable that is declared without values is true or false.\n\n"
        "A behavior with an empty list of values would never fit.",
    .example = R"(behaviors:
- behavior: FOLLOW_WITH_CAMERA
  task: FOLLOW
  situation: {LIGHT: dya}
tasks:
- task: FOLLOW
situation:
- variable: LIGHT
  values: [day, night]
)",
    .mending = "Correct the value, or add it to the declaration of the variable.",
    .mended = R"(behaviors:
- behavior: FOLLOW_WITH_CAMERA
  task: FOLLOW
  situation: {LIGHT: day}
tasks:
- task: FOLLOW
situation:
- variable: LIGHT
  values: [day, night]
)",
};

const Rule undeclared_situation = {
    .name = "undeclared-situation",
    .severity = Severity::error,
    .is_fixed = true,
    .summary =
        "A behavior, an event or a property file names a situation variable that is not declared.",
    .explanation =
        "Situation variables are declared in the section 'situation' of the catalog, with their "
        "values. Without a declaration it is not known what the initial value is, and a "
        "misspelled name would go unnoticed.",
    .example = R"(behaviors:
- behavior: FOLLOW_WITH_CAMERA
  task: FOLLOW
  situation: {LIGTH: day}
- behavior: FOLLOW_WITH_LIDAR
  task: FOLLOW
  suitability: 80
  situation: {LIGHT: night}
tasks:
- task: FOLLOW
situation:
- variable: LIGHT
  values: [day, night]
)",
    .mending = "Correct the name, or declare the variable.",
    .mended = R"(behaviors:
- behavior: FOLLOW_WITH_CAMERA
  task: FOLLOW
  situation: {LIGHT: day}
- behavior: FOLLOW_WITH_LIDAR
  task: FOLLOW
  suitability: 80
  situation: {LIGHT: night}
tasks:
- task: FOLLOW
situation:
- variable: LIGHT
  values: [day, night]
)",
};

const Rule unused_situation = {
    .name = "unused-situation",
    .severity = Severity::warning,
    .summary = "A situation variable, or a condition on one, has no effect.",
    .explanation =
        "A variable that no behavior names changes nothing, whatever its value is. A behavior that "
        "names all the values of a variable fits in any of them, and one value twice is the same "
        "as "
        "once. All of these are often left over from an earlier version of the catalog.",
    .example = R"(behaviors:
- behavior: FOLLOW_WITH_CAMERA
  task: FOLLOW
tasks:
- task: FOLLOW
situation:
- variable: LIGHT
  values: [day, night]
)",
    .mending =
        "Add the condition to the behaviors that depend on it, or remove the variable or the "
        "condition.",
    .mended = R"(behaviors:
- behavior: FOLLOW_WITH_CAMERA
  task: FOLLOW
  situation: {LIGHT: day}
tasks:
- task: FOLLOW
situation:
- variable: LIGHT
  values: [day, night]
)",
};

}  // namespace cbc::rule
