// SPDX-License-Identifier: MIT
#include "box_sets.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "random.hpp"

namespace boxstream::tests {

namespace {

/// The smallest whole s with s^3 >= volume: a cube root that is the same on every machine.
double cube_side(double volume) {
  double side = 1;
  while (side * side * side < volume) ++side;
  return side;
}

/// Rounding to S keeps lo <= hi, for it is monotone.
template <class S>
BasicAabb<S> rounded(const double (&lo)[3], const double (&hi)[3]) {
  BasicAabb<S> box{};
  for (int d = 0; d < 3; ++d) {
    box.min[d] = static_cast<S>(lo[d]);
    box.max[d] = static_cast<S>(hi[d]);
  }
  return box;
}

template <class S>
BasicAabb<S> random_box(Random& random, double side, double smallest, double largest) {
  double lo[3], hi[3];
  for (int d = 0; d < 3; ++d) {
    lo[d] = random.between(0, side);
    hi[d] = lo[d] + random.between(smallest, largest);
  }
  return rounded<S>(lo, hi);
}

/// About half a pair per box.
template <class S>
Boxes<S> sparse(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double side = cube_side(static_cast<double>(n));
  Boxes<S> boxes;
  while (boxes.size() < n) boxes.push_back(random_box<S>(random, side, 0, 1));
  return boxes;
}

/// About ten pairs per box.
template <class S>
Boxes<S> dense(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double side = cube_side(static_cast<double>(n) * 8);
  Boxes<S> boxes;
  while (boxes.size() < n) boxes.push_back(random_box<S>(random, side, 1, 5));
  return boxes;
}

/// All share the origin.
template <class S>
Boxes<S> all_overlapping(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Boxes<S> boxes;
  while (boxes.size() < n) {
    double lo[3], hi[3];
    for (int d = 0; d < 3; ++d) {
      lo[d] = -random.unit();
      hi[d] = random.unit();
    }
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

template <class S>
Boxes<S> identical(std::size_t n, std::uint64_t) {
  return Boxes<S>(n, BasicAabb<S>{{1, 2, 3}, {4, 5, 6}});
}

/// All low corners are the same: no split of low endpoints makes progress on any axis.
template <class S>
Boxes<S> equal_low(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Boxes<S> boxes;
  while (boxes.size() < n) {
    const double lo[3] = {1, 1, 1};
    const double hi[3] = {1 + random.unit(), 1 + random.unit(), 1 + random.unit()};
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// Unit cubes on a lattice in random order: each touches up to 26 others, all ties.
template <class S>
Boxes<S> touching_lattice(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const auto side = static_cast<std::size_t>(cube_side(static_cast<double>(n)));
  Boxes<S> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    const double lo[3] = {static_cast<double>(i % side), static_cast<double>(i / side % side),
                          static_cast<double>(i / side / side)};
    const double hi[3] = {lo[0] + 1, lo[1] + 1, lo[2] + 1};
    boxes.push_back(rounded<S>(lo, hi));
  }
  random.shuffle(boxes);
  return boxes;
}

/// Neighbours on axis 0 touch exactly or are one step of S apart, by chance.
template <class S>
Boxes<S> one_step_apart(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Boxes<S> boxes;
  S at = 1;
  for (std::size_t i = 0; i < n; ++i) {
    BasicAabb<S> box{{at, 0, 0}, {at + static_cast<S>(1), 1, 1}};
    for (int d = 1; d < 3; ++d)
      if (random.chance(0.1)) box.min[d] = box.max[d] = std::nextafter(S(1), random.chance(0.5) ? S(2) : S(1));
    boxes.push_back(box);
    at = random.chance(0.5) ? box.max[0] : std::nextafter(box.max[0], std::numeric_limits<S>::max());
  }
  random.shuffle(boxes);
  return boxes;
}

/// Lattice cubes whose faces are off by a few steps of double: as floats they all touch, as doubles half do.
template <class S>
Boxes<S> below_float(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double side = cube_side(static_cast<double>(n));
  Boxes<S> boxes;
  while (boxes.size() < n) {
    double lo[3], hi[3];
    for (int d = 0; d < 3; ++d) {
      const double cell = std::floor(random.between(0, side));
      lo[d] = cell + 1 + random.integer(-4, 4) * 0x1p-40;
      hi[d] = cell + 2 + random.integer(-4, 4) * 0x1p-40;
    }
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// Thin on one axis, and overlapping everything on the two others.
template <class S, int Axis>
Boxes<S> slices(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Boxes<S> boxes;
  while (boxes.size() < n) {
    double lo[3], hi[3];
    for (int d = 0; d < 3; ++d) {
      lo[d] = -random.unit();
      hi[d] = random.unit();
    }
    lo[Axis] = random.between(0, static_cast<double>(n));
    hi[Axis] = lo[Axis] + random.unit();
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// Long on one axis (`Axis`, or a random one for each box if it is 3), crossing half of the room.
template <class S, int Axis>
Boxes<S> rods(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double side = (Axis < 3 ? 2 : 4) * std::floor(std::sqrt(static_cast<double>(n)) + 1);
  Boxes<S> boxes;
  while (boxes.size() < n) {
    const int axis = Axis < 3 ? Axis : random.integer(0, 2);
    double lo[3], hi[3];
    for (int d = 0; d < 3; ++d) {
      lo[d] = random.between(0, side);
      hi[d] = lo[d] + random.between(0.5, 1.5);
    }
    lo[axis] = random.between(0, side / 2);
    hi[axis] = lo[axis] + side / 2;
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// Each box inside the one before.
template <class S>
Boxes<S> nested(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Boxes<S> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    const auto r = static_cast<double>(i + 1);
    boxes.push_back(rounded<S>({-r, -r, -r}, {r, r, r}));
  }
  random.shuffle(boxes);
  return boxes;
}

/// Half are teeth and half are plates; every plate crosses every tooth on two axes, few do on the third, `Axis`.
template <class S, int Axis>
Boxes<S> comb_and_plates(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  constexpr int u = (Axis + 1) % 3, v = (Axis + 2) % 3;
  const auto count = static_cast<double>(n);
  Boxes<S> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = static_cast<double>(i / 2);
    double lo[3], hi[3];
    const bool tooth = i % 2 == 0;
    lo[u] = tooth ? at : 0;
    hi[u] = tooth ? at + 0.5 : count;
    lo[v] = tooth ? 0 : at;
    hi[v] = tooth ? count : at + 0.5;
    lo[Axis] = random.between(0, count);
    hi[Axis] = lo[Axis] + random.unit();
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// Tight clusters that are far apart.
template <class S>
Boxes<S> clusters(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const std::size_t count = 1 + n / 64;
  std::vector<double> centres(3 * count);
  for (double& centre : centres) centre = std::floor(random.between(-1000, 1000)) * 16;
  Boxes<S> boxes;
  while (boxes.size() < n) {
    const std::size_t cluster = random.index(count);
    double lo[3], hi[3];
    for (std::size_t d = 0; d < 3; ++d) {
      lo[d] = centres[3 * cluster + d] + random.unit() + random.unit() + random.unit();
      hi[d] = lo[d] + random.between(0, 0.5);
    }
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// Sizes over six decades, the large ones few.
template <class S>
Boxes<S> six_decades(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double side = 8 * cube_side(static_cast<double>(n));
  Boxes<S> boxes;
  while (boxes.size() < n) {
    double lo[3], hi[3];
    const int magnitude = random.chance(0.02) ? random.integer(3, 6) : random.integer(-14, 2);
    for (int d = 0; d < 3; ++d) {
      lo[d] = random.between(0, side);
      hi[d] = lo[d] + std::ldexp(1 + random.unit(), magnitude);
    }
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// Dust, one box around the world, and half-spaces as physics engines make them.
template <class S>
Boxes<S> dust_and_planes(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double side = cube_side(static_cast<double>(n)), far = 1e18;
  Boxes<S> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    if (i % 1000 == 0)
      boxes.push_back(rounded<S>({-far, -far, -far}, {far, far, 0}));
    else if (i % 1000 == 1)
      boxes.push_back(rounded<S>({-far, -far, -far}, {side / 2, far, far}));
    else if (i % 1000 == 2)
      boxes.push_back(rounded<S>({-1, -1, -1}, {side + 1, side + 1, side + 1}));
    else
      boxes.push_back(random_box<S>(random, side, 0.0001, 0.01));
  }
  random.shuffle(boxes);
  return boxes;
}

/// One box in twenty has sides at infinity; a few are all of space, or lie at infinity themselves.
template <class S>
Boxes<S> infinite(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double side = 2 * cube_side(static_cast<double>(n));
  constexpr S inf = std::numeric_limits<S>::infinity();
  Boxes<S> boxes;
  while (boxes.size() < n) {
    BasicAabb<S> box = random_box<S>(random, side, 0, 1);
    if (random.chance(0.05))
      for (int d = 0; d < 3; ++d) {
        const int kind = random.integer(0, 5);
        if (kind == 1 || kind == 3) box.min[d] = -inf;
        if (kind == 2 || kind == 3) box.max[d] = inf;
        if (kind == 4) box.min[d] = box.max[d] = inf;
        if (kind == 5) box.min[d] = box.max[d] = -inf;
      }
    boxes.push_back(box);
  }
  return boxes;
}

/// Points, segments and rectangles on a small lattice: many touch, none has volume.
template <class S>
Boxes<S> flat(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const int side = static_cast<int>(cube_side(static_cast<double>(n)));
  Boxes<S> boxes;
  while (boxes.size() < n) {
    double lo[3], hi[3];
    const int thin = random.integer(0, 2);
    for (int d = 0; d < 3; ++d) {
      lo[d] = random.integer(0, side);
      hi[d] = d == thin || random.chance(0.5) ? lo[d] : lo[d] + 1;
    }
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// Everything in a flat layer.
template <class S>
Boxes<S> layer(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double side = std::floor(std::sqrt(static_cast<double>(n)) + 1);
  Boxes<S> boxes;
  while (boxes.size() < n) {
    double lo[3] = {random.between(0, side), random.between(0, side), random.unit()};
    const double hi[3] = {lo[0] + 1, lo[1] + 1, lo[2] + 1};
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// On one line, not parallel to an axis, in order: each touches the next at a corner.
template <class S>
Boxes<S> staircase(std::size_t n, std::uint64_t) {
  Boxes<S> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = static_cast<double>(i);
    boxes.push_back(rounded<S>({at, -at - 1, at}, {at + 1, -at, at + 1}));
  }
  return boxes;
}

/// Bounds of both zeros, one and minus one.
template <class S>
Boxes<S> signed_zeros(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const S zeros[2] = {S(0), -S(0)};
  Boxes<S> boxes;
  while (boxes.size() < n) {
    BasicAabb<S> box{};
    for (int d = 0; d < 3; ++d) {
      box.min[d] = random.chance(0.2) ? -S(1) : random.chance(0.2) ? S(1) : zeros[random.index(2)];
      box.max[d] = box.min[d] > 0 || random.chance(0.2)   ? S(1)
                   : box.min[d] < 0 && random.chance(0.8) ? -S(1)
                                                          : zeros[random.index(2)];
    }
    boxes.push_back(box);
  }
  return boxes;
}

/// Numbers too small to be normal: a host that flushes them to zero sees all of these in one point.
template <class S>
Boxes<S> denormals(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const int side = 2 * static_cast<int>(cube_side(static_cast<double>(n)));
  constexpr S step = std::numeric_limits<S>::denorm_min();
  Boxes<S> boxes;
  while (boxes.size() < n) {
    BasicAabb<S> box{};
    for (int d = 0; d < 3; ++d) {
      const int at = random.integer(-side, side);
      box.min[d] = static_cast<S>(at) * step;
      box.max[d] = static_cast<S>(at + random.integer(0, 4)) * step;
    }
    boxes.push_back(box);
  }
  return boxes;
}

/// One in eight has NaNs, one in eight is inverted on some axis (often in ways that seem to overlap all others).
template <class S>
Boxes<S> invalid_among_valid(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const S nan = std::numeric_limits<S>::quiet_NaN(), inf = std::numeric_limits<S>::infinity();
  Boxes<S> boxes = dense<S>(n, seed);
  for (auto& box : boxes) {
    const int d = random.integer(0, 2);
    if (random.chance(0.125)) (random.chance(0.5) ? box.min : box.max)[d] = random.chance(0.5) ? nan : -nan;
    if (random.chance(0.0625)) std::swap(box.min[d], box.max[d]);
    if (random.chance(0.0625)) {
      box.min[d] = inf;
      box.max[d] = -inf;
    }
  }
  return boxes;
}

/// From the smallest to the largest number that S has, so that any width or centre overflows.
template <class S>
Boxes<S> full_range(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  using Limits = std::numeric_limits<S>;
  Boxes<S> boxes;
  while (boxes.size() < n) {
    BasicAabb<S> box{};
    for (int d = 0; d < 3; ++d) {
      S ends[2];
      for (S& end : ends) {
        // One after the other, for compilers differ in which argument they compute first.
        const int exponent = random.integer(Limits::min_exponent, Limits::max_exponent - 2);
        end = static_cast<S>(std::ldexp(1 + random.unit(), exponent));
        if (random.chance(0.05)) end = Limits::max();
        if (random.chance(0.5)) end = -end;
      }
      if (random.chance(0.7)) ends[1] = static_cast<S>(ends[0] * S(1.5));
      box.min[d] = ends[0] < ends[1] ? ends[0] : ends[1];
      box.max[d] = ends[0] < ends[1] ? ends[1] : ends[0];
    }
    boxes.push_back(box);
  }
  return boxes;
}

/// Bounds from a handful of values, special ones among them: nearly every comparison is a tie.
template <class S>
Boxes<S> ties(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  using Limits = std::numeric_limits<S>;
  const S values[] = {-Limits::infinity(),
                      -Limits::max(),
                      -1,
                      -Limits::denorm_min(),
                      -S(0),
                      S(0),
                      Limits::min(),
                      S(1),
                      std::nextafter(S(1), S(2)),
                      2,
                      Limits::max(),
                      Limits::infinity()};
  constexpr int last = static_cast<int>(std::size(values)) - 1;
  Boxes<S> boxes;
  while (boxes.size() < n) {
    BasicAabb<S> box{};
    for (int d = 0; d < 3; ++d) {
      const int lo = random.integer(0, last);
      const int hi = random.chance(0.8) ? std::min(lo + random.integer(0, 1), last) : random.integer(lo, last);
      box.min[d] = values[lo];
      box.max[d] = values[hi];
    }
    boxes.push_back(box);
  }
  return boxes;
}

/// Every box spans the middle of axis 0 and of axis 1: an interval tree keeps them all at its root.
template <class S>
Boxes<S> spanning_the_median(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Boxes<S> boxes;
  while (boxes.size() < n) {
    double lo[3], hi[3];
    for (int d = 0; d < 3; ++d) {
      lo[d] = -random.between(0.001, 1);
      hi[d] = random.between(0.001, 1);
    }
    lo[2] = random.unit() * static_cast<double>(n);
    hi[2] = lo[2] + random.between(0, 2);
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

/// Two groups at the ends of the number range, each of them small and dense.
template <class S>
Boxes<S> two_far_groups(std::size_t n, std::uint64_t seed) {
  Boxes<S> boxes = dense<S>(n, seed);
  for (std::size_t i = 0; i < n; i += 2)
    for (int d = 0; d < 3; ++d) {
      boxes[i].min[d] *= static_cast<S>(0x1p100);
      boxes[i].max[d] *= static_cast<S>(0x1p100);
    }
  return boxes;
}

/// The surface of a ball of small boxes.
template <class S>
Boxes<S> sphere(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double radius = std::floor(std::sqrt(static_cast<double>(n) / 8) + 1);
  Boxes<S> boxes;
  while (boxes.size() < n) {
    double at[3], square = 0;
    for (double& x : at) {
      x = random.between(-1, 1);
      square += x * x;
    }
    if (square > 1 || square < 0.01) continue;
    const double scale = radius / std::sqrt(square);
    double lo[3], hi[3];
    for (int d = 0; d < 3; ++d) {
      lo[d] = at[d] * scale;
      hi[d] = lo[d] + 1;
    }
    boxes.push_back(rounded<S>(lo, hi));
  }
  return boxes;
}

}  // namespace

template <class S>
const std::vector<BoxSet<S>>& box_sets() {
  constexpr std::size_t any = std::numeric_limits<std::size_t>::max();
  static const std::vector<BoxSet<S>> sets = {
      {"sparse", sparse<S>, any, 450, 1800},
      {"dense", dense<S>, any, 10000, 40000},
      {"all_overlapping", all_overlapping<S>, 700, 244650, 244650},
      {"identical", identical<S>, 700, 244650, 244650},
      {"equal_low", equal_low<S>, 700, 244650, 244650},
      {"touching_lattice", touching_lattice<S>, any, 20000, 26000},
      {"one_step_apart", one_step_apart<S>, any, 700, 1000},
      {"below_float", below_float<S>, any, 7000, 22000},
      {"slices_x", slices<S, 0>, any, 500, 2000},
      {"slices_y", slices<S, 1>, any, 500, 2000},
      {"slices_z", slices<S, 2>, any, 500, 2000},
      {"rods_x", rods<S, 0>, any, 400, 2000},
      {"rods_y", rods<S, 1>, any, 400, 2000},
      {"rods_z", rods<S, 2>, any, 400, 2000},
      {"rods_mixed", rods<S, 3>, any, 2000, 8000},
      {"nested", nested<S>, 700, 244650, 244650},
      {"comb_and_plates_x", comb_and_plates<S, 0>, any, 230, 1000},
      {"comb_and_plates_y", comb_and_plates<S, 1>, any, 230, 1000},
      {"comb_and_plates_z", comb_and_plates<S, 2>, any, 230, 1000},
      {"clusters", clusters<S>, any, 600, 2400},
      {"six_decades", six_decades<S>, any, 2000, 8000},
      {"dust_and_planes", dust_and_planes<S>, any, 5000, 7000},
      {"infinite", infinite<S>, 2100, 4000, 16000},
      {"flat", flat<S>, any, 1500, 6000},
      {"layer", layer<S>, any, 2000, 8000},
      {"staircase", staircase<S>, any, 1999, 1999},
      {"signed_zeros", signed_zeros<S>, 700, 25000, 120000},
      {"denormals", denormals<S>, sizeof(S) == 8 ? 3000 : any, 700, 4000},
      {"invalid_among_valid", invalid_among_valid<S>, any, 6000, 25000, true},
      {"full_range", full_range<S>, 2100, 8000, 36000},
      {"ties", ties<S>, 2100, 16000, 60000},
      {"spanning_the_median", spanning_the_median<S>, any, 1000, 4000},
      {"two_far_groups", two_far_groups<S>, any, 5000, 20000},
      {"sphere", sphere<S>, any, 1500, 6000},
  };
  return sets;
}

template <class S>
const BoxSet<S>& box_set(const std::string& name) {
  for (const auto& set : box_sets<S>())
    if (set.name == name) return set;
  throw std::out_of_range("no box set named " + name);
}

template const std::vector<BoxSet<float>>& box_sets<float>();
template const std::vector<BoxSet<double>>& box_sets<double>();
template const BoxSet<float>& box_set<float>(const std::string&);
template const BoxSet<double>& box_set<double>(const std::string&);

}  // namespace boxstream::tests
