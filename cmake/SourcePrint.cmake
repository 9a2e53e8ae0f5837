# waymark_source_print(OUT_VAR FUNCTION name HEADER header FOLDERS folder...)
#
# A C++ file that defines `const char* FUNCTION()`, declared by HEADER: 16 hexadecimal digits that change with any source below FOLDERS
# (relative to the project), and with the compiler. FUNCTION is qualified by its namespace. OUT_VAR receives the path of the file.
#
# This file is also the script that writes it: cmake -DOUT=... -DLIST=... -P SourcePrint.cmake
if(CMAKE_SCRIPT_MODE_FILE)
  file(STRINGS ${LIST} lines)
  list(POP_FRONT lines function header root all)
  foreach(path IN LISTS lines)
    file(SHA256 ${root}/${path} bytes)
    string(APPEND all "\n${path} ${bytes}")
  endforeach()
  string(SHA256 all "${all}")
  string(SUBSTRING ${all} 0 16 print)
  string(REGEX MATCH "^(.*)::([^:]*)$" matched ${function})
  file(WRITE ${OUT} "// Made by SourcePrint.cmake.\n#include \"${header}\"\n\nnamespace ${CMAKE_MATCH_1} {\n\nconst char* ${CMAKE_MATCH_2}() { return \"${print}\"; }\n\n}  // namespace ${CMAKE_MATCH_1}\n")
  return()
endif()

set(waymark_source_print_script ${CMAKE_CURRENT_LIST_FILE})

function(waymark_source_print out_var)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "FUNCTION;HEADER" "FOLDERS")
  set(patterns "")
  foreach(ending cc h def re yy kb)
    foreach(folder IN LISTS arg_FOLDERS)
      list(APPEND patterns ${PROJECT_SOURCE_DIR}/${folder}/*.${ending})
    endforeach()
  endforeach()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${patterns})
  string(REGEX REPLACE "^.*::" "" stem ${arg_FUNCTION})
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${stem}.cc)
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${stem}.txt)
  list(JOIN sources "\n" lines)
  file(GENERATE OUTPUT ${list} CONTENT
    "${arg_FUNCTION}\n${arg_HEADER}\n${PROJECT_SOURCE_DIR}\n${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_SYSTEM_PROCESSOR}\n${lines}\n")
  list(TRANSFORM sources PREPEND ${PROJECT_SOURCE_DIR}/)
  add_custom_command(
    OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DLIST=${list} -P ${waymark_source_print_script}
    DEPENDS ${sources} ${list} ${waymark_source_print_script}
    COMMENT "Printing the sources"
    VERBATIM)
  set(${out_var} ${out} PARENT_SCOPE)
endfunction()
