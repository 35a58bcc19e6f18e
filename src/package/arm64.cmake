# The toolchain file of the presets `arm64` and `static-arm64`: Debian's cross compiler (crossbuild-essential-arm64), and
# libraries of Debian's architecture arm64. With an emulator (qemu-user-static) the build can run what it has made, for the
# completions, and ctest the tests. `./dev arm64` has all of them in a root of its own.

set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)

# Headers of all architectures are in one folder; programs are those of the machine that builds.
set(CMAKE_FIND_ROOT_PATH /usr/aarch64-linux-gnu /)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
# The cross compiler has a C library of its own, which gets no security updates.
set(CMAKE_EXE_LINKER_FLAGS_INIT -L/usr/lib/aarch64-linux-gnu)

set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE arm64)

find_program(cbc_emulator NAMES qemu-aarch64-static qemu-aarch64)
if(cbc_emulator)
  set(CMAKE_CROSSCOMPILING_EMULATOR "${cbc_emulator}")
endif()
