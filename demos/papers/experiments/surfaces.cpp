// SPDX-License-Identifier: MIT
// The two applications of section 8, on surfaces that are generated: on the versions that the paper has for them, and
// on the engine.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "mesh/generators.hpp"
#include "mesh/nearest_triangles.hpp"
#include "mesh/self_intersection.hpp"
#include "mesh/three_phases.hpp"
#include "papers/experiments/experiment.hpp"
#include "papers/experiments/measure.hpp"
#include "papers/experiments/rows.hpp"
#include "papers/hybrid/ranks.hpp"
#include "papers/hybrid/versions.hpp"

namespace boxstream::papers {
namespace {

using mesh::TriangleMesh;

TriangleMesh bottle(std::size_t around) {
  return mesh::klein_bottle(around, std::max<std::size_t>(4, around / 4 * 2));
}

std::size_t triangles_in(const std::vector<Pair>& pairs) {
  std::set<std::uint32_t> triangles;
  for (const Pair pair : pairs) triangles.insert({pair.a, pair.b});
  return triangles.size();
}

PairSum sum_of(const std::vector<Pair>& pairs) {
  PairSum sum;
  for (const Pair pair : pairs) sum.add(pair.a, pair.b);
  return sum;
}

std::vector<Aabb> boxes_of(const TriangleMesh& mesh) {
  std::vector<Aabb> boxes;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) boxes.push_back(mesh::box_of(mesh::triangle_of(mesh, i)));
  return boxes;
}

/// Version One, its coordinates the ranks of the boxes' ends. It sorts pointers, so that places stay the triangles'
/// numbers: the paper's "variant of Version One" must know them too.
void by_version_one(const std::vector<Aabb>& boxes, Found found) {
  const std::vector<Box> ranked = ranks(Span<const Aabb>(boxes));
  VersionOne(Span<const Box>(ranked)).find_pairs(VersionOne::Sorting::pointers, {}, found);
}

void by_version_three(const std::vector<Aabb>& a, const std::vector<Aabb>& b,
                      const std::function<void(std::uint32_t, std::uint32_t)>& found) {
  const TwoSets ranked = ranks(Span<const Aabb>(a), Span<const Aabb>(b));
  VersionThree(Span<const Box>(ranked.a), Span<const Box>(ranked.b)).find_pairs({}, found);
}

PairSum by_all_pairs(const TriangleMesh& mesh) {
  PairSum found;
  const auto n = static_cast<std::uint32_t>(mesh.triangles.size());
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = i + 1; j < n; ++j)
      if (mesh::intersect(mesh, i, j)) found.add(i, j);
  return found;
}

using Distances = std::vector<mesh::Nearest>;

void require_same(const Distances& a, const Distances& b, double size, const std::string& what) {
  const auto same = [&](const mesh::Nearest& x, const mesh::Nearest& y) {
    return mesh::same_within_rounding(x.squared, y.squared, size);
  };
  if (!std::equal(a.begin(), a.end(), b.begin(), b.end(), same))
    throw std::runtime_error(what + " does not find the same distances");
}

}  // namespace

Outcome figure_22(const Settings& settings) {
  const std::vector<std::size_t> sizes =
      settings.quick ? std::vector<std::size_t>{16, 32, 64} : std::vector<std::size_t>{16, 32, 64, 128, 256, 512};
  constexpr std::size_t all_pairs_limit = 4096;
  Outcome outcome;
  std::vector<Row> rows;
  for (const std::size_t around : sizes) {
    const TriangleMesh mesh = bottle(around);
    const std::size_t n = mesh.triangles.size();
    settings.progress(fmt::format("{} triangles", n));
    const std::vector<Aabb> boxes = boxes_of(mesh);
    const Measured one = measure(settings.repeats, [&](Found found) { by_version_one(boxes, found); });
    const Measured engine = measure_engine(settings.repeats, boxes);
    mesh::SelfIntersections found;
    const double ms = measure_time(
        settings.repeats, [] {}, [&] { found = mesh::self_intersections(mesh); });
    const PairSum pairs = sum_of(found.pairs);
    require_same(one.found, engine.found, "Version One");
    const Measured with_one = measure(settings.repeats, [&](Found sink) {
      by_version_one(boxes_of(mesh), [&](std::uint32_t a, std::uint32_t b) {
        if (mesh::intersect(mesh, a, b)) sink(a, b);
      });
    });
    require_same(with_one.found, pairs, "Version One with the test of triangles");
    const auto x = static_cast<double>(n);
    rows.push_back({"boxstream, pairs of boxes", n, x, engine.ms, engine.found.pairs});
    rows.push_back({"Version One, pairs of boxes", n, x, one.ms, one.found.pairs});
    rows.push_back({std::string(engine_name), n, x, ms, pairs.pairs});
    rows.push_back({"Version One", n, x, with_one.ms, with_one.found.pairs});
    if (n <= all_pairs_limit) {
      PairSum all;
      const double all_ms = measure_time(
          1, [] {}, [&] { all = by_all_pairs(mesh); });
      require_same(pairs, all, engine_name);
      rows.push_back({"all pairs of triangles", n, x, all_ms, all.pairs});
    }
    outcome.findings.push_back(
        fmt::format("{} triangles: {} of them intersect, in {} pairs", n, triangles_in(found.pairs), pairs.pairs));
  }
  return outcome_of(rows, "triangles", "Figure 22: self-intersections of the Klein bottle", "n, triangles",
                    std::move(outcome.findings));
}

Outcome figure_23(const Settings& settings) {
  const std::size_t around = settings.quick ? 60 : 600;
  const TriangleMesh original = bottle(around);
  Outcome outcome;
  std::vector<Row> rows;
  for (const double percent : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    const TriangleMesh coarse = bottle(
        std::max<std::size_t>(8, static_cast<std::size_t>(static_cast<double>(around) * std::sqrt(percent / 100))));
    const auto compare = [&](const char* direction, const std::vector<mesh::Vec3>& points, const TriangleMesh& to) {
      mesh::PhaseCounts counts;
      Distances expected;
      const auto add = [&](const std::string& series, const std::function<Distances()>& run) {
        settings.progress(fmt::format("{} %, {}, {}", percent, direction, series));
        Distances found;
        const double ms = measure_time(
            settings.repeats, [&] { counts = {}; }, [&] { found = run(); });
        if (expected.empty()) expected = found;
        require_same(found, expected, mesh::largest_side(to), series);
        rows.push_back({fmt::format("{}, {}", series, direction), points.size(), percent, ms,
                        counts.first_pairs + counts.second_pairs + counts.third_pairs});
      };
      add("three phases", [&] { return mesh::three_phase_distances(points, to, &counts); });
      add("by Version Three", [&] { return mesh::three_phase_distances(points, to, &counts, by_version_three); });
      outcome.findings.push_back(
          fmt::format("{} %, {}: {} points, {} triangles; pairs in phase I {}, II {} ({} points, {} rounds), III {}",
                      percent, direction, points.size(), to.triangles.size(), counts.first_pairs, counts.second_pairs,
                      counts.late_points, counts.rounds, counts.third_pairs));
      add(std::string(engine_name), [&] { return mesh::surface_distances(points, to); });
      add("tree, point by point", [&] { return mesh::NearestTriangles(to).nearest(points); });
    };
    compare("coarse from fine", coarse.vertices, original);
    compare("fine from coarse", original.vertices, coarse);
  }
  return outcome_of(rows, "percent",
                    fmt::format("Figure 23: a Klein bottle of {} triangles and coarse ones", original.triangles.size()),
                    "triangles of the coarse one, percent", std::move(outcome.findings));
}

}  // namespace boxstream::papers
