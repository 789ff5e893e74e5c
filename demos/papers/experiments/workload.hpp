// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/ray.hpp>

namespace boxstream::papers {

/// Queries of structures about a set of boxes: a pure function of the boxes and the seed.

/// Boxes of the set, elsewhere and half as large again, so that most of them touch some.
std::vector<Aabb> queries_about(const std::vector<Aabb>& boxes, std::size_t count, std::uint64_t seed);

/// Segments between two points of the bounds of all boxes.
std::vector<Ray> rays_through(const std::vector<Aabb>& boxes, std::size_t count, std::uint64_t seed);

/// Places of the boxes, without their sizes.
std::vector<Aabb> centres(const std::vector<Aabb>& boxes);

/// Frames of boxes of which a share, always the same ones, move by up to a tenth of their side on each axis and in each
/// frame.
std::vector<std::vector<Aabb>> frames_of(const std::vector<Aabb>& boxes, std::size_t count, double share,
                                         std::uint64_t seed);

}  // namespace boxstream::papers
