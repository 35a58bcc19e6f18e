#[[
cbc_add_catalog(TARGET FILE... [OUTPUT FILE...])

Checks and compiles catalogs whenever the target, or all, is built and one of them has changed.
A catalog with errors fails the build, with the findings of `cbc lint`.

Each FILE is relative to the current source folder. The compiled catalog of DIR/NAME.yaml is NAME.cbc
in the current binary folder, unless OUTPUT names others, as many as there are catalogs.
]]
function(cbc_add_catalog target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" OUTPUT)
  set(catalogs ${arg_UNPARSED_ARGUMENTS})
  set(outputs ${arg_OUTPUT})
  if(NOT catalogs)
    message(FATAL_ERROR "cbc_add_catalog(${target}): no catalog given")
  endif()
  if(NOT outputs)
    foreach(catalog IN LISTS catalogs)
      get_filename_component(name "${catalog}" NAME_WLE)
      list(APPEND outputs "${name}.cbc")
    endforeach()
  endif()
  list(LENGTH catalogs catalog_count)
  list(LENGTH outputs output_count)
  if(NOT catalog_count EQUAL output_count)
    message(FATAL_ERROR
            "cbc_add_catalog(${target}): ${catalog_count} catalogs, but ${output_count} outputs")
  endif()

  set(compiled_catalogs)
  foreach(catalog output IN ZIP_LISTS catalogs outputs)
    get_filename_component(path "${catalog}" ABSOLUTE)
    get_filename_component(compiled "${output}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_BINARY_DIR}")
    get_filename_component(compiled_dir "${compiled}" DIRECTORY)
    file(MAKE_DIRECTORY "${compiled_dir}")
    _cbc_find_settings(settings "${path}")
    # The compiled catalog has the name of its source in it: with the relative one it is the same
    # wherever the project is built.
    add_custom_command(
      OUTPUT "${compiled}"
      COMMAND cbc::cbc lint "${path}"
      COMMAND cbc::cbc compile "${catalog}" -o "${compiled}"
      DEPENDS "${path}" ${settings} "$<TARGET_FILE:cbc::cbc>"
      WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}"
      COMMENT "Compiling catalog ${catalog}"
      VERBATIM)
    list(APPEND compiled_catalogs "${compiled}")
  endforeach()
  add_custom_target(${target} ALL DEPENDS ${compiled_catalogs})
endfunction()

# The settings of lint that apply to a catalog, if there are any.
function(_cbc_find_settings variable path)
  set(${variable} "" PARENT_SCOPE)
  get_filename_component(folder "${path}" DIRECTORY)
  while(TRUE)
    if(EXISTS "${folder}/.cbc.yaml")
      set(${variable} "${folder}/.cbc.yaml" PARENT_SCOPE)
      return()
    endif()
    get_filename_component(parent "${folder}" DIRECTORY)
    if(parent STREQUAL folder)
      return()
    endif()
    set(folder "${parent}")
  endwhile()
endfunction()
