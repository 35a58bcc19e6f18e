#include <cerrno>
#include <spawn.h>
#include <sys/mman.h>

// In a browser there are no other programs, such as Graphviz: what starts one is told so.

extern "C" {

int memfd_create(const char* /*name*/, unsigned /*flags*/) {
  errno = ENOSYS;
  return -1;
}

int posix_spawnp(pid_t* /*process*/, const char* /*file*/,
                 const posix_spawn_file_actions_t* /*actions*/,
                 const posix_spawnattr_t* /*attributes*/, char* const* /*arguments*/,
                 char* const* /*environment*/) {
  return ENOSYS;
}
}
