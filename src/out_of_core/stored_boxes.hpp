// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "out_of_core/numbered_boxes.hpp"
#include "out_of_core/temporary_file.hpp"

namespace boxstream::detail {

/// Boxes in blocks of a temporary file, which gets them back at the end. Written first, then read.
template <class S>
class StoredBoxes final : public NumberedBoxes<S> {
 public:
  explicit StoredBoxes(TemporaryFile& file) : file_(file) {}
  StoredBoxes(StoredBoxes&& other) noexcept
      : file_(other.file_),
        blocks_(std::exchange(other.blocks_, {})),
        size_(other.size_),
        buffer_(std::move(other.buffer_)) {}
  ~StoredBoxes() override {
    for (const TemporaryFile::Block block : blocks_) file_.release(block);
  }

  void push(const NumberedBox<S>& box) {
    if (buffer_.capacity() == 0) buffer_.reserve(in_block());
    buffer_.push_back(box);
    ++size_;
    if (buffer_.size() == in_block()) write();
  }
  /// Writes what is left, and gives up the buffer until boxes are read.
  void finish() {
    if (!buffer_.empty()) write();
    buffer_ = {};
  }

  std::uint64_t size() const { return size_; }

  void rewind() override { next_ = 0; }
  Span<const NumberedBox<S>> read() override {
    const std::uint64_t left = next_ < blocks_.size() ? size_ - next_ * in_block() : 0;
    buffer_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(in_block(), left)));
    if (left != 0) file_.read(blocks_[next_++], reinterpret_cast<char*>(buffer_.data()), bytes());
    return buffer_;
  }

 private:
  std::size_t in_block() const { return file_.block_bytes() / sizeof(NumberedBox<S>); }
  std::size_t bytes() const { return buffer_.size() * sizeof(NumberedBox<S>); }
  void write() {
    blocks_.push_back(file_.write(reinterpret_cast<const char*>(buffer_.data()), bytes()));
    buffer_.clear();
  }

  TemporaryFile& file_;
  std::vector<TemporaryFile::Block> blocks_;
  std::uint64_t size_ = 0;
  std::size_t next_ = 0;
  std::vector<NumberedBox<S>> buffer_;
};

}  // namespace boxstream::detail
