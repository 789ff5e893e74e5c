// SPDX-License-Identifier: MIT
#pragma once

#include "papers/volumes/objects.hpp"
#include "papers/volumes/tree.hpp"

namespace boxstream::papers::volumes {

/// Insertion, section 5.1.2. Step 2 takes objects in a random order, the same each time: in a sorted one, trees become
/// lists. Step 5 takes the child whose surface area grows least, and of equals the one with fewer objects. Where the
/// printed loop ends, at a leaf, the object goes into it; a full leaf becomes a node with two leaves, the old one and
/// one for the new object. O(n log n) unless the objects' sizes defeat that; O(n^2) at worst.
Tree build_by_insertion(const Atoms& atoms, std::size_t leaf_size);

}  // namespace boxstream::papers::volumes
