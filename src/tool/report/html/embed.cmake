# Makes a C++ header of the files of the page: each is a constant in it, page_html for page.html.
#
#   cmake -D folder=FOLDER -D output=HEADER -P embed.cmake
#
# A file has to stay below the 64 KiB that a compiler has to accept for one literal.
set(header "#pragma once\n\n#include <string_view>\n\nnamespace cbc {\n")
foreach(name page.html page.css model.js picture.js panels.js page.js)
  file(READ "${folder}/${name}" text)
  string(MAKE_C_IDENTIFIER "${name}" constant)
  string(APPEND header "\ninline constexpr std::string_view ${constant} = R\"page(${text})page\";\n")
endforeach()
file(WRITE "${output}" "${header}\n}  // namespace cbc\n")
