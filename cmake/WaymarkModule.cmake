# waymark_module(NAME [OPTIMISED] SOURCES file... [LINKS target...] [PRIVATE target...] [PARSED header...])
#
# One static library for one folder. The folder's headers are included by their path from the root of the project
# ("compiler/syntax/tree.h"), so an include line says where a thing lives; layers.txt says who may include whom. Those that are
# installed are <waymark/runtime/mind.h> here as well. OPTIMISED: it computes for so long that optimising it takes less time than
# testing it without, under sanitizers too. PARSED: a long header that most of its files include is parsed once.
#
# waymark_warnings is what every file of the project is compiled with; a knowledge base that a user compiles is not.
add_library(waymark_warnings INTERFACE)
target_compile_options(waymark_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor -ffp-contract=off)
# g++ 12 sees an overlap in `"text" + std::string` that is not there (its bug 105651), and with -O3 copies beyond all bounds.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(waymark_warnings INTERFACE -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
endif()
# A file that is included by the one that is compiled counts as a header for g++, which then minds its unnamed namespaces.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  target_compile_options(waymark_warnings INTERFACE -Wno-subobject-linkage)
endif()
if(WAYMARK_WERROR)
  target_compile_options(waymark_warnings INTERFACE -Werror)
endif()

# -fno-sanitize-recover: the first finding ends the program, so a test cannot pass over it. Two kinds of checks make a third of the
# code: null pointers, on which the address sanitizer stops all the same, and alignment, which is left out of modules only. They read
# files into memory of their own; the runtime, which maps them, stands in headers, and is tested by programs that check it.
if(WAYMARK_SANITIZE)
  add_compile_options(-fsanitize=${WAYMARK_SANITIZE} -fno-sanitize=null -fno-sanitize-recover=all -fno-omit-frame-pointer)
  # At a fixed address: each check names its place by pointers, and a million and a half of them were moved at every start of kbc.
  add_link_options(-fsanitize=${WAYMARK_SANITIZE} -no-pie)
  find_program(WAYMARK_LLD ld.lld)
  if(WAYMARK_LLD AND CMAKE_CXX_COMPILER_ID STREQUAL Clang)
    add_link_options(-fuse-ld=lld)   # in a fifth of the time
  endif()
endif()

# The same bytes from two builds in two folders: no name of a folder gets into an object file.
add_compile_options(-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=)

# Where several files are compiled at once, these headers are parsed once for all modules of an optimisation level. Elsewhere each file is
# left alone with what it includes, so that a missing include shows.
if(CMAKE_UNITY_BUILD)
  set(WAYMARK_STANDARD_HEADERS <algorithm> <array> <charconv> <cmath> <filesystem> <functional> <map> <memory> <optional> <set> <span>
    <string> <string_view> <unordered_map> <unordered_set> <variant> <vector>)
endif()
function(waymark_parsed_headers name)
  if(TARGET ${name})
    return()
  endif()
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/${name}.cc CONTENT "")
  add_library(${name} OBJECT EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/${name}.cc)
  target_link_libraries(${name} PRIVATE waymark_warnings fmt::fmt nlohmann_json::nlohmann_json)
  target_compile_options(${name} PRIVATE ${ARGN})
  target_precompile_headers(${name} PRIVATE ${WAYMARK_STANDARD_HEADERS} <fmt/format.h> <nlohmann/json.hpp>)
endfunction()

# A program that is compiled as modules are, with their headers.
function(waymark_share_parsed_headers program)
  target_link_libraries(${program} PRIVATE waymark_warnings fmt::fmt nlohmann_json::nlohmann_json)
  if(TARGET waymark_headers)
    target_precompile_headers(${program} REUSE_FROM waymark_headers)
  endif()
endfunction()

function(waymark_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "OPTIMISED" "" "SOURCES;LINKS;PRIVATE;PARSED")
  add_library(${name} STATIC ${arg_SOURCES})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  target_link_libraries(${name} PUBLIC ${arg_LINKS} PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:waymark_warnings>)
  if(WAYMARK_SANITIZE)
    target_compile_options(${name} PRIVATE -fno-sanitize=alignment)
  endif()
  set(headers waymark_headers)
  set(level)
  if(arg_OPTIMISED AND WAYMARK_SANITIZE)
    set(headers waymark_headers_optimised)
    set(level -O1)
  endif()
  target_compile_options(${name} PRIVATE ${level})
  if(arg_PARSED)
    target_precompile_headers(${name} PRIVATE ${WAYMARK_STANDARD_HEADERS} ${arg_PARSED})
  elseif(CMAKE_UNITY_BUILD AND "fmt::fmt" IN_LIST arg_PRIVATE)   # which is where fmt's macros come from
    waymark_parsed_headers(${headers} ${level})
    target_precompile_headers(${name} REUSE_FROM ${headers})
  endif()
endfunction()
