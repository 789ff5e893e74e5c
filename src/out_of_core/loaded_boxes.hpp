// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "out_of_core/buffers.hpp"
#include "out_of_core/numbered_boxes.hpp"
#include "out_of_core/regions.hpp"

namespace boxstream::detail {

/// Boxes of a region in memory, for a Detector.
template <class S>
class LoadedBoxes {
 public:
  explicit LoadedBoxes(std::size_t most) : most_(most) {}

  std::size_t size() const { return boxes_.size(); }
  bool is_full() const { return size() == most_; }
  void add(const NumberedBox<S>& box, const Region<S>& region) {
    append(boxes_, box.box, most_);
    append(numbers_, box.number, most_);
    append(before_, region.before(box.box), most_);
  }
  /// Leaves the first of them, if there are more.
  void cut_off_at(std::size_t count) {
    if (size() <= count) return;
    boxes_.resize(count);
    numbers_.resize(count);
    before_.resize(count);
  }

  Span<const BasicAabb<S>> boxes() const { return boxes_; }
  /// In the caller's order.
  WidePair numbers(Pair pair) const { return {numbers_[pair.a], numbers_[pair.b]}; }
  /// Whether the region has the low corner of what the two share.
  bool owns(Pair pair) const { return (before_[pair.a] & before_[pair.b]) == 0; }

 private:
  std::size_t most_;
  std::vector<BasicAabb<S>> boxes_;
  std::vector<std::uint64_t> numbers_;
  std::vector<std::uint8_t> before_;
};

}  // namespace boxstream::detail
