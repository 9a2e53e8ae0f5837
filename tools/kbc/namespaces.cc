// Which names can be the namespace of emitted C++.
#include <algorithm>
#include <iterator>

#include "compiler/emit/names.h"
#include "compiler/syntax/syntax.h"
#include "tools/kbc/support.h"

namespace kb::cli {
namespace {

/// Names that the C library declares outside of `std`. Nearly every program includes some of its headers, by way of <string> or <thread>. Those of
/// glibc 2.36; made with clang++ -Xclang -ast-dump, of <bits/stdc++.h>, <strings.h> and <unistd.h>.
constexpr std::string_view kNames[] = {
      "FILE", "a64l", "abort", "abs", "access", "acct", "acos", "acosh", "adjtime", "alarm", "aligned_alloc", "alloca", "arc4random",
      "arc4random_buf", "arc4random_uniform", "asctime", "asin", "asinh", "asprintf", "at_quick_exit", "atan", "atan2", "atanh", "atexit", "atof",
      "atoi", "atol", "basename", "bcmp", "bcopy", "bind_textdomain_codeset", "bindtextdomain", "brk", "bsearch", "btowc", "bzero", "c16rtomb",
      "c32rtomb", "c8rtomb", "calloc", "canonicalize", "canonicalize_file_name", "cbrt", "ceil", "chdir", "chown", "chroot", "clearenv", "clearerr",
      "clock", "clock_adjtime", "clock_getcpuclockid", "clock_getres", "clock_gettime", "clock_nanosleep", "clock_settime", "clone", "close",
      "close_range", "closefrom", "confstr", "copy_file_range", "copysign", "cos", "cosh", "crypt", "ctermid", "ctime", "cuserid", "daddl", "daemon",
      "daylight", "dcgettext", "dcngettext", "ddivl", "dfmal", "dgettext", "difftime", "div", "dmull", "dngettext", "dprintf", "drand48",
      "drand48_data", "drem", "dsqrtl", "dsubl", "dup", "dup2", "dup3", "duplocale", "dysize", "eaccess", "ecvt", "endusershell", "environ",
      "erand48", "erf", "erfc", "euidaccess", "execl", "execle", "execlp", "execv", "execve", "execveat", "execvp", "execvpe", "exit", "exp", "exp10",
      "exp2", "explicit_bzero", "expm1", "fabs", "faccessat", "fadd", "fchdir", "fchown", "fchownat", "fclose", "fcloseall", "fcvt", "fd_mask",
      "fd_set", "fdatasync", "fdim", "fdiv", "fdopen", "feclearexcept", "fedisableexcept", "feenableexcept", "fegetenv", "fegetexcept",
      "fegetexceptflag", "fegetmode", "fegetround", "feholdexcept", "feof", "feraiseexcept", "ferror", "fesetenv", "fesetexcept", "fesetexceptflag",
      "fesetmode", "fesetround", "fetestexcept", "fetestexceptflag", "feupdateenv", "fexecve", "fflush", "ffma", "ffs", "fgetc", "fgetpos", "fgets",
      "fgetwc", "fgetws", "fileno", "finite", "flockfile", "floor", "fma", "fmax", "fmaximum", "fmaximum_mag", "fmaximum_mag_num", "fmaximum_num",
      "fmaxmag", "fmemopen", "fmin", "fminimum", "fminimum_mag", "fminimum_mag_num", "fminimum_num", "fminmag", "fmod", "fmul", "fopen",
      "fopencookie", "fork", "fpathconf", "fprintf", "fputc", "fputs", "fputwc", "fputws", "fread", "free", "freelocale", "freopen", "frexp",
      "fromfp", "fromfpx", "fscanf", "fseek", "fseeko", "fsetpos", "fsqrt", "fsub", "fsync", "ftell", "ftello", "ftruncate", "ftrylockfile",
      "funlockfile", "futimes", "futimesat", "fwide", "fwprintf", "fwrite", "fwscanf", "gamma", "gcvt", "get_current_dir_name", "getc", "getchar",
      "getcpu", "getcwd", "getdate", "getdate_err", "getdelim", "getdomainname", "getdtablesize", "getegid", "getentropy", "getenv", "geteuid",
      "getgid", "getgroups", "gethostid", "gethostname", "getitimer", "getline", "getloadavg", "getlogin", "getopt", "getpagesize", "getpass",
      "getpayload", "getpgid", "getpgrp", "getpid", "getppid", "getpt", "getresgid", "getresuid", "getsid", "getsubopt", "gettext", "gettid",
      "gettimeofday", "getuid", "getusershell", "getw", "getwc", "getwchar", "getwd", "gmtime", "grantpt", "group_member", "gsignal", "hypot",
      "ilogb", "imaxabs", "imaxdiv", "index", "initstate", "isalnum", "isalpha", "isascii", "isatty", "isblank", "iscanonical", "iscntrl", "isctype",
      "isdigit", "iseqsig", "isgraph", "isinff", "isinfl", "islower", "isnanf", "isnanl", "isprint", "ispunct", "issignaling", "isspace", "isupper",
      "iswalnum", "iswalpha", "iswblank", "iswcntrl", "iswctype", "iswdigit", "iswgraph", "iswlower", "iswprint", "iswpunct", "iswspace", "iswupper",
      "iswxdigit", "isxdigit", "iszero", "itimerspec", "itimerval", "j0", "j1", "jmp_buf", "jn", "jrand48", "kill", "killpg", "l64a", "labs",
      "lchown", "lcong48", "lconv", "ldexp", "ldiv", "lgamma", "link", "linkat", "llabs", "lldiv", "llogb", "llrint", "llround", "localeconv",
      "localtime", "lockf", "log", "log10", "log1p", "log2", "logb", "longjmp", "lrand48", "lrint", "lround", "lseek", "lutimes", "malloc", "mblen",
      "mbrlen", "mbrtoc16", "mbrtoc32", "mbrtoc8", "mbrtowc", "mbsinit", "mbsnrtowcs", "mbsrtowcs", "mbstowcs", "mbtowc", "memccpy", "memchr",
      "memcmp", "memcpy", "memfrob", "memmem", "memmove", "mempcpy", "memrchr", "memset", "mkdtemp", "mkostemp", "mkostemps", "mkstemp", "mkstemps",
      "mktemp", "mktime", "modf", "mrand48", "nan", "nanosleep", "nearbyint", "newlocale", "nextafter", "nextdown", "nexttoward", "nextup",
      "ngettext", "nice", "nrand48", "obstack", "obstack_printf", "obstack_vprintf", "on_exit", "open_memstream", "open_wmemstream", "optarg",
      "opterr", "optind", "optopt", "pathconf", "pause", "pclose", "perror", "pipe", "pipe2", "popen", "posix_memalign", "posix_openpt", "pow",
      "pread", "printf", "profil", "program_invocation_name", "program_invocation_short_name", "pselect", "psiginfo", "psignal", "ptsname", "putc",
      "putchar", "putenv", "puts", "putw", "putwc", "putwchar", "pwrite", "qecvt", "qfcvt", "qgcvt", "qsort", "quick_exit", "raise", "rand", "random",
      "random_data", "rawmemchr", "read", "readlink", "readlinkat", "realloc", "reallocarray", "realpath", "remainder", "remove", "remquo", "rename",
      "renameat", "renameat2", "revoke", "rewind", "rindex", "rint", "rmdir", "round", "roundeven", "rpmatch", "sbrk", "scalb", "scalbln", "scalbn",
      "scanf", "sched_get_priority_max", "sched_get_priority_min", "sched_getaffinity", "sched_getcpu", "sched_getparam", "sched_getscheduler",
      "sched_param", "sched_rr_get_interval", "sched_setaffinity", "sched_setparam", "sched_setscheduler", "sched_yield", "secure_getenv", "seed48",
      "select", "sem_clockwait", "sem_close", "sem_destroy", "sem_getvalue", "sem_init", "sem_open", "sem_post", "sem_timedwait", "sem_trywait",
      "sem_unlink", "sem_wait", "setbuf", "setbuffer", "setdomainname", "setegid", "setenv", "seteuid", "setgid", "sethostid", "sethostname",
      "setitimer", "setjmp", "setlinebuf", "setlocale", "setlogin", "setns", "setpayload", "setpayloadsig", "setpgid", "setpgrp", "setregid",
      "setresgid", "setresuid", "setreuid", "setsid", "setstate", "settimeofday", "setuid", "setusershell", "setvbuf", "sigabbrev_np", "sigaction",
      "sigaddset", "sigaltstack", "sigandset", "sigblock", "sigcontext", "sigdelset", "sigdescr_np", "sigemptyset", "sigevent", "sigfillset",
      "siggetmask", "sighold", "sigignore", "siginterrupt", "sigisemptyset", "sigismember", "sigjmp_buf", "siglongjmp", "signal", "signgam",
      "significand", "sigorset", "sigpause", "sigpending", "sigprocmask", "sigqueue", "sigrelse", "sigreturn", "sigset", "sigsetmask", "sigstack",
      "sigsuspend", "sigtimedwait", "sigval", "sigwait", "sigwaitinfo", "sin", "sincos", "sinh", "sleep", "snprintf", "sprintf", "sqrt", "srand",
      "srand48", "srandom", "sscanf", "ssignal", "stderr", "stdin", "stdout", "stpcpy", "stpncpy", "strcasecmp", "strcasestr", "strcat", "strchr",
      "strchrnul", "strcmp", "strcoll", "strcpy", "strcspn", "strdup", "strerror", "strerrordesc_np", "strerrorname_np", "strfromd", "strfromf",
      "strfromf32", "strfroml", "strfry", "strftime", "strlen", "strncasecmp", "strncat", "strncmp", "strncpy", "strndup", "strnlen", "strpbrk",
      "strptime", "strrchr", "strsep", "strsignal", "strspn", "strstr", "strtod", "strtof", "strtof32", "strtoimax", "strtok", "strtol", "strtold",
      "strtoq", "strtoul", "strtoumax", "strtouq", "strverscmp", "strxfrm", "swab", "swprintf", "swscanf", "symlink", "symlinkat", "sync", "syncfs",
      "syscall", "sysconf", "system", "sysv_signal", "tan", "tanh", "tcgetpgrp", "tcsetpgrp", "tempnam", "textdomain", "tgamma", "tgkill", "time",
      "timegm", "timelocal", "timer_create", "timer_delete", "timer_getoverrun", "timer_gettime", "timer_settime", "timespec", "timespec_get",
      "timespec_getres", "timeval", "timex", "timezone", "tm", "tmpfile", "tmpnam", "toascii", "tolower", "totalorder", "totalordermag", "toupper",
      "towctrans", "towlower", "towupper", "trunc", "truncate", "ttyname", "ttyslot", "tzname", "tzset", "u_char", "u_int", "u_long", "u_short",
      "ualarm", "ufromfp", "ufromfpx", "uint", "ulong", "ungetc", "ungetwc", "unlink", "unlinkat", "unlockpt", "unsetenv", "unshare", "uselocale",
      "ushort", "usleep", "utimes", "va_list", "valloc", "vasprintf", "vdprintf", "vfork", "vfprintf", "vfscanf", "vfwprintf", "vfwscanf", "vhangup",
      "vprintf", "vscanf", "vsnprintf", "vsprintf", "vsscanf", "vswprintf", "vswscanf", "vwprintf", "vwscanf", "wcpcpy", "wcpncpy", "wcrtomb",
      "wcscasecmp", "wcscat", "wcschr", "wcschrnul", "wcscmp", "wcscoll", "wcscpy", "wcscspn", "wcsdup", "wcsftime", "wcslen", "wcsncasecmp",
      "wcsncat", "wcsncmp", "wcsncpy", "wcsnlen", "wcsnrtombs", "wcspbrk", "wcsrchr", "wcsrtombs", "wcsspn", "wcsstr", "wcstod", "wcstof", "wcstof32",
      "wcstoimax", "wcstok", "wcstol", "wcstold", "wcstombs", "wcstoq", "wcstoul", "wcstoumax", "wcstouq", "wcswcs", "wcswidth", "wcsxfrm", "wctob",
      "wctomb", "wctrans", "wctype", "wcwidth", "wmemchr", "wmemcmp", "wmemcpy", "wmemmove", "wmempcpy", "wmemset", "wprintf", "write", "wscanf",
      "y0", "y1", "yn"};

/// Whether it is one of them, or of the families that are left out above: types, and the variants of a function for other types and locales.
bool is_of_the_c_library(std::string_view name) {
  if (name.ends_with("_t") || name.starts_with("pthread_")) return true;
  const auto known = [](std::string_view one) { return std::binary_search(std::begin(kNames), std::end(kNames), one); };
  constexpr std::string_view kVariants[] = {"64", "_l", "_r", "_unlocked", "f", "f32", "f32x", "f64", "f64x", "l"};
  return known(name) || std::any_of(std::begin(kVariants), std::end(kVariants), [&](std::string_view variant) {
           return name.ends_with(variant) && known(name.substr(0, name.size() - variant.size()));
         });
}

bool is_one_namespace(std::string_view name) {
  const bool taken = name == "kb" || name == "mts" || name == "std";
  const bool foreign = std::any_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
  return !name.empty() && !taken && (name[0] < '0' || name[0] > '9') && emit::identifier(name) == name && (!foreign || syntax::is_name(name));
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
