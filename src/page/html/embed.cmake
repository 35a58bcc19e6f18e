# Makes a C++ header of the files of the page: its beginning, up to what it may connect to, and two lists
# of texts, before its data and after it; and the styles of pages without script.
#
#   cmake -D folder=FOLDER -D output=HEADER -P embed.cmake
#
# A file has to stay below the 64 KiB that a compiler has to accept for one literal. The page allows
# its own style and its own script by their hashes, and no others.
cmake_minimum_required(VERSION 3.21)

set(styles page.css timeline.css dock.css print.css)
set(scripts
    text.js catalog.js run.js story.js # what is known
    ink.js view.js marks.js rows.js painter.js timeline.js gestures.js minimap.js # the timeline
    graph_layout.js state_graph.js graph_pane.js # the graph of the state
    details.js events_table.js search.js overview.js signs.js legend.js # beside it
    continue.js address.js live.js page.js start.js)

# The base64 form of a SHA-256 hash in hexadecimal.
function(to_base64 hash result)
  set(letters "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/")
  set(text "")
  foreach(place RANGE 0 60 6)
    string(SUBSTRING "${hash}00" ${place} 6 group)
    foreach(shift 18 12 6 0)
      math(EXPR index "(0x${group} >> ${shift}) & 63")
      string(SUBSTRING "${letters}" ${index} 1 letter)
      string(APPEND text "${letter}")
    endforeach()
  endforeach()
  string(SUBSTRING "${text}" 0 43 text)
  set(${result} "${text}=" PARENT_SCOPE)
endfunction()

# read_parts(PREFIX FILE…): sets PREFIX_text to the files, PREFIX_literals to them as literals, and PREFIX_hash.
function(read_parts prefix)
  set(all "")
  set(literals "")
  foreach(name ${ARGN})
    file(READ "${folder}/${name}" text)
    string(APPEND all "${text}")
    string(APPEND literals "    R\"page(${text})page\",\n")
  endforeach()
  string(SHA256 hash "${all}")
  to_base64(${hash} base64)
  set(${prefix}_text "${all}" PARENT_SCOPE)
  set(${prefix}_literals "${literals}" PARENT_SCOPE)
  set(${prefix}_hash "'sha256-${base64}'" PARENT_SCOPE)
endfunction()

read_parts(tables tables.css)
read_parts(style ${styles})
read_parts(script ${scripts})
file(READ "${folder}/page.html" page)
string(REPLACE "{{style-hash}}" "${style_hash}" page "${page}")
string(REPLACE "{{script-hash}}" "${script_hash}" page "${page}")
foreach(marker sources style data script)
  string(FIND "${page}" "{{${marker}}}" end)
  string(SUBSTRING "${page}" 0 ${end} before_${marker})
  string(LENGTH "{{${marker}}}" length)
  math(EXPR end "${end} + ${length}")
  string(SUBSTRING "${page}" ${end} -1 page)
endforeach()
file(WRITE "${output}" "#pragma once

#include <string_view>

namespace cbc {

inline constexpr std::string_view page_before_sources =
    R\"page(${before_sources})page\";

inline constexpr std::string_view page_before_data[] = {
    R\"page(${before_style})page\",
${style_literals}    R\"page(${before_data})page\",
};

inline constexpr std::string_view page_after_data[] = {
    R\"page(${before_script})page\",
${script_literals}    R\"page(${page})page\",
};

/// The style of pages of tables, which have no script.
inline constexpr std::string_view tables_style =
    R\"page(${tables_text})page\";
inline constexpr std::string_view tables_style_hash = \"${tables_hash}\";

}  // namespace cbc
")
