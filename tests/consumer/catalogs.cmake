# Compiles catalogs with the installed package, in projects that have no language at all. Catalogs and
# settings change, and the build has to follow.
#
# Variables: bindir, build, catalog, config, generator.
cmake_minimum_required(VERSION 3.21)

set(work "${build}/consumer_catalogs")
set(prefix "${work}/installed")
set(project "${work}/project [1]") # no pattern
set(binary "${work}/build")
set(robot "${project}/catalogs/quadrotor.yaml")
set(compiled "${binary}/quadrotor.cbc")

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Checks that a command succeeds, or fails with FAILURE, and that what it prints, which becomes the variable
# `printed`, matches the regular expression PRINTED.
function(expect)
  cmake_parse_arguments(PARSE_ARGV 0 expected "FAILURE" "PRINTED" "COMMAND")
  execute_process(COMMAND ${expected_COMMAND} RESULT_VARIABLE status OUTPUT_VARIABLE printed ERROR_VARIABLE printed)
  message("${printed}")
  set(printed "${printed}" PARENT_SCOPE)
  if(expected_FAILURE AND status EQUAL 0)
    message(FATAL_ERROR "this should fail")
  elseif(NOT expected_FAILURE AND NOT status EQUAL 0)
    message(FATAL_ERROR "this should succeed")
  endif()
  if(expected_PRINTED AND NOT printed MATCHES "${expected_PRINTED}")
    message(FATAL_ERROR "this should print ${expected_PRINTED}")
  endif()
endfunction()

# Writes the project, of which only the end is given, and configures it; further arguments are those of expect.
function(configure end)
  file(WRITE "${project}/CMakeLists.txt" "cmake_minimum_required(VERSION 3.10)
project(robot LANGUAGES NONE)
find_package(cbc_catalog REQUIRED)
${end}\n")
  expect(${ARGN} COMMAND "${CMAKE_COMMAND}" -S "${project}" -B "${binary}" -G "${generator}"
         -D "CMAKE_PREFIX_PATH=${prefix}")
endfunction()

# Builds, which has to compile the catalog if and only if COMPILED is given; further arguments are those of expect.
function(build)
  cmake_parse_arguments(PARSE_ARGV 0 build "COMPILED" "" "")
  expect(${build_UNPARSED_ARGUMENTS} COMMAND "${CMAKE_COMMAND}" --build "${binary}" --config "${config}")
  set(printed "${printed}" PARENT_SCOPE)
  string(FIND "${printed}" "Compiling catalog" place)
  if(build_COMPILED AND place EQUAL -1)
    message(FATAL_ERROR "the catalog is not compiled")
  elseif(NOT build_COMPILED AND NOT place EQUAL -1)
    message(FATAL_ERROR "the catalog is compiled again, although nothing changed")
  endif()
  # What is written in the same tick of the clock as what was built would not look newer.
  run("${CMAKE_COMMAND}" -E sleep 0.1)
endfunction()

file(REMOVE_RECURSE "${work}")
run("${CMAKE_COMMAND}" --install "${build}" --config "${config}" --prefix "${prefix}")
set(cbc "${prefix}/${bindir}/cbc")
file(READ "${catalog}" sound)
file(WRITE "${robot}" "${sound}")
# Older than all that is built.
file(WRITE "${work}/strict.yaml" "error: [duplicate-exclusion]\n")
file(WRITE "${work}/lax.yaml" "allow: [duplicate-exclusion]\n")

# A change of the catalog.
configure("cbc_add_catalog(robot catalogs/quadrotor.yaml)")
build(COMPILED)
execute_process(COMMAND "${cbc}" compile catalogs/quadrotor.yaml -o "${work}/expected.cbc"
                WORKING_DIRECTORY "${project}" COMMAND_ERROR_IS_FATAL ANY)
run("${CMAKE_COMMAND}" -E compare_files "${work}/expected.cbc" "${compiled}")
build()
file(TOUCH "${robot}")
build(COMPILED)
run("${CMAKE_COMMAND}" -E compare_files "${work}/expected.cbc" "${compiled}")
file(WRITE "${robot}" "${sound}- mutually_exclusive: [LAND, LANDD]\n")
build(COMPILED FAILURE PRINTED "quadrotor.yaml:[0-9]+:[0-9]+: error: .*LANDD.*undefined-task")

# A warning is printed once, and what is wrong but for the catalog, too.
file(WRITE "${robot}" "${sound}- mutually_exclusive: [LAND, HOVER]\n  reasons: none\n")
build(COMPILED PRINTED "warning: .*unknown-key")
string(REGEX MATCHALL "unknown-key" warnings "${printed}")
if(NOT warnings STREQUAL "unknown-key")
  message(FATAL_ERROR "the warning is printed more than once")
endif()

# Settings appear, vanish, and appear nearer, whatever their age.
file(WRITE "${robot}" "${sound}- mutually_exclusive: [LAND, HOVER]\n")
build(COMPILED PRINTED "note: .*duplicate-exclusion")
file(RENAME "${work}/strict.yaml" "${project}/.cbc.yaml")
build(COMPILED FAILURE PRINTED "error: .*duplicate-exclusion")
file(RENAME "${work}/lax.yaml" "${project}/catalogs/.cbc.yaml")
build(COMPILED)
file(WRITE "${project}/catalogs/.cbc.yaml" "error: [duplicate-exclusion]\n")
build(COMPILED FAILURE PRINTED "error: .*duplicate-exclusion")
file(REMOVE "${project}/.cbc.yaml" "${project}/catalogs/.cbc.yaml")
build(COMPILED PRINTED "note: .*duplicate-exclusion")
file(WRITE "${robot}" "${sound}")
build(COMPILED)
run("${CMAKE_COMMAND}" -E compare_files "${work}/expected.cbc" "${compiled}")
build()

# A catalog that the build makes, in its own folder or among the sources.
foreach(copy "\${CMAKE_CURRENT_BINARY_DIR}/copy.yaml" "\${CMAKE_CURRENT_SOURCE_DIR}/copy.yaml")
  configure("add_custom_command(
  OUTPUT \"${copy}\"
  COMMAND \"\${CMAKE_COMMAND}\" -E copy \"\${CMAKE_CURRENT_SOURCE_DIR}/catalogs/quadrotor.yaml\" \"${copy}\"
  DEPENDS catalogs/quadrotor.yaml
  VERBATIM)
cbc_add_catalog(robot \"${copy}\")")
  build(COMPILED)
  run("${cbc}" graph "${binary}/copy.cbc" --output "${work}/graph.dot")
  file(TOUCH "${robot}")
  build(COMPILED)
  file(REMOVE "${binary}/copy.cbc")
endforeach()

# Calls that make no sense.
configure("cbc_add_catalog(robot)" FAILURE PRINTED "no catalog given")
configure("cbc_add_catalog(robot catalogs/quadrotor.yml)" FAILURE
          PRINTED "there is no catalog.*catalogs/quadrotor.yml")
configure("cbc_add_catalog(robot catalogs/quadrotor.yaml OUTPUT a.cbc b.cbc)" FAILURE
          PRINTED "1 catalogs, but 2[ \n]+outputs")
file(WRITE "${project}/other/quadrotor.yaml" "${sound}")
configure("cbc_add_catalog(robot catalogs/quadrotor.yaml other/quadrotor.yaml)" FAILURE
          PRINTED "two catalogs would be compiled to.*quadrotor.cbc.*OUTPUT")
configure("cbc_add_catalog(robot catalogs/quadrotor.yaml other/quadrotor.yaml OUTPUT a.cbc b.cbc)")
build(COMPILED)

# An output that cannot be written.
configure("cbc_add_catalog(robot catalogs/quadrotor.yaml OUTPUT folder/a.cbc)")
file(REMOVE_RECURSE "${binary}/folder")
file(WRITE "${binary}/folder" "")
build(COMPILED FAILURE PRINTED "cbc: cannot write .*folder/a.cbc")
