# Installs the library, moves the installed tree, and builds the example main.cpp against it twice:
# with find_package and with pkg-config. Both drive a flight on a catalog that the installed program
# compiled in the build, and must print what expected.txt says. Then the catalog changes, and the build
# has to follow.
#
# Variables: bindir, build, catalog, config, compiler, datadir, generator, libdir, pkg_config, version.
cmake_minimum_required(VERSION 3.21)

set(source "${CMAKE_CURRENT_LIST_DIR}")
set(work "${build}/consumer")
set(prefix "${work}/moved")
set(project "${work}/project") # a copy, with a catalog that may change
set(catalog_copy "${project}/catalogs/quadrotor.yaml")
set(compiled "${work}/cmake/quadrotor.cbc")
set(ENV{PKG_CONFIG_PATH} "${prefix}/${libdir}/pkgconfig")

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(check program)
  execute_process(COMMAND "${program}" "${compiled}" COMMAND_ECHO STDOUT
                  COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE printed)
  file(READ "${source}/expected.txt" expected)
  string(PREPEND expected "cbc ${version}\n")
  if(NOT printed STREQUAL expected)
    message(FATAL_ERROR "${program} printed\n${printed}\ninstead of\n${expected}")
  endif()
endfunction()

file(REMOVE_RECURSE "${work}")
run("${CMAKE_COMMAND}" --install "${build}" --config "${config}" --prefix "${work}/installed")
file(RENAME "${work}/installed" "${prefix}")
run("${prefix}/${bindir}/cbc" --version)

# Checks that an installed file is what the program prints; further arguments are those of the program.
function(expect_printed file)
  execute_process(COMMAND "${prefix}/${bindir}/cbc" ${ARGN} COMMAND_ECHO STDOUT
                  COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE printed)
  file(READ "${prefix}/${datadir}/${file}" installed)
  if(NOT printed STREQUAL installed)
    message(FATAL_ERROR "the installed ${file} is not what the program prints")
  endif()
endfunction()

expect_printed(cbc/schemas/catalog.json schema catalog)
expect_printed(cbc/schemas/script.json schema script)
expect_printed(bash-completion/completions/cbc completion bash)
expect_printed(zsh/site-functions/_cbc completion zsh)
expect_printed(fish/vendor_completions.d/cbc.fish completion fish)

file(COPY "${source}" DESTINATION "${project}/tests")
configure_file("${catalog}" "${catalog_copy}" COPYONLY)
file(WRITE "${project}/.cbc.yaml" "strict: false\n")
run("${CMAKE_COMMAND}" -S "${project}/tests/consumer" -B "${work}/cmake" -G "${generator}"
    -D "CMAKE_BUILD_TYPE=${config}" -D "CMAKE_CXX_COMPILER=${compiler}"
    -D "CMAKE_PREFIX_PATH=${prefix}")
run("${CMAKE_COMMAND}" --build "${work}/cmake" --config "${config}")
check("${work}/cmake/consumer")

execute_process(COMMAND "${pkg_config}" --static --cflags --libs cbc-catalog
                COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE flags)
separate_arguments(flags UNIX_COMMAND "${flags}")
run("${compiler}" -std=c++20 "${source}/main.cpp" -o "${work}/consumer" ${flags})
set(ENV{LD_LIBRARY_PATH} "${prefix}/${libdir}") # for a shared library; pkg-config sets no rpath
check("${work}/consumer")

# Builds again. It must succeed unless FAILURE is given, and compile the catalog if and only if COMPILED
# is given; PRINTED is a regular expression that what it prints must match.
function(build_again)
  cmake_parse_arguments(PARSE_ARGV 0 expected "FAILURE;COMPILED" "PRINTED" "")
  execute_process(COMMAND "${CMAKE_COMMAND}" --build "${work}/cmake" --config "${config}"
                  RESULT_VARIABLE status OUTPUT_VARIABLE printed ERROR_VARIABLE printed)
  message("${printed}")
  string(FIND "${printed}" "Compiling catalog" place)
  if(expected_COMPILED AND place EQUAL -1)
    message(FATAL_ERROR "the catalog is not compiled again")
  elseif(NOT expected_COMPILED AND NOT place EQUAL -1)
    message(FATAL_ERROR "the catalog is compiled again, although nothing changed")
  endif()
  if(expected_FAILURE AND status EQUAL 0)
    message(FATAL_ERROR "the build should fail")
  elseif(NOT expected_FAILURE AND NOT status EQUAL 0)
    message(FATAL_ERROR "the build fails")
  endif()
  if(expected_PRINTED AND NOT printed MATCHES "${expected_PRINTED}")
    message(FATAL_ERROR "the build does not print ${expected_PRINTED}")
  endif()
  # What is written in the same tick of the clock as what was built would not look newer.
  execute_process(COMMAND "${CMAKE_COMMAND}" -E sleep 0.1 COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(READ "${catalog_copy}" sound_catalog)
file(SHA256 "${compiled}" sound_hash)
build_again()

file(TOUCH "${catalog_copy}")
build_again(COMPILED)
file(SHA256 "${compiled}" hash)
if(NOT hash STREQUAL sound_hash)
  message(FATAL_ERROR "the same catalog gives another file")
endif()

file(APPEND "${catalog_copy}" "- mutually_exclusive: [LAND, LANDD]\n")
build_again(FAILURE COMPILED PRINTED "quadrotor.yaml:[0-9]+:[0-9]+: error: .*LANDD.*undefined-task")

# Settings count: what is a note may become an error.
file(WRITE "${catalog_copy}" "${sound_catalog}- mutually_exclusive: [LAND, HOVER]\n")
build_again(COMPILED PRINTED "note: .*duplicate-exclusion")
file(WRITE "${project}/.cbc.yaml" "error: [duplicate-exclusion]\n")
build_again(FAILURE COMPILED PRINTED "error: .*duplicate-exclusion")

file(WRITE "${catalog_copy}" "${sound_catalog}")
build_again(COMPILED)
check("${work}/cmake/consumer")
