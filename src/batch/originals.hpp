// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <boxstream/aabb.hpp>

#include "base/keys.hpp"

namespace boxstream::detail {

/// What keys leave out. Of floats nothing. Of doubles, the axes on which a key that two ends share leaves it open
/// whether they meet, and the boxes of both sets, which the ids of records count.
struct Originals {
  const LossyAxes* lossy = nullptr;
  const Aabb64 *a = nullptr, *b = nullptr;

  /// A bit each. Once all records are made.
  std::uint32_t doubtful_axes() const { return lossy == nullptr ? 0 : lossy->all(); }
};

}  // namespace boxstream::detail
