// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <boxstream/aabb.hpp>

#include "base/keys.hpp"

namespace boxstream::detail {

/// What keys leave out: nothing for floats. For doubles, the axes on which equal keys do not decide whether two ends
/// meet, and the boxes of both sets, indexed by the ids of records.
struct Originals {
  const LossyAxes* lossy = nullptr;
  const Aabb64 *a = nullptr, *b = nullptr;

  /// A bit each. Once all records are made.
  std::uint32_t doubtful_axes() const { return lossy == nullptr ? 0 : lossy->all(); }
};

}  // namespace boxstream::detail
