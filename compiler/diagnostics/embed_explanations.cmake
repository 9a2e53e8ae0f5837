# Writes the explanations into a C++ file, so that `kbc explain` needs no file but itself.
#
#   cmake -DOUT=explanations.cc "-DIN=lexis.txt|syntax.txt|..." -P embed_explanations.cmake
#
# The form of compiler/diagnostics/explanations/FAMILY.txt: what stands before the first section is a comment; then for
# each error and warning of kinds_FAMILY.def one section, in the order of the codes:
#
#   == KB0301
#   What it means in a sentence or two, in the words of the user, with the reason why the language is like that.
#   Markdown; no headings.
#
#   Wrong:
#   ```kb
#   fact Line
#   rule r at drive when Lnie then -Driving
#   ```
#
#   Right:
#   ```kb
#   fact Line
#   rule r at drive when Line then -Driving
#   ```
#
#   What else helps, if anything does.
#
# `Wrong:` and `Right:` stand alone on their lines, a fenced block right after each; the fence says `kb`, or `csv`,
# `json`, `sh`, `text` where the mistake is not in a knowledge base. Lines of 100 columns at most. A missing file is passed over.
# The unit test of this folder says which sections are missing.
set(pieces "")
string(REPLACE "|" ";" files "${IN}")
foreach(file IN LISTS files)
  if(NOT EXISTS ${file})
    continue()
  endif()
  file(READ ${file} text)
  if(text MATCHES "\\)KB_TEXT\"")
    message(FATAL_ERROR "${file}: `)KB_TEXT\"` cannot be embedded")
  endif()
  # One literal a section: no compiler must take a literal of more than 65,536 bytes.
  string(REPLACE "\n== KB" "\n)KB_TEXT\",\nR\"KB_TEXT(== KB" text "${text}")
  string(APPEND pieces "R\"KB_TEXT(${text})KB_TEXT\",\n")
endforeach()
file(WRITE ${OUT}.new
"// Made by embed_explanations.cmake from compiler/diagnostics/explanations/*.txt.
#include \"compiler/diagnostics/explanations.h\"

namespace kb::diagnostics {

constexpr std::string_view kPieces[] = {
${pieces}\"\"};

std::span<const std::string_view> explanation_pieces() { return kPieces; }

}  // namespace kb::diagnostics
")
file(RENAME ${OUT}.new ${OUT})
