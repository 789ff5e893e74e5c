// SPDX-License-Identifier: MIT
#pragma once

#include "papers/volumes/objects.hpp"
#include "papers/volumes/tree.hpp"

namespace boxstream::papers::volumes {

/// Bottom-up, section 5.1.1, figure 48: the nodes of a level, by their centres, are cut into slices along x, each of
/// these along y, and each of those along z into tiles of `arity` nodes, which get a common father; and so on with the
/// fathers. `arity` is 2 or more. O(n log n).
///
/// Slices are made a whole number of tiles wide, so that only the last tile can be smaller than the others.
Tree build_by_tiling(const Atoms& atoms, std::size_t leaf_size, std::size_t arity);

}  // namespace boxstream::papers::volumes
