// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include <boxstream/out_of_core.hpp>

#include "core/oracle.hpp"

namespace boxstream::out_of_core_test {

template <class S>
using Boxes = tests::Boxes<S>;

/// Boxes in memory, a block at a time. Throws std::runtime_error instead of the given call of `read`.
template <class S>
class VectorReader final : public BasicBoxReader<S> {
 public:
  explicit VectorReader(Boxes<S> boxes, std::size_t block = 777, std::size_t fails_at = 0)
      : boxes_(std::move(boxes)), block_(block), fails_at_(fails_at) {}

  void rewind() override { next_ = 0; }
  Span<const BasicAabb<S>> read() override {
    if (++calls_ == fails_at_) throw std::runtime_error("the reader fails");
    const std::size_t begin = next_;
    next_ = std::min(boxes_.size(), next_ + block_);
    return {boxes_.data() + begin, next_ - begin};
  }

  const Boxes<S>& boxes() const { return boxes_; }
  std::size_t calls() const { return calls_; }

 private:
  Boxes<S> boxes_;
  std::size_t block_, fails_at_, calls_ = 0, next_ = 0;
};

}  // namespace boxstream::out_of_core_test
