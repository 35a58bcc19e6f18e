# Makes two C++ headers of the files of rules, each of which is named like its rule:
#
#   cmake -D folder=FOLDER -D output=FOLDER -P embed_rules.cmake
#
#   rule_names.h   declares the rules, and lists them in the order of their names: CBC_RULES
#   rule_texts.h   defines them; for rules.cpp alone
#
# A file begins with "severity: error" (or warning, or note) and the flags that the rule has, each as
# "FLAG: yes". After an empty line comes the summary, and then a section for each text. In summary, Why
# and Mending an empty line separates paragraphs, and line ends are blanks. Settings, Example and Mended
# are taken as they are.
cmake_minimum_required(VERSION 3.21)

set(flags fixed needs-search of-scripts)
set(members is_fixed needs_search is_of_scripts) # of the flags

# fail(TEXT): names the file.
function(fail text)
  message(FATAL_ERROR "${folder}/${name}.md: ${text}")
endfunction()

# take_section(TITLE NEXT): removes the section from `rest`, up to the title NEXT or the end, and puts it
# into `section`.
macro(take_section title next)
  set(heading "## ${title}\n\n")
  string(FIND "${rest}" "${heading}" begin)
  if(NOT begin EQUAL 0)
    fail("expected '## ${title}' and an empty line after the section before")
  endif()
  string(LENGTH "${heading}" begin)
  string(SUBSTRING "${rest}" ${begin} -1 rest)
  set(end -1)
  if(NOT "${next}" STREQUAL "")
    string(FIND "${rest}" "\n## ${next}\n" end)
    if(end EQUAL -1)
      fail("expected a section '## ${next}' after '## ${title}'")
    endif()
  endif()
  string(SUBSTRING "${rest}" 0 ${end} section)
  if(end EQUAL -1)
    set(rest "")
  else()
    math(EXPR end "${end} + 1")
    string(SUBSTRING "${rest}" ${end} -1 rest)
  endif()
endmacro()

# drop_line(): removes the first line from `rest`.
macro(drop_line)
  string(FIND "${rest}" "\n" end)
  math(EXPR end "${end} + 1")
  string(SUBSTRING "${rest}" ${end} -1 rest)
endmacro()

# join_lines(VARIABLE): makes one line of each paragraph.
macro(join_lines variable)
  string(REGEX REPLACE "\n$" "" ${variable} "${${variable}}")
  string(REPLACE "\n\n" "\r" ${variable} "${${variable}}")
  string(REPLACE "\n" " " ${variable} "${${variable}}")
  string(REPLACE "\r" "\n\n" ${variable} "${${variable}}")
endmacro()

file(GLOB paths RELATIVE "${folder}" "${folder}/*.md")
list(TRANSFORM paths REPLACE "\\.md$" "" OUTPUT_VARIABLE names)
list(SORT names)
set(rows "")
set(declarations "")
set(definitions "")
foreach(name IN LISTS names)
  file(READ "${folder}/${name}.md" rest)
  if(NOT rest MATCHES "^severity: (error|warning|note)\n")
    fail("expected 'severity: error', 'severity: warning' or 'severity: note' on the first line")
  endif()
  string(REPLACE "-" "_" identifier "${name}")
  string(APPEND rows " \\\n  row(${identifier})")
  string(APPEND declarations "extern const Rule ${identifier};\n")
  string(APPEND definitions "const Rule ${identifier} = {\n    .name = \"${name}\",\n"
         "    .severity = Severity::${CMAKE_MATCH_1},\n")
  drop_line()
  foreach(flag member IN ZIP_LISTS flags members)
    if(rest MATCHES "^${flag}: yes\n")
      string(APPEND definitions "    .${member} = true,\n")
      drop_line()
    endif()
  endforeach()
  string(FIND "${rest}" "\n## Why\n" end)
  if(NOT rest MATCHES "^\n[^\n]" OR end EQUAL -1)
    fail("expected flags (${flags}; in this order), an empty line, the summary and '## Why'")
  endif()
  string(SUBSTRING "${rest}" 1 ${end} summary)
  math(EXPR end "${end} + 1")
  string(SUBSTRING "${rest}" ${end} -1 rest)
  string(STRIP "${summary}" summary)
  join_lines(summary)
  set(after_why Example)
  if(rest MATCHES "\n## Settings\n")
    set(after_why Settings)
  endif()
  take_section(Why ${after_why})
  join_lines(section)
  string(APPEND definitions "    .summary = R\"rule(${summary})rule\",\n    .explanation = R\"rule(${section})rule\",\n")
  if(after_why STREQUAL Settings)
    take_section(Settings Example)
    string(APPEND definitions "    .settings = R\"rule(${section})rule\",\n")
  endif()
  take_section(Example Mending)
  string(APPEND definitions "    .example = R\"rule(${section})rule\",\n")
  take_section(Mending Mended)
  join_lines(section)
  string(APPEND definitions "    .mending = R\"rule(${section})rule\",\n")
  take_section(Mended "")
  string(APPEND definitions "    .mended = R\"rule(${section})rule\",\n};\n\n")
endforeach()

file(WRITE "${output}/rule_names.h" "#pragma once

// Of the files in src/core/diagnostic/rules; rules.h includes it.

#define CBC_RULES(row)${rows}

namespace cbc::rule {

${declarations}
}  // namespace cbc::rule
")
file(WRITE "${output}/rule_texts.h" "#pragma once

namespace cbc::rule {

${definitions}}  // namespace cbc::rule
")
