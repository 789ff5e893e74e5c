// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace boxstream::detail {

/// A file of this process alone, gone when the object or the process is. It has no name, so no other process can open
/// it, but for those that may debug this one. On Windows it has a name, and opening it by that fails. Throws
/// std::system_error with the system's reason; nothing is left then.
class NamelessFile {
 public:
  /// In this folder; empty: the system's for temporary files.
  explicit NamelessFile(const std::string& directory);
  ~NamelessFile();
  NamelessFile(const NamelessFile&) = delete;
  NamelessFile& operator=(const NamelessFile&) = delete;

  /// All of the bytes, `at` so many from the beginning.
  void write(std::uint64_t at, const char* data, std::size_t bytes);
  void read(std::uint64_t at, char* data, std::size_t bytes) const;

 private:
  [[noreturn]] void fail(int error, const char* what) const;

  std::string directory_;
  int descriptor_;
};

}  // namespace boxstream::detail
