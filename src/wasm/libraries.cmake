# The libraries of the program for WebAssembly. Debian has none for it: headers come through a folder of links, as
# what else is in /usr/include is for another system, and yaml-cpp is compiled from Debian's source package, which
# ./dev play unpacks.

set(CBC_YAML_CPP_SOURCE "${PROJECT_SOURCE_DIR}/build/yaml-cpp" CACHE PATH "Unpacked source of yaml-cpp")
if(NOT EXISTS "${CBC_YAML_CPP_SOURCE}/include/yaml-cpp/yaml.h")
  message(FATAL_ERROR "CBC_YAML_CPP_SOURCE: expected the source of yaml-cpp in ${CBC_YAML_CPP_SOURCE}; "
                      "./dev play unpacks it")
endif()

set(library_headers "${CMAKE_CURRENT_BINARY_DIR}/library_headers")
file(MAKE_DIRECTORY "${library_headers}")
foreach(header boost CLI flatbuffers fmt nlohmann xxhash.h)
  if(NOT EXISTS "/usr/include/${header}")
    message(FATAL_ERROR "/usr/include/${header} is missing")
  endif()
  file(CREATE_LINK "/usr/include/${header}" "${library_headers}/${header}" SYMBOLIC)
endforeach()
set(xxhash_include "${library_headers}")

foreach(library Boost::headers CLI11::CLI11 flatbuffers::flatbuffers fmt::fmt-header-only nlohmann_json::nlohmann_json
                Threads::Threads)
  add_library(${library} INTERFACE IMPORTED)
  target_include_directories(${library} SYSTEM INTERFACE "${library_headers}")
endforeach()
target_compile_definitions(fmt::fmt-header-only INTERFACE FMT_HEADER_ONLY=1)
set(fmt fmt::fmt-header-only)

find_program(flatc flatc REQUIRED)
add_executable(flatbuffers::flatc IMPORTED)
set_target_properties(flatbuffers::flatc PROPERTIES IMPORTED_LOCATION "${flatc}")

file(GLOB yaml_cpp_sources "${CBC_YAML_CPP_SOURCE}/src/*.cpp")
add_library(yaml-cpp STATIC ${yaml_cpp_sources})
target_compile_features(yaml-cpp PUBLIC cxx_std_20)
target_compile_definitions(yaml-cpp PUBLIC YAML_CPP_STATIC_DEFINE)
target_include_directories(yaml-cpp SYSTEM PUBLIC "${CBC_YAML_CPP_SOURCE}/include")
target_compile_options(yaml-cpp PRIVATE -w)
set(yaml_cpp yaml-cpp)
