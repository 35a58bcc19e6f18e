#include "rules/topics.h"

namespace cbc {
namespace {

constexpr Rule control_table[] = {
    {.name = rule::unused_allow,
     .severity = Severity::warning,
     .summary = "A comment allows a rule that is not broken there.",
     .explanation =
         "A comment '# cbc: allow RULE' at the end of a line allows the rule on this line; alone "
         "above an entry, on the whole entry. Several rules are separated by commas, and a reason "
         "may follow after ' -- '. Here there is no finding of the rule: the mistake was mended, "
         "or is on another line.\n\n"
         "Left behind, the comment would hide the next mistake of its kind.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 90  # cbc: allow suspicious-suitability -- a last resort
tasks:
- task: HOVER
)",
     .mending =
         "Remove the comment, or the rule from it, or move the comment to the line of the finding.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 90
tasks:
- task: HOVER
)"},

    {.name = rule::unknown_rule,
     .severity = Severity::warning,
     .summary = "A setting names a rule that does not exist.",
     .explanation =
         "A comment '# cbc: allow RULE' in a file, or a setting in .cbc.yaml, names a rule that "
         "cbc does not have, so it has no effect: what it was to allow is still reported. The "
         "message gives the nearest known name; 'cbc lint --list-rules' shows all of them. A "
         "reason has to stand after ' -- ', else its words are taken for names of rules.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 1  # cbc: allow suspicious-suitability, last-resort
tasks:
- task: HOVER
)",
     .mending = "Correct the name, or remove it.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 1  # cbc: allow suspicious-suitability -- a last resort
tasks:
- task: HOVER
)"},
};

}  // namespace

std::span<const Rule> control_rules() { return control_table; }

}  // namespace cbc
