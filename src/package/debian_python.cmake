# The second Debian package, python3-cbc-catalog, made by `./dev package` beside the other one: the component
# `python`. It is of the same version, and depends on just that of the program, whose JSON it reads.

set(python_package python3-cbc-catalog)
set(python_doc_dir "${CMAKE_INSTALL_DATAROOTDIR}/doc/${python_package}")
install(FILES LICENSE DESTINATION "${python_doc_dir}" RENAME copyright COMPONENT python)
install(FILES docs/python.md docs/ros.md DESTINATION "${python_doc_dir}" COMPONENT python)
install(DIRECTORY docs/ros DESTINATION "${python_doc_dir}" USE_SOURCE_PERMISSIONS COMPONENT python)
set(python_changelog "${CMAKE_CURRENT_BINARY_DIR}/python_changelog.Debian")
set(name_of_program_package "${package_name}")
set(package_name "${python_package}") # what the changelog is of
configure_file(src/package/debian/changelog.in "${python_changelog}" @ONLY NO_SOURCE_PERMISSIONS)
set(package_name "${name_of_program_package}")
math(EXPR next_python "${Python3_VERSION_MINOR} + 1") # an extension module is for one version of Python
configure_file(src/package/debian/finish_python.cmake.in finish_python_package.cmake @ONLY)
configure_file(src/package/debian/CPackPythonConfig.cmake.in CPackPythonConfig.cmake @ONLY)
