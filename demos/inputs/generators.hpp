// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <boxstream/aabb.hpp>

#include "inputs/random.hpp"

/// The generators behind the names of batches.hpp.
namespace boxstream::batches {

using Boxes = std::vector<Aabb64>;

/// An exponent of the paper's family of distributions, as a fraction.
enum class Power { zero, half, two_thirds, one };

// From "Fast software for box intersections" by Zomorodian and Edelsbrunner, section 5.
Boxes balanced_or_skewed(std::size_t n, Random& random, Power x, Power y, Power z);
Boxes sphere_surface(std::size_t n, Random& random);

// Boxes scattered at random over a domain sized for a wanted density.
Boxes dense(std::size_t n, Random& random);
Boxes many_sizes(std::size_t n, Random& random, double spacing);
Boxes flat_layer(std::size_t n, Random& random, int thin);  // `thin` is the axis across the layer
Boxes clusters(std::size_t n, Random& random);
Boxes rods(std::size_t n, Random& random);

// Boxes in an arrangement that is hard for some algorithm.
Boxes grid(std::size_t n, Random& random);
Boxes identical(std::size_t n, Random& random);
Boxes nested(std::size_t n, Random& random);
Boxes comb_and_plates(std::size_t n, Random& random);
Boxes dust_and_planes(std::size_t n, Random& random);
Boxes touching_lattice(std::size_t n, Random& random);

}  // namespace boxstream::batches
