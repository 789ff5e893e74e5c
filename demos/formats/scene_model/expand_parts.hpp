// SPDX-License-Identifier: MIT
#pragma once

#include "formats/scene_model/expand.hpp"
#include "formats/scene_model/random.hpp"

namespace boxstream::scenes {

/// How many of `count` bodies each entry of the mix gets, as near to the weights as whole numbers allow: the entry of
/// each body, shuffled.
std::vector<std::size_t> deal(const std::vector<MixEntry>& mix, int count, Random& random);

/// A body of the entry's kind, in a size drawn from its range.
Body draw_body(const MixEntry& entry, Random& random, Expanded& out);

/// Appends a shape and gives its index.
std::size_t add_shape(Expanded& out, ShapeValue value);

/// Place number `index` of a lattice that is filled layer after layer, from the lowest up.
Vec3 lattice_place(int index, const std::array<int, 2>& columns, const Vec3& spacing, const Vec3& origin);

/// `v` turned by `q`.
Vec3 turned(const Quat& q, const Vec3& v);

/// First `b`, then `a`.
Quat product(const Quat& a, const Quat& b);

}  // namespace boxstream::scenes
