# Makes a C++ header of all files in a folder and its subfolders: a table of their paths and texts.
#
#   cmake -D folder=FOLDER -D table=NAME -D output=HEADER [-D suffix=SUFFIX] -P embed_files.cmake
#
# With a suffix, such as .json, only files with this suffix are in the table, by paths without it. A file has
# to stay below the 64 KiB that a compiler has to accept for one literal.
file(GLOB_RECURSE paths RELATIVE "${folder}" "${folder}/*${suffix}")
set(names)
string(LENGTH "${suffix}" suffix_length)
foreach(path IN LISTS paths)
  string(LENGTH "${path}" length)
  math(EXPR length "${length} - ${suffix_length}")
  string(SUBSTRING "${path}" 0 ${length} name)
  list(APPEND names "${name}")
endforeach()
list(SORT names)
set(header "#pragma once\n\n#include \"core/command_line/command_line.h\"\n\nnamespace cbc::cli {\n\n")
string(APPEND header "inline constexpr EmbeddedFile ${table}[] = {\n")
foreach(name IN LISTS names)
  file(READ "${folder}/${name}${suffix}" text)
  string(APPEND header "    {\"${name}\", R\"file(${text})file\"},\n")
endforeach()
file(WRITE "${output}" "${header}};\n\n}  // namespace cbc::cli\n")
