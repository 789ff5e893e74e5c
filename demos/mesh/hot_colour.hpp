// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "pictures/drawing/drawable.hpp"

namespace boxstream::mesh {

/// The hot colour map: from black at 0 over red and yellow to white at 1.
inline picture::Colour hot_colour(double x) {
  const auto channel = [&](double begin, double end) {
    return static_cast<float>(std::clamp((x - begin) / (end - begin), 0.0, 1.0));
  };
  return {channel(0, 0.375), channel(0.375, 0.75), channel(0.75, 1)};
}

}  // namespace boxstream::mesh
