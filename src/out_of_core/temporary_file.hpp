// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <utility>

#include "out_of_core/nameless_file.hpp"

namespace boxstream::detail {

/// A file of blocks of equal size. Blocks form chains; those of a chain that is released are used again. In memory are
/// 8 bytes for each block. Throws std::system_error and std::bad_alloc.
class TemporaryFile {
 public:
  using Block = std::uint64_t;
  static constexpr Block none = ~Block{0};

  struct Chain {
    Block first = none, last = none;
  };

  TemporaryFile(const std::string& directory, std::size_t block_bytes) : file_(directory), block_bytes_(block_bytes) {}

  std::size_t block_bytes() const { return block_bytes_; }
  /// A block more, of which the first `bytes` are written. If it throws, the chain may have the block, unwritten.
  void append(Chain& chain, const char* data, std::size_t bytes) {
    const Block block = take();
    (chain.first == none ? chain.first : next_[chain.last]) = block;
    chain.last = block;
    file_.write(block * block_bytes_, data, bytes);
    bytes_written_ += bytes;
  }
  void read(Block block, char* data, std::size_t bytes) {
    file_.read(block * block_bytes_, data, bytes);
    bytes_read_ += bytes;
  }
  Block after(Block block) const { return next_[block]; }
  void release(const Chain& chain) noexcept {
    if (chain.first != none) next_[chain.last] = std::exchange(free_, chain.first);
  }

  std::uint64_t size() const { return next_.size() * block_bytes_; }
  std::uint64_t bytes_written() const { return bytes_written_; }
  std::uint64_t bytes_read() const { return bytes_read_; }

 private:
  /// One that is in no chain.
  Block take() {
    if (free_ == none) {
      next_.push_back(none);
      return next_.size() - 1;
    }
    const Block block = free_;
    free_ = std::exchange(next_[block], none);
    return block;
  }

  NamelessFile file_;
  std::size_t block_bytes_;
  std::uint64_t bytes_written_ = 0, bytes_read_ = 0;
  Block free_ = none;
  std::deque<Block> next_;  // of each block; a vector would take three times as much while it grows
};

}  // namespace boxstream::detail
