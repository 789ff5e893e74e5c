// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

#include "base/keys.hpp"

namespace boxstream::detail {

/// A box as order keys, which compare as its bounds do.
template <class S>
struct KeyBox {
  using Key = decltype(order_key(S()));

  KeyBox() = default;
  explicit KeyBox(const BasicAabb<S>& box) {
    for (int d = 0; d < 3; ++d) {
      lo[d] = order_key(box.min[d]);
      hi[d] = order_key(box.max[d]);
    }
  }

  Key lo[3], hi[3];
};

/// A part of space: the points whose keys are from `first` to `last`.
template <class S>
struct Region {
  using Key = typename KeyBox<S>::Key;

  /// On which axes (bit d) a box begins before the region. Of two boxes that touch a region, it has the low corner of
  /// what they share unless both begin before it on one axis.
  std::uint8_t before(const BasicAabb<S>& box) const {
    unsigned bits = 0;
    for (int d = 0; d < 3; ++d) bits |= (order_key(box.min[d]) < first[d] ? 1u : 0u) << d;
    return static_cast<std::uint8_t>(bits);
  }

  static constexpr Key lowest = std::numeric_limits<Key>::min(), highest = std::numeric_limits<Key>::max();
  Key first[3] = {lowest, lowest, lowest};
  Key last[3] = {highest, highest, highest};
};

/// A region divided into regions that about equally many boxes touch: a k-d tree, made for a sample of the boxes.
/// A function of the boxes in the sample, not of their order.
template <class S>
class Regions {
 public:
  /// Regions are divided until none is touched by more than `most_boxes` of the sample, until there are `most_regions`,
  /// or as far as that separates boxes.
  Regions(const Region<S>& whole, std::vector<KeyBox<S>> sample, std::size_t most_boxes, std::size_t most_regions);

  /// All of space divided into as many regions as are wanted, or as far as that separates boxes.
  Regions(std::vector<KeyBox<S>> sample, std::size_t regions);

  std::size_t size() const { return regions_.size(); }
  const Region<S>& operator[](std::size_t i) const { return regions_[i]; }

  /// Calls `visit(i)` for each region that the valid `box` touches.
  template <class Visit>
  void for_each_touched(const BasicAabb<S>& box, Visit&& visit) const {
    descend(0, KeyBox<S>(box), visit);
  }

 private:
  using Key = typename KeyBox<S>::Key;
  struct Leaf;

  /// Below the key is the node `below`; the other one follows it. Without an axis: region `below`.
  struct Node {
    int axis = -1;
    Key key = 0;
    std::uint32_t below = 0;
  };

  template <class Visit>
  void descend(std::uint32_t node, const KeyBox<S>& box, Visit& visit) const {
    const Node& n = nodes_[node];
    if (n.axis < 0) return visit(std::size_t{n.below});
    if (box.lo[n.axis] < n.key) descend(n.below, box, visit);
    if (box.hi[n.axis] >= n.key) descend(n.below + 1, box, visit);
  }

  void keep(const Leaf& leaf);
  /// Two below the node, which is cut there; returns the first.
  std::uint32_t add_nodes(std::uint32_t above, int axis, Key key);
  void divide(Leaf leaf, std::size_t regions);

  std::vector<Node> nodes_{{}};
  std::vector<Region<S>> regions_;
};

extern template class Regions<float>;
extern template class Regions<double>;

}  // namespace boxstream::detail
