#include "cli/standard_descriptors.h"

#include <fcntl.h>
#include <initializer_list>
#include <unistd.h>

namespace cbc::cli {

void hold_standard_descriptors() {
  // In order, as a file that is opened takes the lowest free descriptor.
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) >= 0) continue;
    // Open for the direction that is not used. What nobody wants to be told is no error, though.
    const int mode = descriptor == STDOUT_FILENO ? O_RDONLY : O_WRONLY;
    if (::open("/dev/null", mode) < 0) return;
  }
}

}  // namespace cbc::cli
