// SPDX-License-Identifier: MIT
#include "file_calls.hpp"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>

namespace file_calls = boxstream::out_of_core_test::file_calls;

namespace {

int open_as_told(const char* name, int flags, mode_t mode) {
  if ((flags & O_TMPFILE) == O_TMPFILE && file_calls::refuse_nameless) {
    errno = EOPNOTSUPP;
    return -1;
  }
  return static_cast<int>(syscall(SYS_openat, AT_FDCWD, name, flags, mode));
}

ssize_t write_as_told(int descriptor, const void* data, std::size_t bytes, long at) {
  static bool was_interrupted = false;
  if (file_calls::interrupt && !(was_interrupted = !was_interrupted)) {
    errno = EINTR;
    return -1;
  }
  if (bytes != 0 && file_calls::room == 0) {
    errno = ENOSPC;
    return -1;
  }
  bytes = static_cast<std::size_t>(std::min<std::uint64_t>(bytes, file_calls::room));
  const ssize_t written = syscall(SYS_pwrite64, descriptor, data, bytes, at);
  if (written > 0 && file_calls::room != file_calls::unlimited) file_calls::room -= static_cast<std::uint64_t>(written);
  return written;
}

mode_t mode_of(int flags, va_list rest) {
  const bool makes_one = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
  return makes_one ? static_cast<mode_t>(va_arg(rest, int)) : 0;
}

}  // namespace

// Files with offsets of 64 bits have names of their own in the C library.
extern "C" {

int open(const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  return open_as_told(name, flags, mode);
}

int open64(const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  return open_as_told(name, flags, mode);
}

ssize_t pwrite(int descriptor, const void* data, std::size_t bytes, off_t at) {
  return write_as_told(descriptor, data, bytes, at);
}

ssize_t pwrite64(int descriptor, const void* data, std::size_t bytes, off64_t at) {
  return write_as_told(descriptor, data, bytes, at);
}
}
