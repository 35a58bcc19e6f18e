#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "core/command_line/command_line.h"
#include "rename/rename.h"

namespace cbc::cli {
namespace {

constexpr const char* rename_examples =
    "  cbc rename task DELIVER BRING .           in all files of this folder\n"
    "  cbc rename behavior FLY HOVER robot.yaml missions/   in these files\n"
    "  cbc rename --diff variable GPS GNSS .     what would change, as a diff\n";

constexpr const char* rename_footer =
    "Catalogs, scripts, property files and settings change together, or none of them. Each catalog "
    "is then proved to decide as before, as 'cbc verify --same-as' does.\n"
    "\n"
    "Exit status: 0 success, 2 nothing was changed, as a file or a name cannot be used, or the "
    "usage is wrong, 3 an internal error (please report it).\n"
    "\n"
    "Read more: man cbc-rename";

}  // namespace

void add_rename_command(Program& program) {
  const auto options = std::make_shared<RenameCommand>();
  Command& command = program.add_command(
      "rename",
      "Gives a task, a behavior or a situation variable another name in all files that name it.",
      {{"[OPTION...] task|behavior|variable OLD NEW PATH..."}, rename_examples, rename_footer});
  std::vector<std::string> kinds;
  for (const NameKind kind : {NameKind::task, NameKind::behavior, NameKind::variable}) {
    kinds.emplace_back(name_of(kind));
  }
  command.argument("KIND", options->kind, one_of("", kinds), "What it is").required();
  command.argument("OLD", options->old_name, name_of("", ValueKind::text), "Its name").required();
  command.argument("NEW", options->new_name, name_of("", ValueKind::text), "Its new name")
      .required();
  command
      .argument("PATH", options->paths, input("...", ValueKind::catalog_or_script),
                "Catalogs and what is about them: scripts, property files, settings; folders")
      .required();
  command.flag("--diff", options->diff, "Show what would change, as a diff, and change nothing");
  command.option("--max-states", options->max_states, whole_number("N", 1),
                 "End the proof after N pairs of states");
  command.add_confinement();
  command.action([options] { return rename(*options); });
}

}  // namespace cbc::cli
