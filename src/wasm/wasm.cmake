# The program for browsers: play.js and play.wasm, in the folder of the build.

file(GLOB play_sources CONFIGURE_DEPENDS src/wasm/*.cpp)
# The commands that a page has a use for: what is not named is not linked.
set(play_folder "${CMAKE_CURRENT_BINARY_DIR}/play_program")
set(rows "")
foreach(command lint compile solve verify graph)
  string(APPEND rows "row(${command}) ")
endforeach()
file(READ src/commands.h commands_header)
string(REGEX REPLACE "#define CBC_COMMANDS[^\n]*\n(  row[^\n]*\n)+" "#define CBC_COMMANDS(row) ${rows}\n" commands_header
       "${commands_header}")
file(CONFIGURE OUTPUT "${play_folder}/commands.h" CONTENT "${commands_header}" @ONLY)
configure_file(src/main.cpp "${play_folder}/main.cpp" COPYONLY)
add_executable(cbc_wasm "${play_folder}/main.cpp" ${play_sources})
target_include_directories(cbc_wasm PRIVATE src)
set_target_properties(cbc_wasm PROPERTIES OUTPUT_NAME play)
target_link_libraries(cbc_wasm PRIVATE cbc_program nlohmann_json::nlohmann_json ${yaml_cpp})
target_link_options(
  cbc_wasm
  PRIVATE
  "SHELL:-s MODULARIZE=1"
  "SHELL:-s EXPORT_NAME=createCbc"
  "SHELL:-s INVOKE_RUN=0"
  "SHELL:-s ALLOW_MEMORY_GROWTH=1"
  "SHELL:-s MAXIMUM_MEMORY=4GB"
  "SHELL:-s TOTAL_STACK=8MB" # as that of a native program: texts may be nested deeply
  "SHELL:-s FORCE_FILESYSTEM=1"
  "SHELL:-s ENVIRONMENT=web,worker,node"
  "SHELL:-s NODEJS_CATCH_EXIT=0" # each instance would add handlers
  "SHELL:-s NODEJS_CATCH_REJECTION=0"
  "SHELL:-s EXPORTED_FUNCTIONS=_main,_cbc_session,_malloc,_free"
  "SHELL:-s EXPORTED_RUNTIME_METHODS=FS,callMain,lengthBytesUTF8,stringToUTF8,UTF8ToString,ENV")
# Debian's Emscripten needs a package of Debian, which a Node.js of others does not find.
set_target_properties(cbc_wasm PROPERTIES RULE_LAUNCH_LINK "${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs")
