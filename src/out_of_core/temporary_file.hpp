// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace boxstream::detail {

/// A file of blocks of equal size that is gone when the object is, or earlier: where the system allows it, it has no
/// name from the start. Blocks that are released are used again. Throws std::system_error.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& directory, std::size_t block_bytes);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  using Block = std::uint64_t;

  std::size_t block_bytes() const { return block_bytes_; }
  /// Writes the first `bytes` of a block, and says which it is.
  Block write(const char* data, std::size_t bytes);
  void read(Block block, char* data, std::size_t bytes);
  void release(Block block) { free_.push_back(block); }

  std::uint64_t size() const { return blocks_ * block_bytes_; }
  std::uint64_t bytes_written() const { return bytes_written_; }
  std::uint64_t bytes_read() const { return bytes_read_; }

 private:
  [[noreturn]] void fail(const char* what) const;
  void go_to(Block block);

  std::filesystem::path directory_;
  std::filesystem::path name_;  // if it still has one
  std::fstream file_;
  std::size_t block_bytes_;
  std::uint64_t blocks_ = 0, bytes_written_ = 0, bytes_read_ = 0;
  std::vector<Block> free_;
};

}  // namespace boxstream::detail
