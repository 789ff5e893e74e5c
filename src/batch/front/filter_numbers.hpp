// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <boxstream/detector.hpp>

namespace boxstream::detail {

/// Numbers the distinct filters of a set in the order in which they come.
class FilterNumbers {
 public:
  static constexpr std::uint8_t none = 255;
  static constexpr unsigned most = 64;

  /// At most `most` numbers, from `first` on.
  FilterNumbers(unsigned first, unsigned last) : first_(first), next_(first), last_(last) {
    std::fill_n(keys_, places, 0);
    std::fill_n(numbers_, places, none);
  }

  /// `none` if there are too many.
  std::uint8_t operator()(Filter filter) {
    const std::uint64_t key = std::uint64_t{filter.mask} << 32 | filter.group;
    for (std::size_t place = key * 0x9E3779B97F4A7C15u >> 56;; place = (place + 1) % places) {
      const std::uint8_t number = numbers_[place];
      if (number == none) return add(filter, key, place);
      if (keys_[place] == key) return number;
    }
  }

  unsigned first() const { return first_; }
  unsigned last() const { return next_; }
  Filter operator[](unsigned number) const { return values_[number]; }

 private:
  static constexpr std::size_t places = 256;  // most of them are free, so that few are asked for

  std::uint8_t add(Filter filter, std::uint64_t key, std::size_t place) {
    if (next_ == last_) return none;
    keys_[place] = key;
    values_[next_] = filter;
    return numbers_[place] = static_cast<std::uint8_t>(next_++);
  }

  unsigned first_, next_, last_;
  Filter values_[most];
  std::uint64_t keys_[places];
  std::uint8_t numbers_[places];
};

}  // namespace boxstream::detail
