# The Python package cbc_catalog: the extension module and the files in Python, in build/PRESET/python, so that
# PYTHONPATH=build/PRESET/python finds it, and installed where the system's Python looks.

find_package(Python3 COMPONENTS Interpreter Development.Module REQUIRED)
set(PYBIND11_FINDPYTHON ON)
set(Python_EXECUTABLE "${Python3_EXECUTABLE}")
find_package(pybind11 REQUIRED CONFIG)

set(python_build "${CMAKE_CURRENT_BINARY_DIR}/python")
file(GLOB python_module_sources CONFIGURE_DEPENDS src/python/module/*.cpp)
pybind11_add_module(cbc_python MODULE NO_EXTRAS ${python_module_sources})
set_target_properties(
  cbc_python
  PROPERTIES OUTPUT_NAME _native
             LIBRARY_OUTPUT_DIRECTORY "${python_build}/cbc_catalog"
             CXX_VISIBILITY_PRESET hidden
             VISIBILITY_INLINES_HIDDEN ON
             UNITY_BUILD_BATCH_SIZE 5)
target_include_directories(cbc_python PRIVATE src)
target_link_libraries(cbc_python PRIVATE cbc_program ${fmt})
# The symbols of the library are not for others that are loaded into the same process.
target_link_options(cbc_python PRIVATE LINKER:--exclude-libs,ALL)

# The files in Python, and what is made for them: where the program is, and what tells pip and pytest of the package.
file(GLOB python_files RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}/src/python/cbc_catalog" CONFIGURE_DEPENDS
     src/python/cbc_catalog/*)
list(FILTER python_files EXCLUDE REGEX "^__pycache__$")
set(python_outputs)
foreach(file IN LISTS python_files)
  set(source "${CMAKE_CURRENT_SOURCE_DIR}/src/python/cbc_catalog/${file}")
  set(output "${python_build}/cbc_catalog/${file}")
  add_custom_command(
    OUTPUT "${output}"
    COMMAND "${CMAKE_COMMAND}" -E copy "${source}" "${output}"
    DEPENDS "${source}"
    VERBATIM)
  list(APPEND python_outputs "${output}")
endforeach()
add_custom_target(cbc_python_files ALL DEPENDS ${python_outputs})
add_dependencies(cbc_python cbc_python_files)

set(dist_info "cbc_catalog-${cbc_VERSION}.dist-info")
foreach(file METADATA entry_points.txt)
  configure_file(src/python/${file}.in "${python_build}/${dist_info}/${file}" @ONLY)
endforeach()
file(WRITE "${python_build}/${dist_info}/INSTALLER" "cmake\n")
# Where Debian's Python looks below /usr/local; its package is moved to where that looks below /usr.
set(CBC_PYTHON_DIR "lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/dist-packages"
    CACHE STRING "Where the Python package is installed, below the prefix")

# The program beside this build, and the installed one; relative paths, so that the installed tree can be moved.
set(python_program "../../${CBC_PROGRAM_NAME}")
configure_file(src/python/_build.py.in "${python_build}/cbc_catalog/_build.py" @ONLY)
file(RELATIVE_PATH python_program "/${CBC_PYTHON_DIR}/cbc_catalog" "/${CMAKE_INSTALL_BINDIR}/${CBC_PROGRAM_NAME}")
if(SKBUILD) # pip puts what is here into lib/python3.x/site-packages, beside the program's folder bin
  set(CBC_PYTHON_DIR ".")
  install(TARGETS cbc RUNTIME DESTINATION "${SKBUILD_SCRIPTS_DIR}" COMPONENT python)
endif()
configure_file(src/python/_build.py.in "${python_build}/installed/_build.py" @ONLY)

install(TARGETS cbc_python LIBRARY DESTINATION "${CBC_PYTHON_DIR}/cbc_catalog" COMPONENT python)
list(TRANSFORM python_files PREPEND "src/python/cbc_catalog/")
install(FILES ${python_files} "${python_build}/installed/_build.py" DESTINATION "${CBC_PYTHON_DIR}/cbc_catalog"
        COMPONENT python)
if(NOT SKBUILD) # which writes its own
  install(DIRECTORY "${python_build}/${dist_info}" DESTINATION "${CBC_PYTHON_DIR}" COMPONENT python)
endif()
