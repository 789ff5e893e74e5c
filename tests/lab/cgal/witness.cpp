// SPDX-License-Identifier: MIT
// CGAL as a witness of mesh files: boxstream_cgal_witness FILE... compares what it reads, and which triangles it finds
// to intersect, with what is read and found here, and prints a line a file; --list FILE prints CGAL's pairs alone.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mesh/self_intersection.hpp"

namespace {

using boxstream::Pair;
using boxstream::imports::TriangleMesh;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Corners = std::array<std::uint32_t, 3>;
using Pairs = std::vector<Pair>;

std::vector<Kernel::Point_3> points_of(const TriangleMesh& mesh) {
  std::vector<Kernel::Point_3> points;
  for (const auto& v : mesh.vertices) points.emplace_back(v[0], v[1], v[2]);
  return points;
}

/// Those with area, of which alone it is defined what CGAL does.
std::vector<std::uint32_t> with_area(const TriangleMesh& mesh, const std::vector<Kernel::Point_3>& points) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Corners& c = mesh.triangles[i];
    if (!CGAL::collinear(points[c[0]], points[c[1]], points[c[2]])) numbers.push_back(i);
  }
  return numbers;
}

Pairs in_order(Pairs pairs) {
  for (Pair& pair : pairs)
    if (pair.b < pair.a) std::swap(pair.a, pair.b);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// By Polygon_mesh_processing::self_intersections; nothing where the triangles are no surface that CGAL can hold.
std::optional<Pairs> by_surface(const TriangleMesh& mesh) {
  const auto points = points_of(mesh);
  Surface surface;
  for (const auto& point : points) surface.add_vertex(point);
  const auto numbers = with_area(mesh, points);
  for (const std::uint32_t i : numbers) {
    const Corners& c = mesh.triangles[i];
    if (surface.add_face(Surface::Vertex_index(c[0]), Surface::Vertex_index(c[1]), Surface::Vertex_index(c[2])) ==
        Surface::null_face())
      return std::nullopt;
  }
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> found;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found));
  Pairs pairs;
  for (const auto& [a, b] : found) pairs.push_back({numbers[a.idx()], numbers[b.idx()]});
  return in_order(std::move(pairs));
}

/// What self_intersections is documented to decide, of one pair of any triangles: whether they have a point in common
/// beyond the vertices that they share.
bool intersect(const std::vector<Kernel::Point_3>& points, Corners s, Corners t) {
  const auto shared_first = [](Corners& of, const Corners& other) {
    return std::stable_partition(
               of.begin(), of.end(),
               [&](std::uint32_t v) { return std::find(other.begin(), other.end(), v) != other.end(); }) -
           of.begin();
  };
  const auto shared = shared_first(s, t);
  shared_first(t, s);
  const auto p = [&](const Corners& c, int i) { return points[c[i]]; };
  const Kernel::Triangle_3 a(p(s, 0), p(s, 1), p(s, 2)), b(p(t, 0), p(t, 1), p(t, 2));
  if (shared == 0) return CGAL::do_intersect(a, b);
  if (shared == 1)
    return CGAL::do_intersect(a, Kernel::Segment_3(p(t, 1), p(t, 2))) ||
           CGAL::do_intersect(b, Kernel::Segment_3(p(s, 1), p(s, 2)));
  if (shared == 2)
    return CGAL::coplanar(p(s, 0), p(s, 1), p(s, 2), p(t, 2)) &&
           CGAL::coplanar_orientation(p(s, 0), p(s, 1), p(s, 2), p(t, 2)) == CGAL::POSITIVE;
  return true;
}

Pairs by_pairs(const TriangleMesh& mesh) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
  const auto points = points_of(mesh);
  std::vector<Box> boxes;
  for (const std::uint32_t i : with_area(mesh, points)) {
    CGAL::Bbox_3 box;
    for (const std::uint32_t v : mesh.triangles[i]) box += points[v].bbox();
    boxes.emplace_back(box, i);
  }
  Pairs pairs;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& x, const Box& y) {
    if (intersect(points, mesh.triangles[x.info()], mesh.triangles[y.info()])) pairs.push_back({x.info(), y.info()});
  });
  return in_order(std::move(pairs));
}

using Places = std::set<std::array<double, 3>>;

/// What CGAL reads otherwise than we do: how many faces, or which places of their corners; empty: nothing.
std::string read_otherwise(const std::string& path, const TriangleMesh& mesh) {
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  if (!CGAL::IO::read_polygon_soup(path, points, polygons, CGAL::parameters::verbose(false)))
    return "; CGAL cannot read it";
  const std::size_t faces = mesh.faces.empty() ? 0 : mesh.faces.back() + std::size_t{1};
  if (polygons.size() != faces)
    return "; CGAL reads " + std::to_string(polygons.size()) + " faces of " + std::to_string(faces);
  Places ours, theirs;
  for (const auto& corners : mesh.triangles)
    for (const auto v : corners) ours.insert({mesh.vertices[v][0], mesh.vertices[v][1], mesh.vertices[v][2]});
  for (const auto& corners : polygons)
    for (const auto v : corners) theirs.insert({points[v].x() + 0, points[v].y() + 0, points[v].z() + 0});
  return ours == theirs ? "" : "; CGAL reads other places";
}

/// Whether all agree.
bool compare(const std::string& path) {
  TriangleMesh mesh;
  try {
    mesh = boxstream::imports::read_surface(path);
  } catch (const std::exception& error) {
    std::printf("refused    %s\n", error.what());
    return true;
  }
  const Pairs ours = boxstream::mesh::self_intersections(mesh).pairs;
  const Pairs each = by_pairs(mesh);
  const auto whole = by_surface(mesh);
  const bool agree = ours == each && (!whole || ours == *whole);
  std::printf("%s %s: %zu triangles, %zu pairs, of CGAL %s%s\n", agree ? "equal     " : "DIFFERENT ", path.c_str(),
              mesh.triangles.size(), ours.size(),
              whole ? std::to_string(whole->size()).c_str() : (std::to_string(each.size()) + " one by one").c_str(),
              read_otherwise(path, mesh).c_str());
  return agree;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::strcmp(argv[1], "--list") == 0) {
    const TriangleMesh mesh = boxstream::imports::read_surface(argv[2]);
    const auto whole = by_surface(mesh);
    for (const Pair pair : whole ? *whole : by_pairs(mesh)) std::printf("%u %u\n", pair.a, pair.b);
    return 0;
  }
  bool agree = argc > 1;
  for (int i = 1; i < argc; ++i) {
    agree = compare(argv[i]) && agree;
    std::fflush(stdout);
  }
  return agree ? 0 : 1;
}
