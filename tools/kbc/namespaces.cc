// Which names can be the namespace of emitted C++.
#include <algorithm>
#include <iterator>

#include "compiler/emit/names.h"
#include "tools/kbc/support.h"

namespace kb::cli {
namespace {

/// Names that <cstdint> and <cstdio> also declare outside of `std`. Emitted headers include the first, nearly every program the second.
bool is_of_the_c_library(std::string_view name) {
  constexpr std::string_view kNames[] = {
      "FILE", "asprintf", "clearerr", "cookie_close_function_t", "cookie_io_functions_t", "cookie_read_function_t", "cookie_seek_function_t",
      "cookie_write_function_t", "ctermid", "cuserid", "dprintf", "fclose", "fcloseall", "fdopen", "feof", "ferror", "fflush", "fgetc", "fgetpos",
      "fgets", "fileno", "flockfile", "fmemopen", "fopen", "fopencookie", "fpos64_t", "fpos_t", "fprintf", "fputc", "fputs", "fread", "freopen",
      "fscanf", "fseek", "fseeko", "fsetpos", "ftell", "ftello", "ftrylockfile", "funlockfile", "fwrite", "getc", "getchar", "getdelim", "getline",
      "getw", "max_align_t", "nullptr_t", "obstack", "obstack_printf", "obstack_vprintf", "off64_t", "off_t", "open_memstream", "pclose", "perror",
      "popen", "printf", "ptrdiff_t", "putc", "putchar", "puts", "putw", "remove", "rename", "renameat", "renameat2", "rewind", "scanf", "setbuf",
      "setbuffer", "setlinebuf", "setvbuf", "size_t", "snprintf", "sprintf", "sscanf", "ssize_t", "stderr", "stdin", "stdout", "tempnam", "tmpfile",
      "tmpnam", "tmpnam_r", "ungetc", "va_list", "vasprintf", "vdprintf", "vfprintf", "vfscanf", "vprintf", "vscanf", "vsnprintf", "vsprintf",
      "vsscanf"};
  if ((name.starts_with("int") || name.starts_with("uint")) && name.ends_with("_t")) return true;
  for (const std::string_view more : {"_unlocked", "64"}) {
    if (name.ends_with(more)) name.remove_suffix(more.size());
  }
  return std::binary_search(std::begin(kNames), std::end(kNames), name);
}

bool is_one_namespace(std::string_view name) {
  const bool taken = name == "kb" || name == "mts" || name == "std";
  return !name.empty() && !taken && (name[0] < '0' || name[0] > '9') && emit::identifier(name) == name;
}

}  // namespace

bool is_namespace(std::string_view name) {
  if (is_of_the_c_library(name.substr(0, name.find("::")))) return false;
  for (auto colons = name.find("::"); colons != std::string_view::npos; colons = name.find("::")) {
    if (!is_one_namespace(name.substr(0, colons))) return false;
    name.remove_prefix(colons + 2);
  }
  return is_one_namespace(name);
}

}  // namespace kb::cli
