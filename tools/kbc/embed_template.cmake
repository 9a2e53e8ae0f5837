# Writes the files below tools/kbc/template into a C++ file, so that `kbc new` needs no file but itself.
#
#   cmake -DOUT=template.cc -DROOT=.../template "-DIN=@NAME@.kb|tests/..." -P embed_template.cmake
set(pieces "")
string(REPLACE "|" ";" files "${IN}")
foreach(path IN LISTS files)
  file(READ ${ROOT}/${path} text)
  if(text MATCHES "\\)KB_TEXT\"")
    message(FATAL_ERROR "${path}: `)KB_TEXT\"` cannot be embedded")
  endif()
  string(APPEND pieces "    {\"${path}\", R\"KB_TEXT(${text})KB_TEXT\"},\n")
endforeach()
file(WRITE ${OUT}.new
"// Made by embed_template.cmake from tools/kbc/template.
#include \"tools/kbc/template.h\"

namespace kb::cli {

std::span<const TemplateFile> template_files() {
  static constexpr TemplateFile kFiles[] = {
${pieces}  };
  return kFiles;
}

}  // namespace kb::cli
")
file(RENAME ${OUT}.new ${OUT})
