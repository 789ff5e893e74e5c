// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include <boxstream/pair.hpp>

#include "mesh/boxes.hpp"

/// What CGAL has for surfaces, from the arrays of vertices and triangles to the result. Present only where CGAL is
/// (BOXSTREAM_BENCH_CGAL).
namespace boxstream::bench {

/// Pairs of triangles that intersect, by an AABB tree that is queried with each triangle. It reports all that
/// share vertices, which our test filters.
std::vector<Pair> cgal_tree_self_intersections(const mesh::TriangleMesh& mesh);

/// The same by Polygon_mesh_processing::self_intersections, which starts from box_self_intersection_d. It takes
/// surfaces with an inside and an outside only: false for others, with `pairs` empty.
bool cgal_self_intersections(const mesh::TriangleMesh& mesh, std::vector<Pair>& pairs);

/// An AABB tree with its tree of hints, built already: the squared distance of each point.
using KeptTree = std::function<std::vector<double>(const std::vector<mesh::Vec3>& points)>;
KeptTree cgal_kept_tree(const mesh::TriangleMesh& mesh);

}  // namespace boxstream::bench
