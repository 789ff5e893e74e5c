// SPDX-License-Identifier: MIT
#include "boxstream/pairs/shape_pairs.hpp"

#include <fmt/format.h>

#include <boxstream/detector.hpp>
#include <cmath>

#include "base/printable.hpp"
#include "boxstream/pairs/shapes_file.hpp"
#include "boxstream/shared/print.hpp"

namespace boxstream::tool {
namespace {

std::string label(const std::vector<PlacedShape>& shapes, std::uint32_t index) {
  return shapes[index].name.empty() ? std::to_string(index) : files::printable(shapes[index].name);
}

/// 0 in place of what rounding leaves of it.
double plain(double part_of_unit) {
  return std::abs(part_of_unit) < 1e-12 ? 0 : part_of_unit;
}

std::string doubt(ccd::Status status) {
  return status == ccd::Status::ok ? "" : fmt::format(" ({})", name(status));
}

}  // namespace

int shape_pairs(const std::string& text, const std::string& name, bool list, const NarrowOptions& options) {
  const std::vector<PlacedShape> shapes = parse_shapes(text, name);
  std::vector<Aabb64> boxes;
  for (const PlacedShape& s : shapes) boxes.push_back(bounds(s.shape, s.pose));
  ccd::Options narrow;
  narrow.tolerance = options.tolerance;
  narrow.max_iterations = options.iterations;
  narrow.solver = options.solver == "gjk"   ? ccd::Options::Solver::gjk
                  : options.solver == "mpr" ? ccd::Options::Solver::mpr
                                            : ccd::Options::Solver::automatic;

  std::uint64_t box_pairs = 0, touching = 0, doubtful = 0;
  Detector detector;
  detector.stream_pairs(Span<const Aabb64>(boxes.data(), boxes.size()), [&](Span<const Pair> pairs) {
    std::string lines;
    for (const Pair pair : pairs) {
      const PlacedShape &a = shapes[pair.a], &b = shapes[pair.b];
      ++box_pairs;
      const ccd::Penetration p = penetration(a.shape, a.pose, b.shape, b.pose, narrow);
      touching += p.intersects ? 1 : 0;
      ccd::Status status = p.status;
      if (list) fmt::format_to(std::back_inserter(lines), "{} {} ", label(shapes, pair.a), label(shapes, pair.b));
      if (p.intersects) {
        const Eigen::Vector3d& n = p.direction;
        if (list)
          fmt::format_to(std::back_inserter(lines), "touch depth {:.9g} direction {:.6g} {:.6g} {:.6g} by {}", p.depth,
                         plain(n.x()), plain(n.y()), plain(n.z()), ccd::name(p.method));
      } else if (list) {
        const ccd::Distance d = distance(a.shape, a.pose, b.shape, b.pose, narrow);
        status = d.status;
        fmt::format_to(std::back_inserter(lines), "apart distance {:.9g}", d.distance);
      }
      doubtful += status == ccd::Status::ok ? 0 : 1;
      if (list) lines += doubt(status) + "\n";
    }
    if (list) print(lines);
    return true;
  });
  if (!list)
    print(fmt::format("shapes {}, pairs of boxes {}, of shapes {}{}\n", shapes.size(), box_pairs, touching,
                      doubtful > 0 ? fmt::format(", inexact {}", doubtful) : ""));
  return 0;
}

}  // namespace boxstream::tool
