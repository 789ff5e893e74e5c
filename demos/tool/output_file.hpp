// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace boxstream::tool {

/// A file that appears whole or not at all: written under another name beside its place, then renamed.
/// Devices and pipes are written straight through.
class OutputFile {
 public:
  /// Checks, before any work is done, that the file can be made: throws BadInput naming it and the reason. Leaves
  /// nothing behind.
  explicit OutputFile(const std::string& path);
  /// Removes what was written but not committed.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Where to write.
  const std::string& path_to_write() const { return written_; }
  /// Puts the written file in its place. Throws std::filesystem::filesystem_error.
  void commit();

 private:
  std::filesystem::path final_;
  std::string written_;
  bool direct_ = false;
  bool committed_ = false;
};

}  // namespace boxstream::tool
