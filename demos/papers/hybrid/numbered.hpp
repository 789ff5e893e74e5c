// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <boxstream/span.hpp>

#include "papers/hybrid/box.hpp"

namespace boxstream::papers {

/// Each box with its place as its number, in memory for just as many.
inline std::vector<NumberedBox> numbered(Span<const Box> boxes) {
  std::vector<NumberedBox> copies;
  copies.reserve(boxes.size());
  for (const Box& box : boxes)
    copies.push_back(
        {{box.projections[0], box.projections[1], box.projections[2]}, static_cast<std::int32_t>(copies.size())});
  return copies;
}

}  // namespace boxstream::papers
