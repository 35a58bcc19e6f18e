#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

#include "core/files/file_set.h"
#include "core/files/output.h"
#include "core/files/read.h"
#include "core/script/log_script.h"
#include "core/script/script.h"
#include "runtime/base/text.h"
#include "solve/solve.h"

namespace cbc::cli {
namespace {

/// The path of the catalog as the script has to name it.
std::string path_from(const std::string& script, const std::string& catalog) {
  const std::filesystem::path path(catalog);
  if (script == "-" || path.is_absolute()) return catalog;
  const std::filesystem::path folder = std::filesystem::path(script).parent_path();
  return path.lexically_proximate(folder.empty() ? "." : folder).string();
}

/// Writes the events of the log as a script.
int write_as_script(const SolveOptions& options) {
  const auto catalog = load_catalog(options.paths.front());
  const auto text = read_input(*options.stream.replay);
  if (catalog == nullptr || !text) return exit_unusable;
  std::string error;
  auto script = read_log(*text, *catalog, error);
  if (!script) {
    return complain("cannot read {}: {}", quote(display_name(*options.stream.replay)), error);
  }
  const std::string& file = *options.stream.to_script;
  script->catalog = path_from(file, options.paths.front());
  return write_output(file, write_script(*catalog, *script, {}));
}

}  // namespace

int replay(SolveOptions options) {
  int status = replay_stream(options);
  if (status == exit_unusable) return status;
  if (options.stream.to_script) status = std::max(status, write_as_script(options));
  if (options.format == "jsonl") return status;
  options.paths.push_back(*options.stream.replay);
  return std::max(status, solve_missions(options));
}

}  // namespace cbc::cli
