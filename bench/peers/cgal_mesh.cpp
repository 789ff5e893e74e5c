// SPDX-License-Identifier: MIT
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "mesh/self_intersection.hpp"
#include "peers/mesh_peers.hpp"

namespace boxstream::bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Soup = std::vector<Kernel::Triangle_3>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Soup::const_iterator>>>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

Kernel::Point_3 point(const mesh::Vec3& v) {
  return {v[0], v[1], v[2]};
}

Soup soup_of(const mesh::TriangleMesh& mesh) {
  Soup soup;
  soup.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const mesh::Triangle t = mesh::triangle_of(mesh, i);
    soup.emplace_back(point(t[0]), point(t[1]), point(t[2]));
  }
  return soup;
}

bool share_vertices(const mesh::TriangleMesh& mesh, std::uint32_t s, std::uint32_t t) {
  const auto& a = mesh.triangles[s];
  const auto& b = mesh.triangles[t];
  return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

}  // namespace

std::vector<Pair> cgal_tree_self_intersections(const mesh::TriangleMesh& mesh) {
  const Soup soup = soup_of(mesh);
  Tree tree(soup.begin(), soup.end());
  tree.build();
  std::vector<Pair> pairs;
  std::vector<Soup::const_iterator> met;
  for (std::uint32_t i = 0; i < soup.size(); ++i) {
    met.clear();
    tree.all_intersected_primitives(soup[i], std::back_inserter(met));
    for (const auto other : met) {
      const auto j = static_cast<std::uint32_t>(other - soup.begin());
      if (i < j && (!share_vertices(mesh, i, j) || mesh::intersect(mesh, i, j))) pairs.push_back({i, j});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

bool cgal_self_intersections(const mesh::TriangleMesh& mesh, std::vector<Pair>& pairs) {
  pairs.clear();
  Surface surface;
  for (const mesh::Vec3& v : mesh.vertices) surface.add_vertex(point(v));
  for (const auto& t : mesh.triangles)
    if (surface.add_face(Surface::Vertex_index(t[0]), Surface::Vertex_index(t[1]), Surface::Vertex_index(t[2])) ==
        Surface::null_face())
      return false;
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> found;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found));
  for (const auto& [a, b] : found) {
    const std::uint32_t i = a, j = b;
    pairs.push_back({std::min(i, j), std::max(i, j)});
  }
  std::sort(pairs.begin(), pairs.end());
  return true;
}

KeptTree cgal_kept_tree(const mesh::TriangleMesh& mesh) {
  struct Kept {
    explicit Kept(const mesh::TriangleMesh& mesh) : soup(soup_of(mesh)), tree(soup.begin(), soup.end()) {
      tree.build();
      tree.accelerate_distance_queries();
    }
    Soup soup;
    Tree tree;
  };
  return [kept = std::make_shared<Kept>(mesh)](const std::vector<mesh::Vec3>& points) {
    std::vector<double> squared;
    squared.reserve(points.size());
    for (const mesh::Vec3& p : points) squared.push_back(kept->tree.squared_distance(point(p)));
    return squared;
  };
}

}  // namespace boxstream::bench
