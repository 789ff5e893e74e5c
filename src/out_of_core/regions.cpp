// SPDX-License-Identifier: MIT
#include "out_of_core/regions.hpp"

#include <algorithm>
#include <bit>
#include <queue>
#include <utility>

#include "out_of_core/buffers.hpp"

namespace boxstream::detail {

namespace {

/// How many of the regions are to be below a cut, and above it.
struct Shares {
  std::uint64_t below = 1, above = 1;
};

/// How many cuts there are above all leaves of a tree with `leaves`, when each cut halves them.
std::uint64_t cuts_above(std::uint64_t leaves) {
  const auto levels = static_cast<std::uint64_t>(std::bit_width(leaves)) - 1;
  return leaves * levels + 2 * (leaves - (std::uint64_t{1} << levels));
}

/// Where there will be more cuts, there will be more copies: the other side gets more boxes now, if each cut makes as
/// large a share of copies as this one did. All in 1024ths.
Shares with_copies_to_come(Shares parts, std::size_t boxes, std::size_t copies) {
  const std::uint64_t more_cuts = 1024 *
                                  (cuts_above(parts.above) * parts.below - cuts_above(parts.below) * parts.above) /
                                  (parts.below * parts.above);
  return {parts.below * (1024 + more_cuts * (copies - boxes) / boxes), parts.above * 1024};
}

template <class S>
struct Cut {
  int axis = -1;
  typename KeyBox<S>::Key key = 0;
  std::size_t copies = 0;  // boxes on both sides together
};

/// The least of `lows` at which the lower side has its share of the boxes on both sides; if none, the greatest. Of
/// `lows` and `highs`, which it reorders, half are ruled out each time, so that it takes linear time.
template <class Key>
Key balanced_low(std::vector<Key>& lows, std::vector<Key>& highs, Shares shares) {
  Key best = *std::max_element(lows.begin(), lows.end());
  auto low = lows.begin(), low_end = lows.end(), high = highs.begin(), high_end = highs.end();
  while (low != low_end) {
    const auto middle = low + (low_end - low) / 2;
    std::nth_element(low, middle, low_end);
    const Key key = *middle;
    const auto is_less = [key](Key other) { return other < key; };
    const auto low_less = std::partition(low, middle, is_less), high_less = std::partition(high, high_end, is_less);
    const auto below = static_cast<std::uint64_t>(low_less - lows.begin());
    const auto above = static_cast<std::uint64_t>(highs.end() - high_less);
    if (below * shares.above < above * shares.below) {
      low = std::partition(middle, low_end, [key](Key other) { return other == key; });
      high = high_less;
    } else {
      best = key;
      low_end = low_less;
      high_end = high_less;
    }
  }
  return best;
}

/// Where a box begins, with about as many boxes on either side as its share says; those that are cut count on both.
template <class S>
Cut<S> cut_on(int axis, Span<const KeyBox<S>> boxes, Shares shares) {
  std::vector<typename KeyBox<S>::Key> lows, highs;
  lows.reserve(boxes.size());
  highs.reserve(boxes.size());
  for (const KeyBox<S>& box : boxes) {
    lows.push_back(box.lo[axis]);
    highs.push_back(box.hi[axis]);
  }
  const auto key = balanced_low(lows, highs, shares);
  const auto less = [key](const auto& keys) {
    return static_cast<std::size_t>(std::count_if(keys.begin(), keys.end(), [key](auto k) { return k < key; }));
  };
  const std::size_t below = less(lows), above = boxes.size() - less(highs);
  // Less than half as many again as the share: of equal shares, three quarters of the boxes.
  const auto is_small = [&](std::uint64_t part, std::uint64_t share) {
    return part * (shares.below + shares.above) * 2 < boxes.size() * share * 3;
  };
  if (!is_small(below, shares.below) || !is_small(above, shares.above)) return {};
  return {axis, key, below + above};
}

/// The one with the fewest copies; without an axis if none separates boxes.
template <class S>
Cut<S> best_cut(Span<const KeyBox<S>> boxes, Shares shares = {}) {
  Cut<S> best;
  for (int axis = 0; axis < 3 && !boxes.empty(); ++axis) {
    const Cut<S> cut = cut_on(axis, boxes, shares);
    if (cut.axis >= 0 && (best.axis < 0 || cut.copies < best.copies)) best = cut;
  }
  return best;
}

}  // namespace

/// A leaf of the growing tree, and the part of the sample that touches it.
template <class S>
struct Regions<S>::Leaf {
  std::uint32_t node;
  Region<S> region;
  std::vector<KeyBox<S>> boxes;

  bool operator<(const Leaf& other) const { return boxes.size() < other.boxes.size(); }

  std::pair<Leaf, Leaf> divide(const Cut<S>& cut, std::uint32_t below) const {
    Leaf low{below, region, {}}, high{below + 1, region, {}};
    low.region.last[cut.axis] = cut.key - 1;
    high.region.first[cut.axis] = cut.key;
    for (const KeyBox<S>& box : boxes) {
      if (box.lo[cut.axis] < cut.key) low.boxes.push_back(box);
      if (box.hi[cut.axis] >= cut.key) high.boxes.push_back(box);
    }
    return {std::move(low), std::move(high)};
  }
};

template <class S>
Regions<S>::Regions(const Region<S>& whole, std::vector<KeyBox<S>> sample, std::size_t most_boxes,
                    std::size_t most_regions) {
  std::priority_queue<Leaf> large;
  const auto add = [&](Leaf leaf) {
    if (leaf.boxes.size() > most_boxes) return large.push(std::move(leaf));
    keep(leaf);
  };
  add({0, whole, std::move(sample)});
  while (!large.empty()) {
    const Leaf leaf = large.top();
    large.pop();
    Cut<S> cut;
    if (regions_.size() + large.size() + 1 < most_regions) cut = best_cut<S>(leaf.boxes);
    if (cut.axis < 0) {
      keep(leaf);
      continue;
    }
    auto [low, high] = leaf.divide(cut, add_nodes(leaf.node, cut.axis, cut.key));
    add(std::move(low));
    add(std::move(high));
  }
}

template <class S>
Regions<S>::Regions(std::vector<KeyBox<S>> sample, std::size_t regions) {
  divide({0, {}, std::move(sample)}, regions);
}

template <class S>
void Regions<S>::divide(Leaf leaf, std::size_t regions) {
  const Shares parts{regions / 2, regions - regions / 2};
  Cut<S> cut;
  if (regions > 1) cut = best_cut<S>(leaf.boxes, parts);
  if (cut.axis >= 0 && parts.below < parts.above)
    cut = best_cut<S>(leaf.boxes, with_copies_to_come(parts, leaf.boxes.size(), cut.copies));
  if (cut.axis < 0) return keep(leaf);
  auto [low, high] = leaf.divide(cut, add_nodes(leaf.node, cut.axis, cut.key));
  give_up(leaf.boxes);
  divide(std::move(low), parts.below);
  divide(std::move(high), parts.above);
}

template <class S>
void Regions<S>::keep(const Leaf& leaf) {
  nodes_[leaf.node].below = static_cast<std::uint32_t>(regions_.size());
  regions_.push_back(leaf.region);
}

template <class S>
std::uint32_t Regions<S>::add_nodes(std::uint32_t above, int axis, Key key) {
  const auto below = static_cast<std::uint32_t>(nodes_.size());
  nodes_[above] = {axis, key, below};
  nodes_.resize(nodes_.size() + 2);
  return below;
}

template class Regions<float>;
template class Regions<double>;

}  // namespace boxstream::detail
