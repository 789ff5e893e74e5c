// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/ray.hpp>
#include <boxstream/span.hpp>

#include "papers/structures/first_hit.hpp"

namespace boxstream::papers {

struct OctreeOptions {
  std::size_t most_in_leaf = 1;
  int depth = 12;  ///< the root has depth 0
};

/// An octree over boxes for ray shooting, sections 2.1 and 2.5.1: a cell with more than one object has eight sub-cells,
/// halves along each axis, and a leaf lists all objects that it has a part of.
///
/// One rule is not the paper's. A random line through a cell goes through two of its sub-cells on average (the sum of
/// their surfaces over its own), a quarter of them, and so tests a quarter of the objects that they list together. So a
/// cell is left whole when its sub-cells would list three times what it has, or more: without that, objects that are
/// large, or that share a place, are listed in each of the 8^depth cells that they reach.
class Octree {
 public:
  /// The boxes must stay as they are, valid and finite.
  explicit Octree(Span<const Aabb> boxes, OctreeOptions options = {});

  /// The mailboxes of section 2.5: with which ray an object was tested last, so that none is tested twice. One for each
  /// thread that shoots rays.
  class Mailboxes {
   public:
    explicit Mailboxes(const Octree& tree) : last_(tree.boxes_.size(), 0) {}

   private:
    friend class Octree;
    std::vector<std::uint32_t> last_;
    std::uint32_t ray_ = 0;
  };

  /// Plain rays only (no extents).
  FirstHit first_hit(const Ray& ray, Mailboxes& mail) const;

  std::size_t cells() const { return cells_.size(); }
  /// Objects in lists, each as often as it is in one.
  std::size_t listed() const { return lists_.size(); }

 private:
  using Vector = std::array<double, 3>;

  struct Cell {
    std::uint32_t first;  // of the eight sub-cells, or of the list
    std::uint32_t count;  // of the list
    bool is_leaf;
  };
  struct Bounds {
    Vector low, high;
  };

  void build(std::size_t cell, const Bounds& bounds, const std::vector<std::uint32_t>& objects, int levels_left);

  class Shot;

  Span<const Aabb> boxes_;
  OctreeOptions options_;
  Bounds bounds_{};
  double slack_ = 0;  // by which objects are larger for cells than they are, against rounding
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> lists_;
};

}  // namespace boxstream::papers
