// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "papers/volumes/objects.hpp"
#include "papers/volumes/tree.hpp"

/// Bounding volume hierarchies: section 5 of "Geometric data structures for computer graphics" (E. Langetepe,
/// G. Zachmann). A builder decides which objects are together, seeing their boxes only; Hierarchy then puts volumes of
/// any kind around them.
namespace boxstream::papers::volumes {

enum class Builder { tiling, insertion, median, surface_area, volume, principal_axis };

Span<const Builder> builders();
std::string_view name(Builder builder);

/// A leaf has `leaf_size` objects at most (Definition 2 calls that e): less than 1 is std::invalid_argument. The same
/// for the same objects, always.
Tree build(Builder builder, const Objects& objects, std::size_t leaf_size = 1);

}  // namespace boxstream::papers::volumes
