#include "cli/output.h"

#include <cstdio>
#include <sys/stat.h>
#include <unistd.h>

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

bool is_same_file(const std::string& input, const std::string& output) {
  if (output == "-") return false;
  struct stat in {};
  struct stat out {};
  const int status = input == "-" ? ::fstat(STDIN_FILENO, &in) : ::stat(input.c_str(), &in);
  return status == 0 && ::stat(output.c_str(), &out) == 0 && in.st_dev == out.st_dev &&
         in.st_ino == out.st_ino;
}

}  // namespace cbc::cli
