// SPDX-License-Identifier: MIT
#include "out_of_core/regions.hpp"

#include <algorithm>
#include <queue>
#include <utility>

namespace boxstream::detail {

namespace {

template <class S>
struct Cut {
  int axis = -1;
  typename KeyBox<S>::Key key = 0;
  std::size_t copies = 0;  // boxes on both sides together
};

/// Where a box begins, with about as many boxes on either side; those that are cut count on both.
template <class S>
Cut<S> cut_on(int axis, Span<const KeyBox<S>> boxes) {
  std::vector<typename KeyBox<S>::Key> lows, highs;
  for (const KeyBox<S>& box : boxes) {
    lows.push_back(box.lo[axis]);
    highs.push_back(box.hi[axis]);
  }
  std::sort(lows.begin(), lows.end());
  std::sort(highs.begin(), highs.end());
  const auto less = [](const auto& keys, auto key) {
    return static_cast<std::size_t>(std::lower_bound(keys.begin(), keys.end(), key) - keys.begin());
  };
  const auto key = *std::partition_point(lows.begin(), lows.end() - 1,
                                         [&](auto low) { return less(lows, low) + less(highs, low) < boxes.size(); });
  const std::size_t below = less(lows, key), above = boxes.size() - less(highs, key);
  const bool separates = std::max(below, above) * 4 <= boxes.size() * 3;
  if (!separates) return {};
  return {axis, key, below + above};
}

/// The one with the fewest copies; without an axis if none separates boxes.
template <class S>
Cut<S> best_cut(Span<const KeyBox<S>> boxes) {
  Cut<S> best;
  for (int axis = 0; axis < 3; ++axis) {
    const Cut<S> cut = cut_on(axis, boxes);
    if (cut.axis >= 0 && (best.axis < 0 || cut.copies < best.copies)) best = cut;
  }
  return best;
}

/// A leaf of the growing tree, and the part of the sample that touches it.
template <class S>
struct Leaf {
  std::uint32_t node;
  Region<S> region;
  std::vector<KeyBox<S>> boxes;

  bool operator<(const Leaf& other) const { return boxes.size() < other.boxes.size(); }
};

template <class S>
std::pair<Leaf<S>, Leaf<S>> divide(const Leaf<S>& leaf, const Cut<S>& cut, std::uint32_t below) {
  Leaf<S> low{below, leaf.region, {}}, high{below + 1, leaf.region, {}};
  low.region.last[cut.axis] = cut.key - 1;
  high.region.first[cut.axis] = cut.key;
  for (const KeyBox<S>& box : leaf.boxes) {
    if (box.lo[cut.axis] < cut.key) low.boxes.push_back(box);
    if (box.hi[cut.axis] >= cut.key) high.boxes.push_back(box);
  }
  return {std::move(low), std::move(high)};
}

}  // namespace

template <class S>
Regions<S>::Regions(const Region<S>& whole, std::vector<KeyBox<S>> sample, std::size_t most_boxes,
                    std::size_t most_regions) {
  std::priority_queue<Leaf<S>> large;
  const auto add = [&](Leaf<S> leaf) {
    if (leaf.boxes.size() > most_boxes) return large.push(std::move(leaf));
    nodes_[leaf.node].below = static_cast<std::uint32_t>(regions_.size());
    regions_.push_back(leaf.region);
  };
  nodes_.emplace_back();
  add({0, whole, std::move(sample)});
  while (!large.empty()) {
    Leaf<S> leaf = large.top();
    large.pop();
    Cut<S> cut;
    if (regions_.size() + large.size() + 1 < most_regions) cut = best_cut<S>(leaf.boxes);
    if (cut.axis < 0) {
      nodes_[leaf.node].below = static_cast<std::uint32_t>(regions_.size());
      regions_.push_back(leaf.region);
      continue;
    }
    const auto below = static_cast<std::uint32_t>(nodes_.size());
    nodes_[leaf.node] = {cut.axis, cut.key, below};
    nodes_.resize(nodes_.size() + 2);
    auto [low, high] = divide(leaf, cut, below);
    add(std::move(low));
    add(std::move(high));
  }
}

template class Regions<float>;
template class Regions<double>;

}  // namespace boxstream::detail
