# waymark_embed_files(OUT_VAR FUNCTION name TYPE type HEADER header FOLDER folder FILES file...)
#
# Files below FOLDER (relative to the current source folder) become a C++ file, so that a program needs no file but itself. The
# file defines `std::span<const TYPE> FUNCTION()`, which HEADER declares; TYPE is an aggregate of path and text. FUNCTION is
# qualified by its namespace. OUT_VAR receives the path of the file.
#
# This file is also the script that writes it: cmake -DOUT=... -DIN=... -P EmbedFiles.cmake
if(CMAKE_SCRIPT_MODE_FILE)
  set(pieces "")
  string(REPLACE "|" ";" files "${IN}")
  foreach(path IN LISTS files)
    file(READ ${ROOT}/${path} text)
    if(text MATCHES "\\)KB_TEXT\"")
      message(FATAL_ERROR "${path}: `)KB_TEXT\"` cannot be embedded")
    endif()
    string(APPEND pieces "    {\"${path}\", R\"KB_TEXT(${text})KB_TEXT\"},\n")
  endforeach()
  string(REGEX MATCH "^(.*)::([^:]*)$" matched ${FUNCTION})
  file(WRITE ${OUT}.new
"// Made by EmbedFiles.cmake.
#include \"${HEADER}\"

namespace ${CMAKE_MATCH_1} {

std::span<const ${TYPE}> ${CMAKE_MATCH_2}() {
  static constexpr ${TYPE} kFiles[] = {
${pieces}  };
  return kFiles;
}

}  // namespace ${CMAKE_MATCH_1}
")
  file(RENAME ${OUT}.new ${OUT})
  return()
endif()

set(waymark_embed_script ${CMAKE_CURRENT_LIST_FILE})

function(waymark_embed_files out_var)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "FUNCTION;TYPE;HEADER;FOLDER" "FILES")
  string(REGEX REPLACE "^.*::" "" stem ${arg_FUNCTION})
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${stem}.cc)
  set(root ${CMAKE_CURRENT_SOURCE_DIR}/${arg_FOLDER})
  list(JOIN arg_FILES "|" in)
  list(TRANSFORM arg_FILES PREPEND ${root}/ OUTPUT_VARIABLE paths)
  add_custom_command(
    OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DROOT=${root} -DFUNCTION=${arg_FUNCTION} -DTYPE=${arg_TYPE} -DHEADER=${arg_HEADER}
      "-DIN=${in}" -P ${waymark_embed_script}
    DEPENDS ${paths} ${waymark_embed_script}
    COMMENT "Embedding ${arg_FOLDER}"
    VERBATIM)
  set(${out_var} ${out} PARENT_SCOPE)
endfunction()
