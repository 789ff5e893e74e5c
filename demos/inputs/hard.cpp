// SPDX-License-Identifier: MIT
#include "inputs/hard.hpp"

#include <stdexcept>

namespace boxstream::batches {

namespace {

using Families = std::vector<HardFamily>;
constexpr double jitters[] = {0, 1e-6, 1e-3, 0.1};

std::string text(double value) {
  std::string digits = std::to_string(value);
  while (digits.back() == '0') digits.pop_back();
  return digits.back() == '.' ? digits + '0' : digits;
}

void add_bars(Families& all) {
  for (const double jitter : jitters) {
    const std::string ends = jitter == 0 ? "" : ", ends moved by " + text(jitter);
    for (const int directions : {1, 2, 3})
      for (const int pieces : {1, 2, 5, 0}) {
        const Bars how{directions, pieces, jitter};
        all.push_back({"bars in " + std::to_string(directions) + " directions, " +
                           (pieces == 0 ? "short" : std::to_string(pieces) + " a line") + ends,
                       [how](std::size_t n, Random& random) { return bars(n, random, how); }});
      }
    for (const int pieces : {1, 4}) {
      const std::string each = std::to_string(pieces) + " a line" + ends;
      all.push_back(
          {"rebar, " + each, [=](std::size_t n, Random& random) { return rebar(n, random, pieces, jitter); }});
      all.push_back(
          {"shelves, " + each, [=](std::size_t n, Random& random) { return shelves(n, random, pieces, jitter); }});
    }
    all.push_back({"parquet" + ends, [=](std::size_t n, Random& random) { return parquet(n, random, jitter); }});
  }
  const Bars scattered{3, 1, 0, 1e-3, true};
  all.push_back({"bars at random places", [=](std::size_t n, Random& random) { return bars(n, random, scattered); }});
}

void add_rods(Families& all) {
  for (const double length : {0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.45, 0.5, 0.6, 0.8, 1.0})
    for (const int directions : {1, 2, 3})
      all.push_back({"rods of " + text(length) + " in " + std::to_string(directions) + " directions",
                     [=](std::size_t n, Random& random) { return rods_of(n, random, length, directions); }});
}

void add_heaps(Families& all) {
  for (const double share : {0.5, 0.8, 0.85, 0.9, 0.99})
    for (const double scale : {1e2, 1e4, 1e8})
      all.push_back({"heap of " + text(share) + " in a world of " + text(scale), [=](std::size_t n, Random& random) {
                       return heaps(n, random, {share, scale, 1});
                     }});
  for (const double share : {0.5, 0.85})
    for (const int depth : {2, 4, 9})
      all.push_back({"heaps of " + text(share) + ", nested " + std::to_string(depth) + " deep",
                     [=](std::size_t n, Random& random) {
                       return heaps(n, random, {share, 1e4, depth});
                     }});
}

/// What a search for bad boxes found: bars in heaps in heaps.
void add_heaped_bars(Families& all) {
  for (const int pieces : {1, 4, 0})
    for (const int depth : {1, 3, 9}) {
      const Bars how{3, pieces, 0, 1e-4, true};
      all.push_back({"bars, " + (pieces == 0 ? "short" : std::to_string(pieces) + " a line") + ", in heaps " +
                         std::to_string(depth) + " deep",
                     [=](std::size_t n, Random& random) {
                       return heaped(bars(n, random, how), random, {0.85, 5000, depth});
                     }});
    }
}

void add_faces(Families& all) {
  for (const int steps : {4, 12, 30})
    for (const double gap : {0.0, 0.3})
      all.push_back({"mesh graded in " + std::to_string(steps) + " steps" + (gap == 0 ? ", touching" : ""),
                     [=](std::size_t n, Random& random) { return graded(n, random, steps, gap); }});
  for (const double share : {0.1, 0.3, 0.5, 0.8, 1.0})
    for (const int planes : {3, 10})
      all.push_back({text(share) + " of the ends on " + std::to_string(planes) + " planes",
                     [=](std::size_t n, Random& random) { return coinciding(n, random, share, planes); }, 20'000});
  for (unsigned alike = 0; alike < 7; ++alike)
    for (const unsigned thin : {0u, 3u, 6u, 7u})
      all.push_back({"alike on axes " + std::to_string(alike) + ", flat on " + std::to_string(thin),
                     [=](std::size_t n, Random& random) { return flattened(n, random, alike, thin); }});
}

Families make_families() {
  Families all;
  add_bars(all);
  add_rods(all);
  add_heaps(all);
  add_heaped_bars(all);
  add_faces(all);
  all.push_back({"cantor dust", cantor_dust});
  all.push_back({"diagonal", diagonal});
  all.push_back({"city", city});
  all.push_back({"voxels", voxels});
  all.push_back({"pareto", pareto});
  all.push_back({"all alike", identical, 2000});
  all.push_back({"one in another", nested, 2000});
  return all;
}

}  // namespace

const std::vector<HardFamily>& hard_families() {
  static const Families families = make_families();
  return families;
}

const HardFamily& hard_family(std::string_view name) {
  for (const HardFamily& family : hard_families())
    if (family.name == name) return family;
  throw std::invalid_argument("no hard family named '" + std::string(name) + "'");
}

}  // namespace boxstream::batches
