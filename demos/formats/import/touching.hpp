// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "formats/import/fragment.hpp"

namespace boxstream::imports {

/// A body by its pieces, and where it is.
struct Placed {
  std::vector<Piece> pieces;
  Frame place;
  bool still = false;
};

/// Pairs of bodies, not both still, with pieces nearer to each other than a millimetre, or in each other, as Bullet has
/// them: it rounds hulls by its margin. A triangle mesh counts as its convex hull.
std::vector<std::array<std::size_t, 2>> touching(const std::vector<Placed>& bodies);

}  // namespace boxstream::imports
