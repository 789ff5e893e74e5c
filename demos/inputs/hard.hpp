// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <boxstream/span.hpp>

#include "inputs/generators.hpp"

/// Boxes as buildings, meshes and worlds have them, and that methods which cut along axes find hard, with what makes
/// them hard as a parameter. Each returns exactly n valid boxes, shuffled, the same bits on every platform.
namespace boxstream::batches {

/// Bars along lines of a grid, a unit apart. Bars of different directions do not meet while they are straight.
struct Bars {
  int directions = 3;      ///< 1 .. 3
  int pieces = 1;          ///< end to end on each line, sharing their ends; 0: about a unit long
  double jitter = 0;       ///< each end is moved by up to this, either way
  double thickness = 0.2;  ///< below 1/2
  bool scattered = false;  ///< lines at random places, where bars do meet
};
Boxes bars(std::size_t n, Random& random, const Bars& how);

/// Layers of long bars, along x and along y in turn, end to end. Between layers there is room.
Boxes rebar(std::size_t n, Random& random, int pieces, double jitter);

/// Boards and uprights of a cupboard, as deep as it is in `pieces`; all ends coincide with others.
Boxes shelves(std::size_t n, Random& random, int pieces, double jitter);

/// Planks, four side by side, now along x and now along y: a floor.
Boxes parquet(std::size_t n, Random& random, double jitter);

/// Rods at random places, `length` of the extent long, along 1 to 3 axes; so thin that each meets about one other.
Boxes rods_of(std::size_t n, Random& random, double length, int directions);

/// A share of the boxes in a unit cube, the rest scattered over a cube `scale` times as wide; `depth` times over: the
/// scattered boxes are the heap of the next world. Boxes meet about one other of their own heap. All heaps lie at the
/// origin, where numbers are as fine as need be.
struct Heaps {
  double share = 0.85;
  double scale = 1e4;
  int depth = 1;
};
Boxes heaps(std::size_t n, Random& random, const Heaps& how);

/// Boxes of anything, each taken into the heap at the origin with the probability `share`, and again, up to `depth`
/// times: it is `scale` times smaller each time.
Boxes heaped(Boxes boxes, Random& random, const Heaps& how);

/// What is left of a cube when the middle thirds are taken away, again and again.
Boxes cantor_dust(std::size_t n, Random& random);

/// Cells of a mesh that is twice as fine in each step towards a corner, 1 - `gap` as wide as would touch.
Boxes graded(std::size_t n, Random& random, int steps, double gap);

/// Boxes as random as can be but for a share of all ends, each moved to the nearest of a few planes.
Boxes coinciding(std::size_t n, Random& random, double share, int planes);

/// Boxes that are all alike on some axes, and have no width on some others. Bit d: axis d.
Boxes flattened(std::size_t n, Random& random, unsigned alike, unsigned thin);

/// All along the diagonal of space, each meeting about two others.
Boxes diagonal(std::size_t n, Random& random);

/// Columns on few large squares, which tile the ground, and a few flat boxes above.
Boxes city(std::size_t n, Random& random);

/// Touching unit cubes on half of the places of a grid, at random.
Boxes voxels(std::size_t n, Random& random);

/// Cubes whose sides are distributed as Pareto has it, with exponent 2: most are small, some are as large as a third
/// of everything.
Boxes pareto(std::size_t n, Random& random);

/// One method to make such boxes.
struct HardFamily {
  std::string name;
  std::function<Boxes(std::size_t n, Random& random)> make;
  std::size_t largest = 10'000'000;  ///< beyond, the pairs are more than anything else
};

/// All of the above with each parameter from harmless to worst.
const std::vector<HardFamily>& hard_families();

/// The family of that name; throws std::invalid_argument if there is none.
const HardFamily& hard_family(std::string_view name);

}  // namespace boxstream::batches
