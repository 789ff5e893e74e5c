// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "commands/commands.hpp"
#include "commands/delaunay.hpp"
#include "inputs/random.hpp"
#include "papers/thick/report_intersections.hpp"
#include "tables/measuring.hpp"

namespace boxstream::bench {

namespace {

/// Points at random in the unit square, and a distance that about `each * n` pairs are within.
std::string row(std::size_t n, double each, int repeats, std::uint64_t seed) {
  batches::Random random(seed);
  std::vector<Ball> points(n);
  for (Ball& point : points)
    for (int d = 0; d < 2; ++d) point.centre[d] = static_cast<float>(random.unit());
  const auto distance = static_cast<float>(std::sqrt(2 * each / (3.141592653589793 * static_cast<double>(n))));

  std::vector<double> triangulation, delaunay, thick, engine;
  Detector detector;
  std::vector<Pair> walked, reported, found;
  for (int i = 0; i < repeats; ++i) {
    const Delaunay::Times times = Delaunay::find_pairs(points, distance, walked);
    triangulation.push_back(times.triangulation_ms);
    delaunay.push_back(times.all_ms);
    thick.push_back(time_once([&] {
      reported.clear();
      papers::thick_near_pairs<2>(Span<const Ball>(points), distance, [&](std::uint32_t a, std::uint32_t b) {
        reported.push_back({a, b});
      });
    }));
    engine.push_back(time_once([&] { find_near_pairs(detector, points, distance, found); }));
    for (std::vector<Pair>* pairs : {&walked, &reported, &found}) std::sort(pairs->begin(), pairs->end());
    if (walked != found || reported != found) throw std::runtime_error("pairs differ");
  }
  const double t = summarize(triangulation).median, d = summarize(delaunay).median, own = summarize(thick).median,
               ours = summarize(engine).median;
  return fmt::format("| {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.2f} | {:.1f} | {:.0f} |\n", n, found.size(), t, d, own,
                     ours, d / own, d / ours);
}

}  // namespace

int run_near(int argc, char** argv) {
  CLI::App app(
      "Times fixed-radius near neighbours by CGAL's Delaunay triangulation, by the algorithm for thick objects and by "
      "the engine, interleaved, checks that the pairs are equal, and prints a table in Markdown.");
  std::vector<double> sizes{1e4, 1e5, 1e6}, pairs{0.5, 5};
  int repeats = 3;
  std::uint64_t seed = 1;
  app.add_option("--n", sizes, "numbers of points")->delimiter(',')->check(CLI::Range(3.0, 1e7));
  app.add_option("--pairs", pairs, "pairs for each point")->delimiter(',')->check(CLI::Range(0.0, 1e3));
  app.add_option("--repeats", repeats, "rounds; medians are shown")->check(CLI::Range(1, 1000));
  app.add_option("--seed", seed, "of the points");
  if (const auto exit_code = parse(app, argc, argv)) return *exit_code;
  fmt::print(
      "| points | pairs | triangulation, ms | and its walks | thick | boxstream | Delaunay / thick | Delaunay / "
      "boxstream |\n|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const double n : sizes)
    for (const double each : pairs) fmt::print("{}", row(static_cast<std::size_t>(n), each, repeats, seed));
  return 0;
}

}  // namespace boxstream::bench
