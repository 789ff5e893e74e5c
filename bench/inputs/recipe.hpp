// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <boxstream/aabb.hpp>

#include "inputs/random.hpp"

namespace boxstream::bench {

/// Where the centres of boxes are, in the unit cube before it is stretched.
enum class Place { uniform, clusters, shell, lattice, diagonal, crossing, point };

/// The order in which boxes come.
enum class Order { shuffled, in_parts, ascending, descending };

/// Boxes of one kind.
struct Part {
  int weight = 1;  ///< share of the boxes, relative to the other parts
  Place place = Place::uniform;
  int groups = 1;                 ///< of clusters; edge of a lattice
  double extent[3] = {0, 0, 0};   ///< decimal logarithms of the edges of the region
  double size[3] = {-2, -2, -2};  ///< decimal logarithms of the sides, in the middle of their range
  double decades = 0;             ///< that the sides range over
  bool alike = true;              ///< the three sides of a box grow together
  int copies = 1;                 ///< of each box
  double snap = 0;                ///< bounds are multiples of this; 0: they are not rounded

  // Not written where they are 0.
  int pieces = 0;     ///< boxes are bars along a random axis, this many end to end; 0: they are not
  double lean = 0;    ///< of bars, the share that is along x whatever the others are
  double jitter = 0;  ///< each end of a bar is moved by up to this, in lengths of bars
  int levels = 0;  ///< how often a box may be moved into the heap at the origin, with a probability of 85 % each time
  double shrink = 0;  ///< decades by which a heap is smaller than its world
};

/// A batch as a few numbers, so that it can be mutated, printed and made again.
struct Recipe {
  std::size_t n = 20000;
  std::uint64_t seed = 1;
  Order order = Order::shuffled;
  int axis = 0;  ///< that `order` sorts along
  std::vector<Part> parts;
};

/// A pure function of the recipe.
std::vector<Aabb> make_boxes(const Recipe& recipe);

/// One line without blanks, for a command line.
std::string to_text(const Recipe& recipe);

/// Throws std::invalid_argument for anything that `to_text` would not write.
Recipe parse_recipe(const std::string& text);

Recipe random_recipe(std::size_t n, batches::Random& random);

/// The recipe with a few of its numbers changed, or a part more or less.
Recipe mutated(const Recipe& recipe, batches::Random& random);

}  // namespace boxstream::bench
