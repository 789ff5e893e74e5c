// SPDX-License-Identifier: MIT
#include "out_of_core/nameless_file.hpp"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <system_error>

#ifdef _WIN32
#include <io.h>
#include <share.h>
#include <sys/stat.h>
#include <random>
#else
#include <unistd.h>
#endif

namespace boxstream::detail {

namespace {

/// Not std::filesystem::path, which terminates the program when memory runs out (libstdc++ 12).
std::string folder_or_default(const std::string& directory) {
  if (!directory.empty()) return directory;
  for (const char* const variable : {"TMPDIR", "TMP", "TEMP", "TEMPDIR"})
    if (const char* const folder = std::getenv(variable); folder != nullptr && *folder != '\0') return folder;
  return "/tmp";
}

// These return -1 and set errno where they fail.
#ifdef _WIN32

/// The file goes with its only handle.
int open_nameless(const std::string& directory) {
  std::random_device random;
  int descriptor = -1;
  do {
    const std::string name = directory + "/boxstream-" + std::to_string(random()) + std::to_string(random()) + ".tmp";
    errno = _sopen_s(&descriptor, name.c_str(),
                     _O_RDWR | _O_BINARY | _O_CREAT | _O_EXCL | _O_TEMPORARY | _O_SHORT_LIVED | _O_NOINHERIT,
                     _SH_DENYRW, _S_IREAD | _S_IWRITE);
  } while (descriptor < 0 && errno == EEXIST);
  return descriptor;
}

void close_file(int descriptor) {
  _close(descriptor);
}

std::ptrdiff_t write_some(int descriptor, const char* data, std::size_t bytes, std::uint64_t at) {
  if (_lseeki64(descriptor, static_cast<std::int64_t>(at), SEEK_SET) < 0) return -1;
  return _write(descriptor, data, static_cast<unsigned>(std::min<std::size_t>(bytes, INT_MAX)));
}

std::ptrdiff_t read_some(int descriptor, char* data, std::size_t bytes, std::uint64_t at) {
  if (_lseeki64(descriptor, static_cast<std::int64_t>(at), SEEK_SET) < 0) return -1;
  return _read(descriptor, data, static_cast<unsigned>(std::min<std::size_t>(bytes, INT_MAX)));
}

#else

static_assert(sizeof(off_t) == 8, "files may have more than 2 GiB");

void close_file(int descriptor) {
  ::close(descriptor);
}

/// For file systems that make no file without a name: one that is named only until the next call unlinks it.
int open_and_unlink(const std::string& directory) {
  std::string name = directory + "/boxstream-XXXXXX";
  const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor < 0 || ::unlink(name.c_str()) == 0) return descriptor;
  const int error = errno;
  close_file(descriptor);
  errno = error;
  return -1;
}

int open_nameless(const std::string& directory) {
#ifdef O_TMPFILE
  const int descriptor = ::open(directory.c_str(), O_TMPFILE | O_RDWR | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor >= 0) return descriptor;
#endif
  return open_and_unlink(directory);
}

std::ptrdiff_t write_some(int descriptor, const char* data, std::size_t bytes, std::uint64_t at) {
  return ::pwrite(descriptor, data, bytes, static_cast<off_t>(at));
}

std::ptrdiff_t read_some(int descriptor, char* data, std::size_t bytes, std::uint64_t at) {
  return ::pread(descriptor, data, bytes, static_cast<off_t>(at));
}

#endif

/// 0 when `some` has moved all of the bytes, or the error.
template <class Some, class Data>
int move_all(const Some& some, int descriptor, Data* data, std::size_t bytes, std::uint64_t at) {
  while (bytes != 0) {
    const std::ptrdiff_t moved = some(descriptor, data, bytes, at);
    if (moved < 0 && errno == EINTR) continue;
    if (moved <= 0) return moved < 0 ? errno : EIO;
    data += moved;
    at += static_cast<std::uint64_t>(moved);
    bytes -= static_cast<std::size_t>(moved);
  }
  return 0;
}

}  // namespace

NamelessFile::NamelessFile(const std::string& directory)
    : directory_(folder_or_default(directory)), descriptor_(open_nameless(directory_)) {
  if (descriptor_ < 0) fail(errno, "made");
}

NamelessFile::~NamelessFile() {
  close_file(descriptor_);
}

void NamelessFile::write(std::uint64_t at, const char* data, std::size_t bytes) {
  if (const int error = move_all(write_some, descriptor_, data, bytes, at)) fail(error, "written");
}

void NamelessFile::read(std::uint64_t at, char* data, std::size_t bytes) const {
  if (const int error = move_all(read_some, descriptor_, data, bytes, at)) fail(error, "read");
}

void NamelessFile::fail(int error, const char* what) const {
  throw std::system_error(error, std::generic_category(),
                          "boxstream: the temporary file in " + directory_ + " cannot be " + what);
}

}  // namespace boxstream::detail
