// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

namespace boxstream::bench {

/// A tree of boxes as one writes it first: halves by the median of the centres on the axis where these are spread most,
/// down to leaves of up to six boxes, which lie together.
class PlainTree {
 public:
  void build(Span<const Aabb> boxes) {
    boxes_.clear();
    nodes_.clear();
    for (std::uint32_t i = 0; i < boxes.size(); ++i) boxes_.push_back({boxes[i], i});
    if (!boxes_.empty()) build(0, static_cast<std::uint32_t>(boxes_.size()));
  }

  /// Calls `found(i, j)` for each two boxes that touch, once.
  template <class Found>
  void pairs_within(const Found& found) const {
    if (!nodes_.empty()) within(0, found);
  }

  /// The same between this tree and another, `i` being of this one.
  template <class Found>
  void pairs_with(const PlainTree& other, const Found& found) const {
    if (!nodes_.empty() && !other.nodes_.empty()) between(0, other, 0, found);
  }

  /// Calls `found(i)` for each box that touches `box`.
  template <class Found>
  void query(const Aabb& box, const Found& found) const {
    if (!nodes_.empty()) query(0, box, found);
  }

 private:
  static constexpr std::uint32_t most_in_leaf = 6;

  struct Item {
    Aabb box;
    std::uint32_t index;
  };

  /// The left child of an inner node follows it; `right` is 0 in leaves.
  struct Node {
    Aabb box;
    std::uint32_t first, last, right;
  };

  static float centre(const Aabb& box, int d) { return 0.5f * box.min[d] + 0.5f * box.max[d]; }

  static Aabb around(const Item* first, const Item* last) {
    Aabb all = first->box;
    for (const Item* item = first; item != last; ++item)
      for (int d = 0; d < 3; ++d) {
        all.min[d] = std::min(all.min[d], item->box.min[d]);
        all.max[d] = std::max(all.max[d], item->box.max[d]);
      }
    return all;
  }

  static int widest_axis(const Item* first, const Item* last) {
    float spread[3];
    for (int d = 0; d < 3; ++d) {
      float low = centre(first->box, d), high = low;
      for (const Item* item = first; item != last; ++item) {
        low = std::min(low, centre(item->box, d));
        high = std::max(high, centre(item->box, d));
      }
      spread[d] = high - low;
    }
    return static_cast<int>(std::max_element(spread, spread + 3) - spread);
  }

  void build(std::uint32_t first, std::uint32_t last) {
    const std::size_t node = nodes_.size();
    Item *begin = boxes_.data() + first, *end = boxes_.data() + last;
    nodes_.push_back({around(begin, end), first, last, 0});
    if (last - first <= most_in_leaf) return;
    const int d = widest_axis(begin, end);
    const std::uint32_t middle = first + (last - first) / 2;
    std::nth_element(begin, boxes_.data() + middle, end,
                     [d](const Item& x, const Item& y) { return centre(x.box, d) < centre(y.box, d); });
    build(first, middle);
    nodes_[node].right = static_cast<std::uint32_t>(nodes_.size());
    build(middle, last);
  }

  template <class Found>
  void within(std::uint32_t at, const Found& found) const {
    const Node& node = nodes_[at];
    if (node.right == 0) {
      for (std::uint32_t i = node.first; i < node.last; ++i)
        for (std::uint32_t j = i + 1; j < node.last; ++j)
          if (overlaps(boxes_[i].box, boxes_[j].box)) found(boxes_[i].index, boxes_[j].index);
      return;
    }
    within(at + 1, found);
    within(node.right, found);
    between(at + 1, *this, node.right, found);
  }

  template <class Found>
  void between(std::uint32_t at, const PlainTree& other, std::uint32_t other_at, const Found& found) const {
    const Node &a = nodes_[at], &b = other.nodes_[other_at];
    if (!overlaps(a.box, b.box)) return;
    if (a.right == 0 && b.right == 0) {
      for (std::uint32_t i = a.first; i < a.last; ++i) {
        if (!overlaps(boxes_[i].box, b.box)) continue;
        for (std::uint32_t j = b.first; j < b.last; ++j)
          if (overlaps(boxes_[i].box, other.boxes_[j].box)) found(boxes_[i].index, other.boxes_[j].index);
      }
    } else if (b.right == 0 || (a.right != 0 && a.last - a.first >= b.last - b.first)) {
      between(at + 1, other, other_at, found);
      between(a.right, other, other_at, found);
    } else {
      between(at, other, other_at + 1, found);
      between(at, other, b.right, found);
    }
  }

  template <class Found>
  void query(std::uint32_t at, const Aabb& box, const Found& found) const {
    const Node& node = nodes_[at];
    if (!overlaps(node.box, box)) return;
    if (node.right != 0) {
      query(at + 1, box, found);
      query(node.right, box, found);
      return;
    }
    for (std::uint32_t i = node.first; i < node.last; ++i)
      if (overlaps(boxes_[i].box, box)) found(boxes_[i].index);
  }

  std::vector<Item> boxes_;
  std::vector<Node> nodes_;
};

}  // namespace boxstream::bench
