#[[
cbc_add_catalog(TARGET FILE... [OUTPUT FILE...])

Adds a target, part of all, that checks and compiles each catalog when the catalog or the settings that
apply to it have changed. A catalog with errors fails the build, with the findings of `cbc lint`.

Each FILE is relative to the current source folder. DIR/NAME.yaml is compiled to NAME.cbc in the current
binary folder, unless OUTPUT names other files, one for each catalog.
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
  set(all_settings)
  set(list_of_settings "${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${target}.settings")
  foreach(catalog output IN ZIP_LISTS catalogs outputs)
    get_filename_component(path "${catalog}" ABSOLUTE)
    get_filename_component(compiled "${output}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_BINARY_DIR}")
    get_filename_component(compiled_dir "${compiled}" DIRECTORY)
    _cbc_check_source(${target} "${path}")
    if(compiled IN_LIST compiled_catalogs)
      message(FATAL_ERROR "cbc_add_catalog(${target}): two catalogs would be compiled to ${compiled}; "
                          "expected OUTPUT with a file for each")
    endif()
    file(MAKE_DIRECTORY "${compiled_dir}")
    _cbc_find_settings(settings "${path}")
    list(APPEND all_settings ${settings})
    # A compiled catalog contains the name of its source. A relative name makes it the same wherever the
    # project is built. Findings of cbc compile are hidden, since cbc lint has already reported them. If
    # cbc compile fails, it runs again to show the error.
    add_custom_command(
      OUTPUT "${compiled}"
      COMMAND cbc::cbc lint "${path}"
      COMMAND sh -c [["$@" 2>/dev/null || "$@"]] sh "$<TARGET_FILE:cbc::cbc>" compile "${catalog}" -o "${compiled}"
      DEPENDS "${path}" ${settings} "${list_of_settings}" "$<TARGET_FILE:cbc::cbc>"
      WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}"
      COMMENT "Compiling catalog ${catalog}"
      VERBATIM)
    list(APPEND compiled_catalogs "${compiled}")
  endforeach()
  # Changes when settings files appear or disappear, regardless of their age.
  file(CONFIGURE OUTPUT "${list_of_settings}" CONTENT "${all_settings}" @ONLY)
  add_custom_target(${target} ALL DEPENDS ${compiled_catalogs})
endfunction()

# A catalog that the build generates need not exist yet.
function(_cbc_check_source target path)
  get_source_file_property(is_generated "${path}" GENERATED)
  cmake_path(IS_PREFIX CMAKE_BINARY_DIR "${path}" is_of_build)
  if(NOT EXISTS "${path}" AND NOT is_generated AND NOT is_of_build)
    message(FATAL_ERROR "cbc_add_catalog(${target}): there is no catalog ${path}")
  endif()
endfunction()

# The lint settings in the folders above a catalog. Only the nearest ones apply, but they may disappear, so
# every build looks for all of them again.
function(_cbc_find_settings variable path)
  set(patterns)
  set(last_folder "")
  get_filename_component(folder "${path}" DIRECTORY)
  get_filename_component(folder "${folder}" REALPATH) # like lint, follow links to folders
  while(NOT folder STREQUAL last_folder)
    string(REGEX REPLACE "([[*?])" "[\\1]" pattern "${folder}")
    list(APPEND patterns "${pattern}/.cbc.yaml")
    set(last_folder "${folder}")
    get_filename_component(folder "${folder}" DIRECTORY)
  endwhile()
  file(GLOB settings LIST_DIRECTORIES false CONFIGURE_DEPENDS ${patterns})
  set(${variable} ${settings} PARENT_SCOPE)
endfunction()
