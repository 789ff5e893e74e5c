// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "out_of_core/buffers.hpp"
#include "out_of_core/numbered_boxes.hpp"
#include "out_of_core/temporary_file.hpp"

namespace boxstream::detail {

/// Boxes in blocks of a temporary file, which gets them back at the end. Written first, then read. A buffer of a block
/// is there as long as boxes are written, and as long as they are read.
template <class S>
class StoredBoxes final : public NumberedBoxes<S> {
 public:
  explicit StoredBoxes(TemporaryFile& file) : file_(file) {}
  StoredBoxes(StoredBoxes&& other) noexcept
      : file_(other.file_),
        chain_(std::exchange(other.chain_, {})),
        size_(other.size_),
        buffer_(std::move(other.buffer_)) {}
  ~StoredBoxes() override { file_.release(chain_); }

  void push(const NumberedBox<S>& box) {
    if (buffer_.capacity() == 0) buffer_.reserve(in_block());
    buffer_.push_back(box);
    ++size_;
    if (buffer_.size() == in_block()) write();
  }
  /// Writes what is left.
  void finish() {
    if (!buffer_.empty()) write();
    give_up(buffer_);
  }

  std::uint64_t size() const { return size_; }

  void rewind() override {
    next_ = chain_.first;
    left_ = size_;
  }
  Span<const NumberedBox<S>> read() override {
    if (left_ == 0) {
      give_up(buffer_);
      return {};
    }
    buffer_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(in_block(), left_)));
    file_.read(next_, reinterpret_cast<char*>(buffer_.data()), bytes());
    next_ = file_.after(next_);
    left_ -= buffer_.size();
    return buffer_;
  }

 private:
  std::size_t in_block() const { return file_.block_bytes() / sizeof(NumberedBox<S>); }
  std::size_t bytes() const { return buffer_.size() * sizeof(NumberedBox<S>); }
  void write() {
    file_.append(chain_, reinterpret_cast<const char*>(buffer_.data()), bytes());
    buffer_.clear();
  }

  TemporaryFile& file_;
  TemporaryFile::Chain chain_;
  std::uint64_t size_ = 0;
  TemporaryFile::Block next_ = TemporaryFile::none;  // to be read
  std::uint64_t left_ = 0;                           // boxes from there on
  std::vector<NumberedBox<S>> buffer_;
};

}  // namespace boxstream::detail
