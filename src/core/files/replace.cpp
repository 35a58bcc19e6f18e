#include "core/files/replace.h"

#include <algorithm>
#include <optional>

#include "core/files/output.h"
#include "core/files/read.h"
#include "core/support/system.h"
#include "runtime/base/text.h"

namespace cbc::cli {
namespace {

bool can_replace(const Replacement& replacement) {
  const std::optional<std::string> now = read_input(replacement.path);
  if (!now) return false;
  if (*now != *replacement.before) {
    complain("{} has changed in the meantime; it is not overwritten", quote(replacement.path));
    return false;
  }
  const auto obstacle = find_obstacle(replacement.path);
  if (obstacle) complain("cannot write {}: {}", quote(replacement.path), *obstacle);
  return !obstacle;
}

}  // namespace

int replace_inputs(std::span<const Replacement> replacements) {
  if (!std::all_of(replacements.begin(), replacements.end(), can_replace)) return exit_unusable;
  for (std::size_t count = 0; count < replacements.size(); ++count) {
    const int status = replace_input(replacements[count].path, replacements[count].after);
    if (status == exit_ok) continue;
    for (const Replacement& written : replacements.first(count)) {
      if (replace_input(written.path, *written.before) == exit_ok) continue;
      complain("{} is left changed", quote(written.path));
    }
    return status;
  }
  return exit_ok;
}

}  // namespace cbc::cli
