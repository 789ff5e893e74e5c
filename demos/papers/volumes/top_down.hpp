// SPDX-License-Identifier: MIT
#pragma once

#include "papers/volumes/objects.hpp"
#include "papers/volumes/tree.hpp"

namespace boxstream::papers::volumes {

/// Brings `objects`, two or more, into an order and says how many of them, from the first, are the one part: not none,
/// and not all.
using Split = std::size_t (*)(const Atoms& atoms, Span<std::uint32_t> objects);

/// Top-down, section 5.1.3: all objects, split in two, and so on, down to `leaf_size` of them.
Tree build_top_down(const Atoms& atoms, std::size_t leaf_size, Split split);

}  // namespace boxstream::papers::volumes
