#include "cli/output.h"

#include <cstdio>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "cli/exit_status.h"
#include "cli/input.h"
#include "file/atomic_file.h"
#include "text/quote.h"

namespace cbc::cli {

int write_output(const std::string& path, std::string_view content) {
  if (path == "-") {
    std::fwrite(content.data(), 1, content.size(), stdout);  // errors show when it is closed
    return exit_ok;
  }
  if (const auto error = write_atomically(path, content)) {
    complain(fmt::format("cannot write {}: {}", quote(path), *error));
    return exit_unusable;
  }
  return exit_ok;
}

bool is_same_file(const std::string& path, const std::string& other) {
  std::error_code ignored;
  return path != "-" && other != "-" && std::filesystem::equivalent(path, other, ignored);
}

}  // namespace cbc::cli
