// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "mesh/nearest_triangles.hpp"
#include "mesh/point_triangle.hpp"
#include "mesh/self_intersection.hpp"
#include "mesh/three_phases.hpp"
#include "mesh_cases.hpp"
#include "mesh_peers.hpp"
#include "race.hpp"
#include "suites.hpp"

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

class MeshContest {
 public:
  MeshContest(const Options& options, Report& report, Progress& progress)
      : options_(options), report_(report), progress_(progress) {}

  void run(const MeshCase& what, std::size_t n) {
    row_ = {};
    row_.suite = "mesh";
    row_.case_name = what.name;
    const TriangleMesh mesh = what.to(n);
    row_.n = mesh.triangles.size();
    if (what.from)
      run_distance(what, mesh, what.from(n).vertices);
    else
      run_self(mesh);
  }

 private:
  void run_self(const TriangleMesh& mesh) {
    std::vector<Pair> ours, theirs;
    const auto run_ours = [&] { ours = mesh::self_intersections(mesh).pairs; };
    run_ours();
    row_.k = ours.size();
    const auto equal = [&] { return theirs == ours; };
    std::vector<Way> ways;
#ifdef BOXSTREAM_BENCH_CGAL
    ways.push_back(rival(
        "cgal-tree", [&] { theirs = cgal_tree_self_intersections(mesh); }, equal));
    if (cgal_self_intersections(mesh, theirs))
      ways.push_back(rival(
          "cgal-pmp", [&] { cgal_self_intersections(mesh, theirs); }, equal));
    else
      ways.push_back(skipped("cgal-pmp", "takes no surface with one side only"));
#endif
    if (row_.n <= largest_n_of_brute_force)
      ways.push_back(rival(
          "brute", [&] { theirs = by_all_pairs(mesh); }, equal));
    compete(run_ours, ways);
  }

  void run_distance(const MeshCase& what, const TriangleMesh& mesh, const std::vector<mesh::Vec3>& points) {
    row_.k = points.size();
    std::vector<mesh::Nearest> ours;
    std::vector<double> theirs;
    const auto run_ours = [&] { ours = mesh::surface_distances(points, mesh); };
    run_ours();
    const auto equal_within = [&](double size) {
      return std::equal(theirs.begin(), theirs.end(), ours.begin(), ours.end(),
                        [&](double a, const auto& b) { return mesh::same_within_rounding(a, b.squared, size); });
    };
    const auto equal = [&] { return equal_within(mesh::largest_side(mesh)); };
    std::vector<Way> ways;
#ifdef BOXSTREAM_BENCH_CGAL
    // It rounds the closest point itself, so its errors go with coordinates, not with triangles.
    const auto equal_points = [&] { return equal_within(largest_coordinate(mesh)); };
    ways.push_back(rival(
        "cgal-tree", [&] { theirs = cgal_kept_tree(mesh)(points); }, equal_points));
    const KeptTree kept = cgal_kept_tree(mesh);
    ways.push_back(rival(
        "cgal-tree-kept", [&] { theirs = kept(points); }, equal_points));
#endif
    if (what.far && row_.n > largest_n_of_far_phases)
      ways.push_back(skipped("three-phases", "their pairs grow with the square of the distance"));
    else
      ways.push_back(rival(
          "three-phases", [&] { theirs = squares(mesh::three_phase_distances(points, mesh)); }, equal, true));
    const mesh::NearestTriangles tree(mesh);
    ways.push_back(rival(
        "tree-kept", [&] { theirs = squares(tree.nearest(points)); }, equal, true));
    if (row_.n <= largest_n_of_brute_force)
      ways.push_back(rival(
          "brute", [&] { theirs = by_all_triangles(points, mesh); }, equal));
    compete(run_ours, ways);
  }

  static constexpr std::size_t largest_n_of_brute_force = 3000;

  static std::vector<Pair> by_all_pairs(const TriangleMesh& mesh) {
    std::vector<Pair> pairs;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
      for (std::uint32_t j = i + 1; j < mesh.triangles.size(); ++j)
        if (mesh::intersect(mesh, i, j)) pairs.push_back({i, j});
    return pairs;
  }

  static std::vector<double> squares(const std::vector<mesh::Nearest>& all) {
    std::vector<double> squared;
    for (const mesh::Nearest& nearest : all) squared.push_back(nearest.squared);
    return squared;
  }

  static std::vector<double> by_all_triangles(const std::vector<mesh::Vec3>& points, const TriangleMesh& mesh) {
    std::vector<double> least(points.size(), std::numeric_limits<double>::infinity());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const mesh::TriangleDistance triangle(mesh::triangle_of(mesh, t));
      for (std::size_t i = 0; i < points.size(); ++i)
        least[i] = std::min(least[i], triangle.squared(points[i], least[i]));
    }
    return least;
  }

  static Way rival(const std::string& name, std::function<void()> run, std::function<bool()> equal,
                   bool is_yardstick = false) {
    return {name, name, std::move(run), std::move(equal), is_yardstick, ""};
  }
  static Way skipped(const std::string& name, const std::string& why) {
    return {name, name, nullptr, nullptr, false, why};
  }

  void compete(const std::function<void()>& ours, std::vector<Way> ways) {
    race(row_, ours, std::move(ways), options_, report_, progress_);
  }

  const Options& options_;
  Report& report_;
  Progress& progress_;
  Row row_;
};

}  // namespace

void run_mesh_suite(const Options& options, Report& report, Progress& progress) {
  const std::string known[] = {"cgal-tree", "cgal-tree-kept", "cgal-pmp", "three-phases", "tree-kept", "brute"};
  for (const std::string& peer : options.peers)
    if (std::find(std::begin(known), std::end(known), peer) == std::end(known))
      throw std::invalid_argument(
          "no peer '" + peer +
          "' in suite mesh; there are cgal-tree cgal-tree-kept cgal-pmp three-phases tree-kept brute");
  std::vector<std::size_t> sizes = options.sizes;
  if (sizes.empty())
    sizes = options.quick ? std::vector<std::size_t>{2000} : std::vector<std::size_t>{2000, 10000, 100000};
  std::sort(sizes.begin(), sizes.end());
  MeshContest contest(options, report, progress);
  for (const std::size_t n : sizes)
    for (const MeshCase& c : mesh_cases())
      if (options.cases.empty() || std::find(options.cases.begin(), options.cases.end(), c.name) != options.cases.end())
        contest.run(c, n);
}

}  // namespace boxstream::bench
