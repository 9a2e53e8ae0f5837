#include "compiler/emit/reserved_words.h"

namespace kb::emit {
namespace {

// Each list begins and ends with a blank.
constexpr std::string_view kKeywords =
    " alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t char32_t char8_t class co_await co_return co_yield"
    " compl concept const const_cast consteval constexpr constinit continue contract_assert decltype default delete do double dynamic_cast"
    " else enum explicit export extern false float for friend goto if inline int long mutable namespace new noexcept not not_eq nullptr"
    " operator or or_eq private protected public register reinterpret_cast requires return short signed sizeof static static_assert"
    " static_cast struct switch template this thread_local throw true try typedef typeid typename typeof union unsigned using virtual void"
    " volatile wchar_t while xor xor_eq main mts std ";

constexpr std::string_view kMacros =
    " BIG_ENDIAN BUFSIZ CHAR_BIT DECIMAL_DIG EOF FALSE FILENAME_MAX FOPEN_MAX INFINITY LITTLE_ENDIAN LONG_BIT L_tmpnam MAXFLOAT MB_CUR_MAX"
    " MB_LEN_MAX NAN NDEBUG NULL SEEK_CUR SEEK_END SEEK_SET SSIZE_MAX TIME_UTC TMP_MAX TRUE WEOF WORD_BIT alloca assert errno"
    " math_errhandling offsetof setjmp stderr stdin stdout va_arg va_copy va_end va_start"
    // Machines and systems, where GNU's extensions are on.
    " AVR MIPSEB MIPSEL PPC WIN32 WIN64 WINNT hppa i386 linux m68k mc68000 mips powerpc sparc unix ";

// Without their `E`. Not every name that begins so, as the C standard has it: EAST and ERROR are good names.
constexpr std::string_view kErrors =
    " 2BIG ACCES ADDRINUSE ADDRNOTAVAIL ADV AFNOSUPPORT AGAIN ALREADY BADE BADF BADFD BADMSG BADR BADRQC BADSLT BFONT BUSY CANCELED CHILD"
    " CHRNG COMM CONNABORTED CONNREFUSED CONNRESET DEADLK DEADLOCK DESTADDRREQ DOM DOTDOT DQUOT EXIST FAULT FBIG HOSTDOWN HOSTUNREACH"
    " HWPOISON IDRM ILSEQ INPROGRESS INTR INVAL IO ISCONN ISDIR ISNAM KEYEXPIRED KEYREJECTED KEYREVOKED L2HLT L2NSYNC L3HLT L3RST LIBACC"
    " LIBBAD LIBEXEC LIBMAX LIBSCN LNRNG LOOP MEDIUMTYPE MFILE MLINK MSGSIZE MULTIHOP NAMETOOLONG NAVAIL NETDOWN NETRESET NETUNREACH"
    " NFILE NOANO NOBUFS NOCSI NODATA NODEV NOENT NOEXEC NOKEY NOLCK NOLINK NOMEDIUM NOMEM NOMSG NONET NOPKG NOPROTOOPT NOSPC NOSR NOSTR"
    " NOSYS NOTBLK NOTCONN NOTDIR NOTEMPTY NOTNAM NOTRECOVERABLE NOTSOCK NOTSUP NOTTY NOTUNIQ NXIO OPNOTSUPP OVERFLOW OWNERDEAD PERM"
    " PFNOSUPPORT PIPE PROTO PROTONOSUPPORT PROTOTYPE RANGE REMCHG REMOTE REMOTEIO RESTART RFKILL ROFS SHUTDOWN SOCKTNOSUPPORT SPIPE SRCH"
    " SRMNT STALE STRPIPE TIME TIMEDOUT TOOMANYREFS TXTBSY UCLEAN UNATCH USERS WOULDBLOCK XDEV XFULL ";

// Without their `SIG`: SIGN and SIGHT are good names, too.
constexpr std::string_view kSignals =
    " ABRT ALRM BUS CHLD CLD CONT FPE HUP ILL INT IO IOT KILL PIPE POLL PROF PWR QUIT RTMAX RTMIN SEGV STKFLT STKSZ STOP SYS TERM TRAP TSTP"
    " TTIN TTOU URG USR1 USR2 VTALRM WINCH XCPU XFSZ ";

// Macros that come in families: by how they begin, or by how they begin and end.
constexpr std::string_view kFamilies =
    " ATOMIC_ CLOCK_ CLOCKS_ DBL_ EXIT_ FE_ FLT_ FP_ HUGE_VAL KB_FLEET_ LC_ LDBL_ MATH_ M_ SIG_ ";
constexpr std::string_view kIntegers =
    " BOOL CHAR INT LLONG LONG PTRDIFF RAND SCHAR SHRT SIG_ATOMIC SIZE UCHAR UINT ULLONG ULONG USHRT WCHAR WINT ";
constexpr std::string_view kOfIntegers = " _C _MAX _MIN _WIDTH ";
// <cinttypes>: `PRIu32`, `SCNxLEAST16`.
constexpr std::string_view kFormats = " PRIX PRId PRIi PRIo PRIu PRIx SCNd SCNi SCNo SCNu SCNx ";
constexpr std::string_view kFormatted = " 16 32 64 8 FAST16 FAST32 FAST64 FAST8 LEAST16 LEAST32 LEAST64 LEAST8 MAX PTR ";

template <class Test>
bool any_of(std::string_view words, Test&& test) {
  for (words.remove_prefix(1); !words.empty(); words.remove_prefix(words.find(' ') + 1)) {
    if (test(words.substr(0, words.find(' ')))) return true;
  }
  return false;
}

// Without looking at each word: every name of a program is asked for.
bool is_one_of(std::string_view words, std::string_view name) {
  if (name.empty()) return false;
  for (std::size_t at = words.find(name); at != std::string_view::npos; at = words.find(name, at + 1)) {
    if (words[at - 1] == ' ' && words[at + name.size()] == ' ') return true;
  }
  return false;
}

bool begins_as_one_of(std::string_view words, std::string_view name) {
  return any_of(words, [name](std::string_view word) { return name.starts_with(word); });
}

}  // namespace

bool is_reserved(std::string_view name) {
  if (is_one_of(kKeywords, name) || is_one_of(kMacros, name) || begins_as_one_of(kFamilies, name)) return true;
  if (name.starts_with('E') && is_one_of(kErrors, name.substr(1))) return true;
  if (name.starts_with("SIG") && is_one_of(kSignals, name.substr(3))) return true;
  if (name.size() > 4 && is_one_of(kFormats, name.substr(0, 4)) && is_one_of(kFormatted, name.substr(4))) return true;
  return begins_as_one_of(kIntegers, name) && any_of(kOfIntegers, [name](std::string_view end) { return name.ends_with(end); });
}

}  // namespace kb::emit
