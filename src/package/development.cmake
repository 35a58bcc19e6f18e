# Installs the files for C++ programs and for projects with catalogs.

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/cbc_catalog")
set(pkgconfig_dir "${CMAKE_INSTALL_LIBDIR}/pkgconfig")

if(BUILD_SHARED_LIBS)
  file(RELATIVE_PATH bin_to_lib "${CMAKE_INSTALL_FULL_BINDIR}" "${CMAKE_INSTALL_FULL_LIBDIR}")
  set_target_properties(cbc PROPERTIES INSTALL_RPATH "$ORIGIN/${bin_to_lib}")
endif()

install(TARGETS cbc_runtime EXPORT cbc_catalogTargets)
install(
  DIRECTORY include/cbc "${CMAKE_CURRENT_BINARY_DIR}/include/cbc"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
  FILES_MATCHING PATTERN "*.h")

install(EXPORT cbc_catalogTargets NAMESPACE cbc:: DESTINATION "${package_dir}")
configure_package_config_file(
  src/package/cbc_catalogConfig.cmake.in cbc_catalogConfig.cmake
  INSTALL_DESTINATION "${package_dir}"
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(cbc_catalogConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/cbc_catalogConfig.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/cbc_catalogConfigVersion.cmake"
              src/package/cbc_add_catalog.cmake
        DESTINATION "${package_dir}")

# Relative paths, so that the installed tree can be moved.
file(RELATIVE_PATH pc_to_prefix "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
string(REGEX REPLACE "/$" "" pc_to_prefix "${pc_to_prefix}")
file(RELATIVE_PATH pc_libdir "${CMAKE_INSTALL_PREFIX}" "${CMAKE_INSTALL_FULL_LIBDIR}")
file(RELATIVE_PATH pc_includedir "${CMAKE_INSTALL_PREFIX}" "${CMAKE_INSTALL_FULL_INCLUDEDIR}")
configure_file(src/package/cbc-catalog.pc.in cbc-catalog.pc @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/cbc-catalog.pc" DESTINATION "${pkgconfig_dir}")
