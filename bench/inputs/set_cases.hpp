// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/detector.hpp>

namespace boxstream::bench {

/// Two batches that are searched for the pairs between them.
struct TwoSets {
  std::vector<Aabb> a, b;
};

/// `few` boxes of a dense batch against n others of it.
TwoSets few_against_many(std::size_t few, std::size_t n, std::uint64_t seed);

/// The boxes of about n triangles of a bumpy torus against those of the same one turned about a slanted axis.
TwoSets turned_meshes(std::size_t n);

/// A batch and filters that refuse most pairs, with what finds the same pairs by searches without filters.
struct Filtered {
  std::vector<Aabb> boxes;
  std::vector<Filter> filters;

  /// A search by hand: within `a`, or between `a` and `b` if there are any. Places of the boxes in the batch.
  struct Part {
    std::vector<std::uint32_t> a, b;
  };
  std::vector<Part> parts;
};

/// Nine boxes in ten are static and refuse each other.
Filtered mostly_static(std::size_t n, std::uint64_t seed);

/// Double boxes that share ends, as users have them: `flat`, real rectangles in a plane; `voxels`, a third of the cubes
/// of a lattice; `parcels`, a plane cut into rectangles at whole units; `cents`, the same at hundredths; `mesh`, the
/// triangles of a bumpy torus, turned. Not in any order but for those of the mesh.
std::vector<Aabb64> shared_ends(const std::string& name, std::size_t n, std::uint64_t seed);

/// Ten groups, each of which meets itself alone.
Filtered ten_groups(std::size_t n, std::uint64_t seed);

}  // namespace boxstream::bench
