// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "out_of_core/numbered_boxes.hpp"
#include "out_of_core/regions.hpp"

namespace boxstream::detail {

/// Boxes of a region in memory, for a Detector.
template <class S>
class LoadedBoxes {
 public:
  explicit LoadedBoxes(std::size_t most) : most_(most) {}

  void clear() {
    boxes_.clear();
    numbers_.clear();
    before_.clear();
  }
  bool is_full() const { return boxes_.size() == most_; }
  void add(const NumberedBox<S>& box, const Region<S>& region) {
    append(boxes_, box.box);
    append(numbers_, box.number);
    append(before_, region.before(box.box));
  }

  Span<const BasicAabb<S>> boxes() const { return boxes_; }
  std::uint64_t number(std::size_t i) const { return numbers_[i]; }
  /// Whether the region has the low corner of what two boxes share, its own and one of `other`.
  bool owns(std::size_t i, const LoadedBoxes& other, std::size_t j) const {
    return (before_[i] & other.before_[j]) == 0;
  }

 private:
  /// Never with more room than is needed at most.
  template <class T>
  void append(std::vector<T>& to, const T& value) {
    if (to.size() == to.capacity()) to.reserve(std::min(most_, std::max<std::size_t>(64, 2 * to.size())));
    to.push_back(value);
  }

  std::size_t most_;
  std::vector<BasicAabb<S>> boxes_;
  std::vector<std::uint64_t> numbers_;
  std::vector<std::uint8_t> before_;
};

}  // namespace boxstream::detail
