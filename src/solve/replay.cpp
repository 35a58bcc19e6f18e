#include <algorithm>
#include <filesystem>
#include <string>

#include "core/files/file_set.h"
#include "core/files/missions.h"
#include "core/files/output.h"
#include "core/files/read.h"
#include "core/script/log_script.h"
#include "core/script/script.h"
#include "runtime/base/text.h"
#include "solve/solve.h"

namespace cbc::cli {
namespace {

/// Writes the events of the log as a script.
int write_as_script(const SolveOptions& options, const CompiledCatalog& catalog) {
  const std::string& log = *options.stream.replay;
  const auto text = read_input(log);
  if (!text) return exit_unusable;
  std::string error;
  auto script = read_log(*text, catalog, error);
  if (!script) return complain("cannot read {}: {}", quote(display_name(log)), error);
  const std::filesystem::path file = *options.stream.to_script;
  script->catalog = path_in_script(options.paths.front(), (file.parent_path() / ".").string());
  return write_output(file.string(), write_script(catalog, *script, {}));
}

}  // namespace

int replay(SolveOptions options) {
  if (options.paths.size() != 1) {
    return complain("--replay needs a log and its catalog: cbc solve --replay LOG CATALOG");
  }
  const std::string& log = *options.stream.replay;
  if (log == "-" && options.format != "jsonl") {
    return complain("--replay - needs --format jsonl: the other formats read the log twice");
  }
  FileSet files;
  const auto catalog = files.load(options.paths.front());
  files.print_findings();
  if (catalog == nullptr) return exit_unusable;
  if (options.stream.against) return replay_against(options, *catalog->compiled);
  int status = replay_stream(options, *catalog->compiled);
  if (status == exit_unusable) return status;
  if (options.stream.to_script) {
    status = std::max(status, write_as_script(options, *catalog->compiled));
  }
  if (options.format == "jsonl") return status;
  options.paths = {log};
  return std::max(status, solve_missions(options, catalog));
}

}  // namespace cbc::cli
