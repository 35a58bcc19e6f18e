#include "core/files/unified_diff.h"

#include <utility>

#include "core/files/output.h"
#include "core/support/system.h"
#include "runtime/base/text.h"

namespace cbc::cli {

std::optional<std::string> unified_diff(std::string_view before, std::string_view after,
                                        std::string_view file) {
  if (before == after) return std::string();
  std::string name = printable(file);
  if (name.find(' ') != std::string::npos) name += '\t';  // ends it for patch
  Filtered diff = run_filter({"diff", "-u", "-L", "a/" + name, "-L", "b/" + name, "-",
                              std::string(second_input_of_filter)},
                             before, nullptr, after);
  constexpr int texts_differ = 1;
  if (diff.status == texts_differ) return std::move(diff.output);
  complain("cannot run diff: {}", diff.error_output);
  return std::nullopt;
}

}  // namespace cbc::cli
