// SPDX-License-Identifier: MIT
#include "inputs/batches.hpp"

#include <stdexcept>
#include <string>

#include "inputs/generators.hpp"
#include "inputs/hard.hpp"

namespace boxstream::batches {

namespace {

struct Entry {
  Batch batch;
  Boxes (*generate)(std::size_t n, Random& random);
};

template <Power x, Power y, Power z>
Boxes paper_family(std::size_t n, Random& random) {
  return balanced_or_skewed(n, random, x, y, z);
}

template <int thin>
Boxes layer(std::size_t n, Random& random) {
  return flat_layer(n, random, thin);
}

// Sizes span three decades, so pairs go with the cube of the spacing only.
Boxes many_sizes_crowded(std::size_t n, Random& random) {
  return many_sizes(n, random, 1.42);
}
Boxes many_sizes_sparse(std::size_t n, Random& random) {
  return many_sizes(n, random, 3.25);
}

// Wall to wall; every bar begins and ends where a third of all do.
template <int pieces, int thousandths>
Boxes straight_bars(std::size_t n, Random& random) {
  return bars(n, random, {3, pieces, thousandths / 1000.0});
}

template <int depth>
Boxes nested_heaps(std::size_t n, Random& random) {
  return heaps(n, random, {0.85, 1e4, depth});
}

template <int percent>
Boxes long_rods(std::size_t n, Random& random) {
  return rods_of(n, random, percent / 100.0, 3);
}

Boxes mesh_towards_a_corner(std::size_t n, Random& random) {
  return graded(n, random, 20, 0.2);
}

constexpr Power none = Power::zero, half = Power::half, most = Power::two_thirds, full = Power::one;

const Entry entries[] = {
    {{"U", "balanced: three intervals each 1 .. n^(2/3) long on 1 .. n (paper)", false, 0.4, 0.8},
     paper_family<most, most, most>},
    {{"D", "dense: uniform in a cube, about 4 pairs a box", false, 2.9, 4.2}, dense},
    {{"S", "surface of a sphere of radius n / 2, sides 1 .. n^(1/2) (paper)", false, 0.1, 0.25}, sphere_surface},
    {{"M", "mixed: cubes of sizes log-uniform over 3 decades, about 24 pairs a box", false, 7, 28}, many_sizes_crowded},
    {{"M2", "the same, sparser: about 2 pairs a box", false, 1.2, 2.6}, many_sizes_sparse},
    {{"P", "plain: a flat layer, thin in z, about 2 pairs a box", false, 1.7, 2.3}, layer<2>},
    {{"Px", "the layer thin in x", false, 1.7, 2.3}, layer<0>},
    {{"Py", "the layer thin in y", false, 1.7, 2.3}, layer<1>},
    {{"C", "clusters: n / 500 Gaussian ones, about 2 pairs a box", false, 1.4, 4.2}, clusters},
    {{"W1", "skewed (1, 1, 0): all overlap in x and y (paper)", false, 1.2, 1.8}, paper_family<full, full, none>},
    {{"W2", "skewed (1, 0, 1): all overlap in x and z (paper)", false, 1.2, 1.8}, paper_family<full, none, full>},
    {{"W3", "skewed (0, 1, 1): all overlap in y and z (paper)", false, 1.2, 1.8}, paper_family<none, full, full>},
    {{"W4", "skewed (1, 1/2, 1/2): all overlap in x (paper)", false, 0.4, 0.8}, paper_family<full, half, half>},
    {{"W5", "skewed (1/2, 1, 1/2): all overlap in y (paper)", false, 0.4, 0.8}, paper_family<half, full, half>},
    {{"W6", "skewed (1/2, 1/2, 1): all overlap in z (paper)", false, 0.4, 0.8}, paper_family<half, half, full>},
    {{"R", "rods along x, y and z, about 36 pairs a box", false, 18, 46}, rods},
    {{"G", "grid of unit cubes, each touching 26 others", false, 10, 13}, grid},
    {{"T", "integer lattice, sides 0 .. 2: shared faces, edges, corners, equal boxes", false, 2.8, 4.5},
     touching_lattice},
    {{"Z", "comb and plates: thin teeth through eight of n^(1/2) wide plates", false, 7.5, 8}, comb_and_plates},
    {{"X", "dust in one world-sized box, planes and half-spaces reaching +-1e18", false, 2, 2.2}, dust_and_planes},
    {{"lattice", "bars from wall to wall along x, y and z on a grid: no pairs", false, 0, 0}, straight_bars<1, 0>},
    {{"lattice_j", "the same, each end moved by up to a tenth of the spacing", false, 0, 0}, straight_bars<1, 100>},
    {{"scaffold", "bars along x, y and z, end to end", false, 0.5, 1}, straight_bars<0, 0>},
    {{"scaffold_j", "the same, each end moved by up to a tenth", false, 0.2, 0.6}, straight_bars<0, 100>},
    {{"heap", "85 % in a unit cube, the rest scattered over a cube of 10^4", false, 1, 2.5}, nested_heaps<1>},
    {{"heaps", "the same, four deep: the scattered boxes of each are the heap of the next", false, 1, 2.5},
     nested_heaps<4>},
    {{"rods", "rods of 0.45 of the extent along x, y and z", false, 0.3, 0.8}, long_rods<45>},
    {{"graded", "cells of a mesh, twice as fine in each of 20 steps towards a corner", false, 0, 5},
     mesh_towards_a_corner},
    {{"diag", "all along the diagonal of space", false, 0.6, 1}, diagonal},
    {{"city", "columns on a few large squares, under flat boxes", false, 0.5, 4}, city},
    {{"voxel", "touching unit cubes on half of the places of a grid", false, 4.5, 6.5}, voxels},
    {{"pareto", "cubes with sides of a heavy tail", false, 0.3, 6}, pareto},
    {{"I", "identical boxes: all pairs", true, 1, 1}, identical},
    {{"N", "nested boxes: all pairs", true, 1, 1}, nested},
};

const Entry& entry(std::string_view name) {
  for (const Entry& e : entries)
    if (e.batch.name == name) return e;
  std::string message = "no batch named '" + std::string(name) + "'; there are";
  for (const Entry& e : entries) message += ' ' + std::string(e.batch.name);
  throw std::invalid_argument(message);
}

}  // namespace

Span<const Batch> all() {
  static const std::vector<Batch> batches = [] {
    std::vector<Batch> list;
    for (const Entry& e : entries) list.push_back(e.batch);
    return list;
  }();
  return batches;
}

const Batch& find(std::string_view name) {
  return entry(name).batch;
}

std::vector<Aabb64> make64(std::string_view name, std::size_t n, std::uint64_t seed) {
  const Entry& e = entry(name);
  Random random(seed);
  return e.generate(n, random);
}

std::vector<Aabb> make(std::string_view name, std::size_t n, std::uint64_t seed) {
  std::vector<Aabb> boxes(n);
  const std::vector<Aabb64> exact = make64(name, n, seed);
  for (std::size_t i = 0; i < n; ++i)
    for (int d = 0; d < 3; ++d) {
      boxes[i].min[d] = static_cast<float>(exact[i].min[d]);
      boxes[i].max[d] = static_cast<float>(exact[i].max[d]);
    }
  return boxes;
}

}  // namespace boxstream::batches
