# Installs the catalogs and missions of catalogs/ as examples.

set(examples_dir "${doc_dir}/examples")
file(RELATIVE_PATH examples_to_schemas "${CMAKE_INSTALL_FULL_DATAROOTDIR}/doc/${package_name}/examples"
     "${CMAKE_INSTALL_FULL_DATADIR}/cbc/schemas")
file(GLOB examples CONFIGURE_DEPENDS catalogs/*.yaml)
foreach(source IN LISTS examples)
  # The installed schemas are in another folder.
  file(READ "${source}" text)
  string(REPLACE "$schema=../schemas/" "$schema=${examples_to_schemas}/" text "${text}")
  get_filename_component(name "${source}" NAME)
  file(CONFIGURE OUTPUT "examples/${name}" CONTENT "${text}" @ONLY)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${source}")
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/examples/${name}" DESTINATION "${examples_dir}")
endforeach()
