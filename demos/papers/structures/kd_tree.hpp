// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace boxstream::papers {

template <int K>
struct KdPoint {
  std::array<float, K> at;  ///< no NaN
  std::uint32_t number;
};

/// All points with min[a] <= at[a] <= max[a] on each axis. Bounds may be infinite.
template <int K>
struct KdRange {
  std::array<float, K> min, max;
};

/// The balanced k-d tree of section 2.2: split at the median of the first axis, each half at the median of the second,
/// and so on around. A range query takes O(n^(1 - 1/K) + answers).
///
/// The tree is the order of its points: the node of points [first, last) is the median in the middle of them, its
/// children are what lies before and after. So it takes no memory beside the points. A point on the split line stays in
/// the node, where the paper, which has no two equal coordinates, sends all points down to leaves; equal coordinates
/// may be on both sides.
template <int K>
class KdTree {
 public:
  using Item = KdPoint<K>;
  using Query = KdRange<K>;

  /// Fewer points than this are not split further.
  static constexpr std::size_t leaf_size = 8;

  static constexpr std::size_t middle(std::size_t first, std::size_t last) { return first + (last - first) / 2; }

  KdTree() = default;

  /// By selection: O(n log n) expected.
  explicit KdTree(std::vector<Item> items) : items_(std::move(items)) { arrange(0, items_.size(), 0); }

  /// Of items that are in the order of a tree already.
  static KdTree of_arranged(std::vector<Item> items) {
    KdTree tree;
    tree.items_ = std::move(items);
    return tree;
  }

  /// Calls `visit(item)` for each point in the range. Returns how many nodes and points it visited, for callers that
  /// count; points of a subtree that lies in the range as a whole are reported and not looked at.
  template <class Visit>
  std::size_t query(const Query& range, Visit&& visit) const {
    unsigned inside = 0;
    for (int a = 0; a < K; ++a) {
      const auto axis = static_cast<std::size_t>(a);
      if (range.min[axis] == -std::numeric_limits<float>::infinity()) inside |= low_side(a);
      if (range.max[axis] == std::numeric_limits<float>::infinity()) inside |= high_side(a);
    }
    return walk(range, 0, items_.size(), 0, inside, visit);
  }

  Span<const Item> items() const { return items_; }

 private:
  static constexpr unsigned low_side(int axis) { return 1u << (2 * axis); }
  static constexpr unsigned high_side(int axis) { return 2u << (2 * axis); }
  static constexpr unsigned all_sides = (1u << (2 * K)) - 1;
  static constexpr int next(int axis) { return axis + 1 == K ? 0 : axis + 1; }

  void arrange(std::size_t first, std::size_t last, int axis) {
    if (last - first < leaf_size) return;
    const std::size_t mid = middle(first, last);
    const auto at = [&](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto a = static_cast<std::size_t>(axis);
    std::nth_element(at(first), at(mid), at(last), [a](const Item& x, const Item& y) { return x.at[a] < y.at[a]; });
    arrange(first, mid, next(axis));
    arrange(mid + 1, last, next(axis));
  }

  static bool contains(const Query& range, const Item& item) {
    for (std::size_t a = 0; a < K; ++a)
      if (!(range.min[a] <= item.at[a] && item.at[a] <= range.max[a])) return false;
    return true;
  }

  /// `inside` has the sides of the range that the region R of this node keeps; if all, R lies in the range.
  template <class Visit>
  std::size_t walk(const Query& range, std::size_t first, std::size_t last, int axis, unsigned inside,
                   Visit& visit) const {
    if (inside == all_sides) {
      for (std::size_t i = first; i < last; ++i) visit(items_[i]);
      return 1;
    }
    if (last - first < leaf_size) {
      for (std::size_t i = first; i < last; ++i)
        if (contains(range, items_[i])) visit(items_[i]);
      return 1 + last - first;
    }
    const std::size_t mid = middle(first, last);
    const float split = items_[mid].at[static_cast<std::size_t>(axis)];
    const bool reaches_low = range.min[static_cast<std::size_t>(axis)] <= split;
    const bool reaches_high = split <= range.max[static_cast<std::size_t>(axis)];
    std::size_t looked_at = 1;
    if (reaches_low && reaches_high && contains(range, items_[mid])) visit(items_[mid]);
    if (reaches_low)
      looked_at += walk(range, first, mid, next(axis), inside | (reaches_high ? high_side(axis) : 0), visit);
    if (reaches_high)
      looked_at += walk(range, mid + 1, last, next(axis), inside | (reaches_low ? low_side(axis) : 0), visit);
    return looked_at;
  }

  std::vector<Item> items_;
};

// Boxes as points: a box is the point of its six bounds, and the boxes that touch a given one are a range of such
// points, open to one side on each axis. This is how a structure for points, such as the k-d tree, finds boxes.

using KdBoxes = KdTree<6>;

inline KdPoint<6> as_point(const Aabb& box, std::uint32_t number) {
  return {{box.min[0], box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]}, number};
}

/// x.min <= box.max and x.max >= box.min.
inline KdRange<6> touching(const Aabb& box) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  return {{-inf, -inf, -inf, box.min[0], box.min[1], box.min[2]}, {box.max[0], box.max[1], box.max[2], inf, inf, inf}};
}

}  // namespace boxstream::papers
