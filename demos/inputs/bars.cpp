// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "inputs/hard.hpp"

namespace boxstream::batches {

namespace {

/// Collects boxes, as sides along three axes, one after the other.
class Heap {
 public:
  Heap(Random& random, double jitter) : random_(random), jitter_(jitter) {}

  /// The sides along `axis` and the two that follow it.
  void add(int axis, const double (&low)[3], const double (&high)[3]) {
    Aabb64 box{};
    for (int i = 0; i < 3; ++i) {
      const int d = (axis + i) % 3;
      box.min[d] = low[i];
      box.max[d] = high[i];
    }
    boxes_.push_back(box);
  }

  /// A bar from low to high along `axis`, whose ends may be moved.
  void add_bar(int axis, double low, double high, double u, double v, double width_u, double width_v) {
    const double begin = moved(low), end = moved(high);
    add(axis, {std::min(begin, end), u, v}, {std::max(begin, end), u + width_u, v + width_v});
  }

  /// n of them at random.
  Boxes take(std::size_t n) {
    random_.shuffle(boxes_);
    boxes_.resize(n);
    return std::move(boxes_);
  }

 private:
  double moved(double end) { return jitter_ == 0 ? end : end + random_.real(-jitter_, jitter_); }

  Random& random_;
  double jitter_;
  Boxes boxes_;
};

/// The first whole number for which `room` is at least n.
template <class Room>
int smallest(std::size_t n, const Room& room) {
  int size = 1;
  while (room(static_cast<std::size_t>(size)) < n) ++size;
  return size;
}

}  // namespace

Boxes bars(std::size_t n, Random& random, const Bars& how) {
  const auto pieces_of = [&](std::size_t lines) { return how.pieces == 0 ? lines : std::size_t(how.pieces); };
  const auto directions = static_cast<std::size_t>(how.directions);
  const int lines = smallest(n, [&](std::size_t l) { return directions * l * l * pieces_of(l); });
  const auto pieces = static_cast<int>(pieces_of(static_cast<std::size_t>(lines)));
  Heap heap(random, how.jitter);
  for (int d = 0; d < how.directions; ++d)
    for (int line = 0; line < lines * lines; ++line) {
      // On the axis across two directions, one has its lines half a unit beside those of the other.
      const double u = how.scattered ? random.real(0, lines) : line % lines + 0.5;
      const double v = how.scattered ? random.real(0, lines) : line / lines;
      for (int p = 0; p < pieces; ++p)
        heap.add_bar(d, double(lines) * p / pieces, double(lines) * (p + 1) / pieces, u, v, how.thickness,
                     how.thickness);
    }
  return heap.take(n);
}

Boxes rebar(std::size_t n, Random& random, int pieces, double jitter) {
  constexpr int layers = 8;
  const int lines = smallest(n, [&](std::size_t l) { return layers * l * static_cast<std::size_t>(pieces); });
  Heap heap(random, jitter);
  for (int layer = 0; layer < layers; ++layer)
    for (int line = 0; line < lines; ++line)
      for (int p = 0; p < pieces; ++p) {
        const double low = double(lines) * p / pieces, high = double(lines) * (p + 1) / pieces;
        if (layer % 2 == 0)
          heap.add_bar(0, low, high, line, layer, 0.3, 0.3);
        else
          heap.add_bar(1, low, high, layer, line, 0.3, 0.3);
      }
  return heap.take(n);
}

Boxes shelves(std::size_t n, Random& random, int pieces, double jitter) {
  const int bays = smallest(n, [&](std::size_t b) { return 2 * b * b * static_cast<std::size_t>(pieces); });
  Heap heap(random, jitter);
  for (int x = 0; x < bays; ++x)
    for (int z = 0; z < bays; ++z)
      for (int p = 0; p < pieces; ++p) {
        const double low = double(bays) * p / pieces, high = double(bays) * (p + 1) / pieces;
        heap.add_bar(1, low, high, z, x, 0.05, 1);
        heap.add_bar(1, low, high, z, x, 1, 0.05);
      }
  return heap.take(n);
}

Boxes parquet(std::size_t n, Random& random, double jitter) {
  const int side = smallest(n, [](std::size_t s) { return 4 * s * s; });
  Heap heap(random, jitter);
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int plank = 0; plank < 4; ++plank)
        if ((x + y) % 2 == 0)
          heap.add_bar(0, x, x + 1, y + 0.25 * plank, 0, 0.25, 0.1);
        else
          heap.add_bar(1, y, y + 1, 0, x + 0.25 * plank, 0.1, 0.25);
  return heap.take(n);
}

// Two rods of the same direction meet with probability 2 l (2 t)^2, of two directions with about l^2 2 t.
Boxes rods_of(std::size_t n, Random& random, double length, int directions) {
  const double count = static_cast<double>(n) + 1;
  const double thickness = std::min(
      0.05, std::min(0.5 * std::sqrt(1 / (count * length)), directions == 1 ? 1 : 1 / (count * length * length)));
  Boxes boxes(n);
  for (std::size_t i = 0; i < n; ++i)
    for (int d = 0; d < 3; ++d) {
      const bool along = static_cast<int>(i) % directions == d;
      const double side = along ? length : thickness * random.real(0.5, 1);
      boxes[i].min[d] = random.real(0, 1 - side);
      boxes[i].max[d] = boxes[i].min[d] + side;
    }
  random.shuffle(boxes);
  return boxes;
}

}  // namespace boxstream::batches
