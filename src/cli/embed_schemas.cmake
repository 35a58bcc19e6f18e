# Makes a C++ header of all JSON Schemas in a folder: a table of their names and texts.
#
#   cmake -D folder=FOLDER -D output=HEADER -P embed_schemas.cmake
#
# A file has to stay below the 64 KiB that a compiler has to accept for one literal.
file(GLOB names RELATIVE "${folder}" "${folder}/*.json")
list(TRANSFORM names REPLACE "[.]json$" "")
list(SORT names)
set(header "#pragma once\n\n#include <string_view>\n\nnamespace cbc::cli {\n\n")
string(APPEND header "struct Schema {\n  std::string_view name;\n  std::string_view text;\n};\n\n")
string(APPEND header "inline constexpr Schema schema_files[] = {\n")
foreach(name IN LISTS names)
  file(READ "${folder}/${name}.json" text)
  string(APPEND header "    {\"${name}\", R\"schema(${text})schema\"},\n")
endforeach()
file(WRITE "${output}" "${header}};\n\n}  // namespace cbc::cli\n")
