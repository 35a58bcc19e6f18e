# Installs the library, moves the installed tree, and builds the example main.cpp against it twice:
# with find_package and with pkg-config. Both drive a flight on a catalog that the installed program
# compiled in the build, must print what expected.txt says, and need no shared library but those of the
# compiler.
#
# Variables: bindir, build, config, compiler, datadir, generator, libdir, pkg_config, shared, version.
cmake_minimum_required(VERSION 3.21)

set(source "${CMAKE_CURRENT_LIST_DIR}")
set(work "${build}/consumer")
set(prefix "${work}/moved")
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
  execute_process(COMMAND ldd "${program}" COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE needed)
  string(REGEX REPLACE "\\([^)]*\\)" "" needed "${needed}")
  string(REGEX MATCHALL "[^ \t\n]+\\.so[^ \t\n]*" needed "${needed}")
  set(allowed "(^|/)(linux-vdso|ld-linux[^/]*|lib(c|gcc_s|m|stdc\\+\\+))\\.so")
  if(shared)
    string(APPEND allowed "|(^|/)libcbc_catalog\\.so")
  endif()
  list(FILTER needed EXCLUDE REGEX "${allowed}")
  if(needed)
    message(FATAL_ERROR "${program} needs ${needed}")
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

run("${CMAKE_COMMAND}" -S "${source}" -B "${work}/cmake" -G "${generator}" -D "CMAKE_BUILD_TYPE=${config}"
    -D "CMAKE_CXX_COMPILER=${compiler}" -D "CMAKE_PREFIX_PATH=${prefix}")
run("${CMAKE_COMMAND}" --build "${work}/cmake" --config "${config}")
check("${work}/cmake/consumer")

execute_process(COMMAND "${pkg_config}" --cflags --libs cbc-catalog
                COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE flags)
separate_arguments(flags UNIX_COMMAND "${flags}")
run("${compiler}" -std=c++20 "${source}/main.cpp" -o "${work}/consumer" ${flags})
set(ENV{LD_LIBRARY_PATH} "${prefix}/${libdir}") # for a shared library; pkg-config sets no rpath
check("${work}/consumer")
