// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/detail/float_environment.hpp>
#include <boxstream/out_of_core.hpp>

#include "base/keys.hpp"
#include "base/tolerance.hpp"
#include "out_of_core/buffers.hpp"

namespace boxstream::detail {

/// A valid box and its number in the caller's order.
template <class S>
struct NumberedBox {
  BasicAabb<S> box;
  std::uint64_t number;
};

/// Boxes in ascending order of their numbers, read in blocks, as often as needed.
template <class S>
class NumberedBoxes {
 public:
  virtual ~NumberedBoxes() = default;
  virtual void rewind() = 0;
  /// None after the last one; valid until the next call.
  virtual Span<const NumberedBox<S>> read() = 0;
};

/// Until `visit` returns false, which is passed on.
template <class S, class Visit>
bool for_each(NumberedBoxes<S>& boxes, Visit&& visit) {
  boxes.rewind();
  for (auto block = boxes.read(); !block.empty(); block = boxes.read())
    for (const NumberedBox<S>& box : block)
      if (!visit(box)) return false;
  return true;
}

/// The valid boxes of the caller's reader.
template <class S>
class ReaderBoxes final : public NumberedBoxes<S> {
 public:
  /// Copies of `at_once` boxes are in memory while it is read. Their high ends are raised as the options say.
  ReaderBoxes(BasicBoxReader<S>& reader, std::size_t at_once, const OutOfCoreOptions& options, OutOfCoreStats& stats)
      : reader_(reader),
        at_once_(at_once),
        tolerance_(options.tolerance),
        faces_(options.touching ? Faces::closed : Faces::open),
        stats_(stats) {}

  void rewind() override {
    reader_.rewind();
    given_ = {};
    next_ = 0;
    stats_.boxes = stats_.invalid = 0;  // of the last pass
  }

  Span<const NumberedBox<S>> read() override {
    block_.clear();
    block_.reserve(at_once_);
    while (block_.empty()) {
      if (next_ == given_.size() && !read_more()) {
        give_up(block_);
        break;
      }
      const std::size_t end = std::min(given_.size(), next_ + at_once_);
      for (; next_ < end; ++next_, ++stats_.boxes) {
        if (has_valid_keys(given_[next_]))
          block_.push_back({given_[next_], stats_.boxes});
        else
          ++stats_.invalid;
      }
    }
    if (!is_zero(tolerance_)) {
      const DefaultFloatEnvironment environment;
      for (NumberedBox<S>& box : block_) raise(box.box, tolerance_, faces_);
    }
    return block_;
  }

 private:
  bool read_more() {
    given_ = reader_.read();
    next_ = 0;
    stats_.boxes_read += given_.size();
    return !given_.empty();
  }

  BasicBoxReader<S>& reader_;
  std::size_t at_once_;
  double tolerance_;
  Faces faces_;
  OutOfCoreStats& stats_;
  Span<const BasicAabb<S>> given_;
  std::size_t next_ = 0;
  std::vector<NumberedBox<S>> block_;
};

}  // namespace boxstream::detail
