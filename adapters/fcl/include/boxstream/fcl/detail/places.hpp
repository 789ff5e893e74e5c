// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <boxstream/fcl/detail/roster.hpp>

namespace boxstream::fcl::detail {

/// What one query has found. Lives on the stack of the query, so that queries may be nested, and allocates only for
/// long lists.
class Places {
 public:
  std::size_t size() const { return size_; }
  const Place* begin() const { return size_ <= few ? few_ : many_.data(); }
  const Place* end() const { return begin() + size_; }

  void add(Place place) {
    if (size_ < few) {
      few_[size_++] = place;
      return;
    }
    if (size_ == few) many_.assign(few_, few_ + few);
    many_.push_back(place);
    ++size_;
  }

  void sort() {
    if (size_ <= few)
      std::sort(few_, few_ + size_);
    else
      std::sort(many_.begin(), many_.end());
  }

 private:
  static constexpr std::size_t few = 64;

  std::size_t size_ = 0;
  Place few_[few];
  std::vector<Place> many_;
};

}  // namespace boxstream::fcl::detail
