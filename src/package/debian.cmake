# The Debian package, made by `./dev package`. It has both the program and the library: the library is small,
# static, and has no run-time dependencies beyond those of the program.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME "${package_name}")
set(CPACK_PACKAGE_CONTACT "The cbc authors <cbc-authors@users.noreply.github.com>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "compiler and offline solver for behavior catalogs of robots")
set(CPACK_PACKAGE_DESCRIPTION
"A behavior catalog says which behaviors of a robot can perform which tasks
and how well, which tasks exclude one another, and what a behavior requires.
.
The program cbc finds the mistakes in a catalog (cbc lint), computes the best
set of active behaviors at every event of a mission (cbc solve), compiles a
catalog into a file that a robot loads in microseconds (cbc compile), and draws
pictures (cbc graph). It needs neither a robot nor ROS.
.
The C++ library for programs on the robot is included, with its headers and
its packages for CMake and pkg-config.")
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# Each Debian has other versions of the libraries, so the packages say for which one they are: 1~debian12.
execute_process(COMMAND sh -c ". /etc/os-release && echo \"~$ID$VERSION_ID\"" OUTPUT_VARIABLE system ERROR_QUIET
                OUTPUT_STRIP_TRAILING_WHITESPACE)
set(CPACK_DEBIAN_PACKAGE_RELEASE "1${system}")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "graphviz, man-db") # for the pictures of `cbc graph`, and the manual
if(CBC_PROGRAM_NAME STREQUAL "cbc")
  set(CPACK_DEBIAN_PACKAGE_CONFLICTS coinor-cbc) # has a program of the same name
endif()

set(changelog "${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian")
configure_file(src/package/debian/changelog.in "${changelog}" @ONLY NO_SOURCE_PERMISSIONS)
configure_file(src/package/debian/finish.cmake.in finish_package.cmake @ONLY)
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_BINARY_DIR}/finish_package.cmake")

# A shared library would need its own package, and a static program another description.
if(BUILD_SHARED_LIBS OR CBC_STATIC)
  set(CPACK_PROJECT_CONFIG_FILE "${CMAKE_CURRENT_SOURCE_DIR}/src/package/debian/refuse.cmake")
endif()

# The component `python` has a package of its own: debian_python.cmake.
set(CPACK_INSTALL_CMAKE_PROJECTS "${CMAKE_CURRENT_BINARY_DIR};cbc;Unspecified;/")

include(CPack)
