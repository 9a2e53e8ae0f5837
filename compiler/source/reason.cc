#include "compiler/source/reason.h"

#include <cerrno>

namespace kb::source {

std::string reason(int error) {
  switch (error) {
    case ENOENT: return "no such file";
    case EACCES:
    case EPERM: return "permission denied";
    case EEXIST: return "is there already";
    case EISDIR: return "is a directory";
    case ENOTDIR: return "a part of the path is not a directory";
    case ENOSPC: return "no space left on the disk";
    case EDQUOT: return "the quota of the disk is used up";
    case EFBIG: return "it is too large for the disk";
    case EROFS: return "the file system is read-only";
    case ESTALE: return "the server of its file system does not know it any more";
    case EIO: return "input/output error";
    case ELOOP: return "too many symbolic links";
    case ENAMETOOLONG: return "the name is too long";
    case EPIPE: return "nobody reads it any more";
    case EMFILE:
    case ENFILE: return "too many open files";
    case EBADF: return "it is not open";
    case ENXIO:
    case ENODEV: return "is not a regular file";
    case EOVERFLOW: return "is too large";
    case ENOMEM: return "out of memory";
    case EBUSY: return "something else is mounted there, or holds it";
    case EXDEV: return "lies on another file system";
    case ETXTBSY: return "is a program that runs";
    case EINVAL: return "the file system refuses this";
    case ECONNREFUSED: return "connection refused";
    case ECONNRESET: return "connection reset";
    case ETIMEDOUT: return "no answer in time";
    case EHOSTUNREACH:
    case ENETUNREACH: return "no way leads there";
    default: return "error " + std::to_string(error) + " of the operating system";
  }
}

}  // namespace kb::source
