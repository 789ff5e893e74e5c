// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "formats/scene_model/values.hpp"

namespace boxstream::imports {

/// A triangle of a solid that is being cut up. Caps close it where it was cut: they make its volume right, but may lie
/// outside of it (they are fans over cuts of any shape, turned over where those bend inwards), so hulls are without
/// them.
struct Facet {
  std::array<scenes::Vec3, 3> corners;
  bool cap = false;
};

struct Halves {
  std::vector<Facet> low;
  std::vector<Facet> high;
};

/// Cuts closed facets at the plane where coordinate `axis` is `value`; both halves are closed again.
Halves clip(const std::vector<Facet>& facets, std::size_t axis, double value);

double signed_volume(const std::vector<Facet>& facets);

}  // namespace boxstream::imports
