// SPDX-License-Identifier: MIT
#include "papers/volumes/dop.hpp"

#include <algorithm>
#include <vector>

#include "papers/volumes/axis_box.hpp"
#include "papers/volumes/half_spaces.hpp"

namespace boxstream::papers::volumes {

namespace {

constexpr double normals[13][3] = {
    {1, 0, 0}, {0, 1, 0},  {0, 0, 1},                                      // of the faces of a cube
    {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1},                         // its corners
    {1, 1, 0}, {1, -1, 0}, {1, 0, 1},  {1, 0, -1}, {0, 1, 1}, {0, 1, -1},  // and its edges
};

template <int K>
Size size_of_dop(const Dop<K>& dop) {
  std::vector<HalfSpace> half_spaces;
  for (std::size_t i = 0; i < Dop<K>::slabs; ++i) {
    half_spaces.push_back({Dop<K>::normal(i), dop.high[i]});
    half_spaces.push_back({-Dop<K>::normal(i), -dop.low[i]});
  }
  const AxisBox box{dop.bounds()};
  const double diagonal = (Point(box.box.max) - Point(box.box.min)).norm();
  return size_of(half_spaces, box.centre(), diagonal);
}

}  // namespace

template <int K>
Point Dop<K>::normal(std::size_t slab) {
  const std::size_t skipped = K == 18 && slab >= 3 ? 4 : 0;
  return Point(normals[slab + skipped]);
}

template <int K>
Dop<K> Dop<K>::around(Points points) {
  Dop dop;
  for (std::size_t i = 0; i < slabs; ++i) {
    const Point n = normal(i);
    dop.low[i] = std::numeric_limits<double>::infinity();
    dop.high[i] = -dop.low[i];
    for (const Point& p : points) {
      // A coordinate is what it is; sums are rounded.
      const double along = n.dot(p), error = i < 3 ? 0 : slack * p.lpNorm<1>();
      dop.low[i] = std::min(dop.low[i], along - error);
      dop.high[i] = std::max(dop.high[i], along + error);
    }
  }
  return dop;
}

template <int K>
Dop<K> Dop<K>::around(Span<const Dop> dops) {
  Dop all = dops[0];
  for (const Dop& dop : dops)
    for (std::size_t i = 0; i < slabs; ++i) {
      all.low[i] = std::min(all.low[i], dop.low[i]);
      all.high[i] = std::max(all.high[i], dop.high[i]);
    }
  return all;
}

template <int K>
double Dop<K>::excess(const Point& p) const {
  double excess = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < slabs; ++i) {
    const Point n = normal(i);
    const double along = n.dot(p);
    excess = std::max(excess, std::max(along - high[i], low[i] - along) / (n.norm() * (1 + slack)));
  }
  return excess;
}

template <int K>
double Dop<K>::volume() const {
  return size_of_dop(*this).volume;
}

template <int K>
double Dop<K>::area() const {
  return size_of_dop(*this).area;
}

template struct Dop<14>;
template struct Dop<18>;
template struct Dop<26>;

}  // namespace boxstream::papers::volumes
