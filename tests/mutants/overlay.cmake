# Read by CMake after project(), for ./dev mutants: sources that have a mutated copy in the build folder are
# compiled from it, and what else is in their library sees mutated headers first. Other libraries and the
# tests are compiled as in any build.
include("${CMAKE_BINARY_DIR}/mutated.cmake" OPTIONAL) # mutated_sources, affected_sources: paths from the root

function(cbc_mutate_sources)
  foreach(target cbc_runtime cbc_exploration cbc_core cbc)
    get_target_property(sources ${target} SOURCES)
    set(changed)
    foreach(source IN LISTS sources)
      string(REPLACE "${CMAKE_SOURCE_DIR}/" "" path "${source}")
      if(path IN_LIST mutated_sources)
        set(source "${CMAKE_BINARY_DIR}/mutated/${path}")
      endif()
      if(path IN_LIST affected_sources)
        # Of a function that ends without a return, as a mutant may let it, g++ assumes that nothing calls it.
        set_property(SOURCE "${source}" APPEND PROPERTY COMPILE_OPTIONS -w -Wno-error -fsanitize=return
                                                        -fsanitize-undefined-trap-on-error)
        set_property(
          SOURCE "${source}"
          APPEND
          PROPERTY INCLUDE_DIRECTORIES "${CMAKE_BINARY_DIR}/mutated/src"
                   "${CMAKE_SOURCE_DIR}/tests/mutants")
      endif()
      list(APPEND changed "${source}")
    endforeach()
    # No precompiled headers: they may be mutated ones.
    set_target_properties(${target} PROPERTIES SOURCES "${changed}" DISABLE_PRECOMPILE_HEADERS ON)
  endforeach()
endfunction()

# Writes which mutants each test reaches.
function(cbc_record_tests)
  foreach(target cbc_unit_tests cbc_command_tests cbc_property_tests cbc_golden_tests)
    target_sources(${target} PRIVATE "${CMAKE_SOURCE_DIR}/tests/mutants/recorder.cpp")
  endforeach()
endfunction()

cmake_language(DEFER CALL cbc_mutate_sources)
cmake_language(DEFER CALL cbc_record_tests)
