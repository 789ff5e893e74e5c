// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "search/buckets.hpp"

namespace boxstream::detail {

/// How boxes are cut into slabs along one axis: a monotone map from keys to slab numbers, by way of even buckets of
/// which each belongs to one slab.
struct Slabs {
  static constexpr std::uint32_t resolution = 2048;
  static constexpr unsigned most = 64;

  int axis = -1;  ///< -1: not at all
  unsigned count = 1;
  unsigned most_crossed = 0;  ///< boundaries that a box may cross without being *large*
  Buckets buckets;
  std::uint8_t of_bucket[resolution];

  unsigned bit() const { return axis < 0 ? 0 : 1u << axis; }  ///< of Record::before
  std::uint8_t operator()(std::int32_t key) const { return of_bucket[buckets(key)]; }
};

}  // namespace boxstream::detail
