// SPDX-License-Identifier: MIT
#include "commands/delaunay.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <cstdint>
#include <stdexcept>
#include <utility>

#include "tables/measuring.hpp"

namespace boxstream::bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Triangulation = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;

void walk(const Triangulation& triangulation, Span<const Ball> points, float distance, std::vector<Pair>& pairs) {
  std::vector<std::uint32_t> last_walk(points.size(), ~std::uint32_t{0});
  std::vector<Triangulation::Vertex_handle> waiting;
  for (const Triangulation::Vertex_handle start : triangulation.finite_vertex_handles()) {
    const std::uint32_t from = start->info();
    last_walk[from] = from;
    waiting.push_back(start);
    while (!waiting.empty()) {
      const Triangulation::Vertex_handle at = waiting.back();
      waiting.pop_back();
      Triangulation::Vertex_circulator next = triangulation.incident_vertices(at);
      if (next == nullptr) continue;
      const Triangulation::Vertex_circulator first = next;
      do {
        if (triangulation.is_infinite(next)) continue;
        const std::uint32_t to = next->info();
        if (last_walk[to] == from || !is_near(points[from], points[to], distance)) continue;
        last_walk[to] = from;
        waiting.push_back(next);
        if (from < to) pairs.push_back({from, to});
      } while (++next != first);
    }
  }
}

}  // namespace

Delaunay::Times Delaunay::find_pairs(Span<const Ball> points, float distance, std::vector<Pair>& pairs) {
  pairs.clear();
  Times times{};
  Triangulation triangulation;
  times.triangulation_ms = time_once([&] {
    std::vector<std::pair<Kernel::Point_2, std::uint32_t>> numbered;
    for (const Ball& point : points)
      numbered.push_back({{point.centre[0], point.centre[1]}, static_cast<std::uint32_t>(numbered.size())});
    triangulation.insert(numbered.begin(), numbered.end());
  });
  if (triangulation.number_of_vertices() != points.size()) throw std::runtime_error("two points are the same");
  times.all_ms = times.triangulation_ms + time_once([&] { walk(triangulation, points, distance, pairs); });
  return times;
}

}  // namespace boxstream::bench
