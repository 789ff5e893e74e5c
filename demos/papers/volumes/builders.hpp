// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "papers/volumes/objects.hpp"
#include "papers/volumes/tree.hpp"

namespace boxstream::papers::volumes {

/// Bounding volume hierarchies: section 5 of "Geometric data structures for computer graphics" (E. Langetepe,
/// G. Zachmann). A builder decides which objects are together, seeing their boxes only; Hierarchy then puts volumes of
/// any kind around them.
enum class Builder { tiling, insertion, median, surface_area, volume, principal_axis };

Span<const Builder> builders();
std::string_view name(Builder builder);

/// A leaf has `leaf_size` objects at most (Definition 2 calls that e): less than 1 is std::invalid_argument. The same
/// for the same objects, always.
Tree build(Builder builder, const Objects& objects, std::size_t leaf_size = 1);

/// Bottom-up, section 5.1.1, figure 48: the nodes of a level, by their centres, are cut into slices along x, each of
/// these along y, and each of those along z into tiles of `arity` nodes, which get a common father; and so on with the
/// fathers. `arity` is 2 or more. O(n log n).
///
/// Slices are made a whole number of tiles wide, so that only the last tile can be smaller than the others.
Tree build_by_tiling(const Atoms& atoms, std::size_t leaf_size, std::size_t arity);

/// Brings `objects`, two or more, into an order and says how many of them, from the first, are the one part: not none,
/// and not all.
using Split = std::size_t (*)(const Atoms& atoms, Span<std::uint32_t> objects);

/// Top-down, section 5.1.3: all objects, split in two, and so on, down to `leaf_size` of them.
Tree build_top_down(const Atoms& atoms, std::size_t leaf_size, Split split);

}  // namespace boxstream::papers::volumes
