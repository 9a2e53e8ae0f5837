# Writes the files below sim/report/page into a C++ file, so that `kbc sim --html` needs no file but itself.
#
#   cmake -DOUT=page_parts.cc -DROOT=.../page "-DIN=page.html|page.css|data.js|..." -P embed_page.cmake
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
"// Made by embed_page.cmake from sim/report/page.
#include \"sim/report/page.h\"

namespace kb::sim::report {

std::span<const PagePart> page_parts() {
  static constexpr PagePart kParts[] = {
${pieces}  };
  return kParts;
}

}  // namespace kb::sim::report
")
file(RENAME ${OUT}.new ${OUT})
