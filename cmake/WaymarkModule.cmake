# waymark_module(NAME SOURCES file... [LINKS target...] [PRIVATE target...])
#
# One static library for one folder. The folder's headers are included by their path from the root of the project
# ("compiler/syntax/tree.h"), so an include line says where a thing lives; layers.txt says who may include whom. Those that are
# installed are <waymark/runtime/mind.h> here as well.
#
# waymark_warnings is what every file of the project is compiled with; a knowledge base that a user compiles is not.
add_library(waymark_warnings INTERFACE)
target_compile_options(waymark_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor -ffp-contract=off)
# g++ 12 sees an overlap in `"text" + std::string` that is not there (its bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(waymark_warnings INTERFACE -Wno-restrict)
endif()
# A file that is included by the one that is compiled counts as a header for g++, which then minds its unnamed namespaces.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  target_compile_options(waymark_warnings INTERFACE -Wno-subobject-linkage)
endif()
if(WAYMARK_WERROR)
  target_compile_options(waymark_warnings INTERFACE -Werror)
endif()

# -fno-sanitize-recover: the first finding ends the program, so a test cannot pass over it.
if(WAYMARK_SANITIZE)
  add_compile_options(-fsanitize=${WAYMARK_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  # At a fixed address: each check names its place by pointers, and a million and a half of them were moved at every start of kbc.
  add_link_options(-fsanitize=${WAYMARK_SANITIZE} -no-pie)
  find_program(WAYMARK_LLD ld.lld)
  if(WAYMARK_LLD AND CMAKE_CXX_COMPILER_ID STREQUAL Clang)
    add_link_options(-fuse-ld=lld)   # in a fifth of the time
  endif()
endif()

# The same bytes from two builds in two folders: no name of a folder gets into an object file.
add_compile_options(-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=)

function(waymark_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LINKS;PRIVATE")
  add_library(${name} STATIC ${arg_SOURCES})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  target_link_libraries(${name} PUBLIC ${arg_LINKS} PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:waymark_warnings>)
endfunction()
