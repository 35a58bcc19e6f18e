#include "rules/topics.h"

namespace cbc {
namespace {

constexpr Rule file_table[] = {
    {.name = rule::yaml_syntax,
     .severity = Severity::error,
     .is_fixed = true,
     .summary = "The file is not one valid YAML document.",
     .explanation =
         "What is not YAML cannot be understood at all: this is the only finding about the file, "
         "and it is neither compiled nor solved. The finding stands where reading had to stop. The "
         "mistake may be a little before that place: an indentation that differs from that of the "
         "line above, a bracket or a quote that is not closed, a tab that indents, a text with ': "
         "' in it that is not in quotes.\n\n"
         "The rule also covers a text that is not UTF-8 or has control characters, a second "
         "document in the file, tags of other programs, lists and mappings that are nested too "
         "deeply, and aliases that stand for too many values.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
 suitability: 90
tasks:
- task: HOVER
)",
     .mending =
         "Look at the place of the finding and at the lines just above it. Give all keys of one "
         "mapping the same indentation, indent with spaces, and close what was opened.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 90
tasks:
- task: HOVER
)"},

    {.name = rule::unknown_key,
     .severity = Severity::warning,
     .summary = "A key has no meaning where it stands.",
     .explanation =
         "What an unknown key says has no effect. With a misspelt 'suitability' a behavior has the "
         "default one; with a misspelt 'requires' it requires nothing, and the coordinator runs it "
         "without what it needs. The message gives the key that is probably meant, or the level of "
         "the file at which the key belongs.\n\n"
         "In a catalog this is a warning, in an event script an error that settings cannot change. "
         "Keys that begin with 'x-' "
         "are the user's own, and are ignored. Where a key that must be there is misspelt, the "
         "finding is missing-key.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitabilty: 80
tasks:
- task: HOVER
)",
     .mending = "Correct the key, move it to where it belongs, or remove it. Let a key for another "
                "program begin with 'x-'.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 80
tasks:
- task: HOVER
)"},

    {.name = rule::missing_key,
     .severity = Severity::error,
     .is_fixed = true,
     .summary = "A mapping lacks a key that it must have.",
     .explanation =
         "A catalog must have 'behaviors'; a behavior its name, 'behavior', and 'task' or 'tasks'; "
         "a task, a requirement and each task of a behavior 'task'; a parameter 'parameter'; an "
         "exclusivity constraint 'mutually_exclusive'. A script must have 'events', unless it is "
         "just a list of events, and an event must have a verb or a time.\n\n"
         "A key with a null value is as if it were absent. A key that resembles the missing one is "
         "taken in its place, so that the rest can be checked; the message then names both. As "
         "nothing else can stand for what is missing, such a file is neither compiled nor solved.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  package: motion_control
tasks:
- task: HOVER
)",
     .mending = "Add the key, or correct the one that is misspelt.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  package: motion_control
  task: HOVER
tasks:
- task: HOVER
)"},

    {.name = rule::wrong_type,
     .severity = Severity::error,
     .is_fixed = true,
     .summary = "A value is of another type than its key takes.",
     .explanation =
         "A list, a mapping, a number, a boolean or a text stands where something else is "
         "expected; the message says what. Often it is a name where a list is expected, a bare "
         "name in the place of 'task: NAME', a number with a unit ('90 %', '15 s'), or a number or "
         "a boolean in quotes, which make it a text.\n\n"
         "cbc does not guess what is meant: such a file is neither compiled nor solved.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  requires: LOCALIZE
- behavior: GPS
  task: LOCALIZE
tasks:
- task: HOVER
- task: LOCALIZE
  execution_goal: keep_running
  start_on_request: FALSE
)",
     .mending = "Write the value as the message says.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  requires:
  - task: LOCALIZE
- behavior: GPS
  task: LOCALIZE
tasks:
- task: HOVER
- task: LOCALIZE
  execution_goal: keep_running
  start_on_request: FALSE
)"},

    {.name = rule::invalid_value,
     .severity = Severity::error,
     .is_fixed = true,
     .summary = "A value is of the right type, but not one that is allowed.",
     .explanation =
         "Percentages go from 0 to 100 and have at most four decimals. Times are in seconds and "
         "have at most six, and a timeout is over 0. execution_goal is achieve_goal or "
         "keep_running. A name is not empty, and a behavior performs at least one task, each of "
         "them once. In a script, an event has one verb and not both 'at' and 'wait', a priority "
         "is an integer, at least 1 for a start and 0 for a stop, and causes and outcomes are "
         "known words.\n\n"
         "A value is never rounded or cut to an allowed one, since the file would then mean "
         "something that nobody wrote: it is neither compiled nor solved.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 120
tasks:
- task: HOVER
)",
     .mending = "Give one of the values that the message names.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 100
tasks:
- task: HOVER
)"},

    {.name = rule::duplicate_key,
     .severity = Severity::error,
     .is_fixed = true,
     .summary = "A key is given twice in one mapping.",
     .explanation =
         "Programs that read YAML differ in which of the two values they take, so what the file "
         "means is unclear, and it is neither compiled nor solved.\n\n"
         "An older name and the name that replaced it are one key given twice, and so are 'task' "
         "and 'tasks' of a behavior. default_values may be written as lists of mappings, which "
         "count as one mapping.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 90
  suitability: 80
tasks:
- task: HOVER
)",
     .mending =
         "Remove the one that is not meant. If the second was to begin another entry of a list, "
         "the '- ' before it is missing.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 80
tasks:
- task: HOVER
)"},

    {.name = rule::deprecated_key,
     .severity = Severity::warning,
     .summary = "A key has an older name.",
     .explanation =
         "Catalogs for earlier versions of the coordinator have other names for some keys. cbc "
         "understands them, but a reader of the catalog has to know both. 'efficacy' is now "
         "'suitability'; 'default' is 'reactive_start'; 'category: goal_based' is 'execution_goal: "
         "achieve_goal', and 'category: recurrent' is 'execution_goal: keep_running'; "
         "'automatic_activation' is the opposite of 'start_on_request', so TRUE becomes FALSE.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  efficacy: 80
  requires:
  - task: LOCALIZE
- behavior: GPS
  task: LOCALIZE
tasks:
- task: HOVER
- task: LOCALIZE
  category: recurrent
  automatic_activation: TRUE
)",
     .mending = "Write the present name, which the message gives; 'cbc lint --fix' does so.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 80
  requires:
  - task: LOCALIZE
- behavior: GPS
  task: LOCALIZE
tasks:
- task: HOVER
- task: LOCALIZE
  execution_goal: keep_running
  start_on_request: FALSE
)"},
};

}  // namespace

std::span<const Rule> file_rules() { return file_table; }

}  // namespace cbc
