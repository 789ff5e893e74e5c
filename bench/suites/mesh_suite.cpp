// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "inputs/mesh_cases.hpp"
#include "mesh/nearest_triangles.hpp"
#include "mesh/point_triangle.hpp"
#include "mesh/self_intersection.hpp"
#include "mesh/three_phases.hpp"
#include "peers/mesh_peers.hpp"
#include "suites/race.hpp"
#include "suites/suites.hpp"

namespace boxstream::bench {

namespace {

using mesh::TriangleMesh;

constexpr std::size_t largest_n_of_far_phases = 5000;

[[maybe_unused]] double largest_coordinate(const TriangleMesh& mesh) {
  double largest = 0;
  for (const mesh::Vec3& v : mesh.vertices)
    for (const double x : v) largest = std::max(largest, std::abs(x));
  return largest;
}

constexpr std::size_t largest_n_of_brute_force = 3000;

std::vector<Pair> by_all_pairs(const TriangleMesh& mesh) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::uint32_t j = i + 1; j < mesh.triangles.size(); ++j)
      if (mesh::intersect(mesh, i, j)) pairs.push_back({i, j});
  return pairs;
}

std::vector<double> squares(const std::vector<mesh::Nearest>& all) {
  std::vector<double> squared;
  for (const mesh::Nearest& nearest : all) squared.push_back(nearest.squared);
  return squared;
}

std::vector<double> by_all_triangles(const std::vector<mesh::Vec3>& points, const TriangleMesh& mesh) {
  std::vector<double> least(points.size(), std::numeric_limits<double>::infinity());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const mesh::TriangleDistance triangle(mesh::triangle_of(mesh, t));
    for (std::size_t i = 0; i < points.size(); ++i)
      least[i] = std::min(least[i], triangle.squared(points[i], least[i]));
  }
  return least;
}

void run_self(Race& race, const TriangleMesh& mesh) {
  std::vector<Pair> ours, theirs;
  const auto run_ours = [&] { ours = mesh::self_intersections(mesh).pairs; };
  run_ours();
  race.row.k = ours.size();
  const auto equal = [&] { return theirs == ours; };
#ifdef BOXSTREAM_BENCH_CGAL
  const auto run_tree = [&] { theirs = cgal_tree_self_intersections(mesh); };
  race.add("cgal-tree", run_tree, equal);
  const auto run_pmp = [&] { return cgal_self_intersections(mesh, theirs); };
  if (run_pmp())
    race.add("cgal-pmp", run_pmp, equal);
  else
    race.skip("cgal-pmp", "takes no surface with one side only");
#endif
  const auto run_brute = [&] { theirs = by_all_pairs(mesh); };
  if (race.row.n <= largest_n_of_brute_force) race.add("brute", run_brute, equal);
  race.run(run_ours);
}

void run_distance(Race& race, bool is_far, const TriangleMesh& mesh, const std::vector<mesh::Vec3>& points) {
  race.row.k = points.size();
  std::vector<mesh::Nearest> ours;
  std::vector<double> theirs;
  const auto run_ours = [&] { ours = mesh::surface_distances(points, mesh); };
  run_ours();
  const auto equal_within = [&](double size) {
    return std::equal(theirs.begin(), theirs.end(), ours.begin(), ours.end(),
                      [&](double a, const auto& b) { return mesh::same_within_rounding(a, b.squared, size); });
  };
  const auto equal = [&] { return equal_within(mesh::largest_side(mesh)); };
#ifdef BOXSTREAM_BENCH_CGAL
  // It rounds the closest point, so its errors scale with coordinates, not with triangles.
  const auto equal_points = [&] { return equal_within(largest_coordinate(mesh)); };
  const auto run_tree = [&] { theirs = cgal_kept_tree(mesh)(points); };
  race.add("cgal-tree", run_tree, equal_points);
  const auto run_kept = [&, kept = cgal_kept_tree(mesh)] { theirs = kept(points); };
  race.add("cgal-tree-kept", run_kept, equal_points);
#endif
  const auto run_phases = [&] { theirs = squares(mesh::three_phase_distances(points, mesh)); };
  if (is_far && race.row.n > largest_n_of_far_phases)
    race.skip("three-phases", "their pairs grow with the square of the distance");
  else
    race.add_yardstick("three-phases", run_phases, equal);
  const mesh::NearestTriangles tree(mesh);
  const auto run_nearest = [&] { theirs = squares(tree.nearest(points)); };
  race.add_yardstick("tree-kept", run_nearest, equal);
  const auto run_brute = [&] { theirs = by_all_triangles(points, mesh); };
  if (race.row.n <= largest_n_of_brute_force) race.add("brute", run_brute, equal);
  race.run(run_ours);
}

void run_case(const MeshCase& what, std::size_t n, const Options& options, Report& report, Progress& progress) {
  const TriangleMesh mesh = what.to(n);
  Race race(options, report, progress, {.suite = "mesh", .case_name = what.name, .n = mesh.triangles.size()});
  if (what.from)
    run_distance(race, what.far, mesh, what.from(n).vertices);
  else
    run_self(race, mesh);
}

}  // namespace

std::vector<CaseText> mesh_case_texts() {
  return texts_of(mesh_cases());
}

void run_mesh_suite(const Options& options, Report& report, Progress& progress) {
  constexpr std::string_view known = " cgal-tree cgal-tree-kept cgal-pmp three-phases tree-kept brute ";
  for (const std::string& peer : options.peers)
    if (known.find(' ' + peer + ' ') == std::string_view::npos)
      throw std::invalid_argument(fmt::format("no peer '{}' in suite mesh; there are{}", peer, known));
  for (const std::size_t n : options.sizes_or({2000}, {2000, 10000, 100000}))
    for (const MeshCase& c : mesh_cases())
      if (options.wants_case(c.name)) run_case(c, n, options, report, progress);
}

}  // namespace boxstream::bench
