// SPDX-License-Identifier: MIT
// Trees, as the builders make them, before any volume is put around their nodes.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "papers/volumes/builders.hpp"
#include "papers/volumes/splits.hpp"
#include "support.hpp"

namespace boxstream::papers::volumes::tests {
namespace {

void expect_sound(const Tree& tree, std::size_t objects, std::size_t leaf_size, const std::string& what) {
  ASSERT_EQ(tree.order.size(), objects) << what;
  std::vector<std::uint32_t> order = tree.order;
  std::sort(order.begin(), order.end());
  for (std::uint32_t i = 0; i < objects; ++i) ASSERT_EQ(order[i], i) << what;
  ASSERT_EQ(tree.nodes.empty(), objects == 0) << what;
  std::uint32_t next_child = 1;
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const TreeNode& node = tree.nodes[i];
    ASSERT_GT(node.objects, 0u) << what;
    if (i == 0) {
      ASSERT_EQ(node.depth, 0u) << what;
      ASSERT_EQ(node.objects, objects) << what;
    }
    if (node.is_leaf()) {
      ASSERT_LE(node.objects, leaf_size) << what;
      continue;
    }
    ASSERT_EQ(node.first_child, next_child) << what;
    next_child += node.children;
    std::uint32_t next_object = node.first_object;
    for (std::uint32_t c = node.first_child; c < node.first_child + node.children; ++c) {
      ASSERT_EQ(tree.nodes[c].parent, i) << what;
      ASSERT_EQ(tree.nodes[c].depth, node.depth + 1) << what;
      ASSERT_EQ(tree.nodes[c].first_object, next_object) << what;
      next_object += tree.nodes[c].objects;
    }
    ASSERT_EQ(next_object, node.first_object + node.objects) << what;
  }
  if (objects > 0) {
    ASSERT_EQ(next_child, tree.nodes.size()) << what;
  }
}

TEST(VolumeTrees, AreSoundOverAnyInput) {
  for (const Kind& kind : kinds)
    for (const Builder builder : builders())
      for (const std::size_t leaf_size : {1u, 3u}) {
        Random random(1);
        const Boxes boxes = make(kind, random);
        const std::string what = std::string(name(builder)) + ", " + kind.name;
        ASSERT_NO_FATAL_FAILURE(expect_sound(build(builder, Objects::of(boxes), leaf_size), kind.n, leaf_size, what));
      }
}

std::uint32_t depth(const Tree& tree) {
  std::uint32_t depth = 0;
  for (const TreeNode& node : tree.nodes) depth = std::max(depth, node.depth);
  return depth;
}

/// Where boxes tell nothing, ties must not make a list of the tree.
TEST(VolumeTrees, AreShallowWhereAllAreEqualOrFlat) {
  Random random(2);
  const Kind identical{"identical", 512, 3, {0, 0, 0}, {0, 0, 0}}, flat{"flat", 512, 0, {1, 0, 1}, {0.1, 0, 0.1}};
  for (const Builder builder : builders()) {
    EXPECT_LE(depth(build(builder, Objects::of(make(identical, random)))), 12u) << name(builder);
    EXPECT_LE(depth(build(builder, Objects::of(make(flat, random)))), 40u) << name(builder);
  }
  EXPECT_EQ(depth(build(Builder::volume, Objects::of(make(flat, random)))), 9u);
}

TEST(VolumeTrees, TilesAreFull) {
  Random random(3);
  for (const std::size_t n : {1u, 2u, 5u, 64u, 65u, 100u, 257u})
    for (const std::size_t arity : {2u, 4u, 8u}) {
      const Kind kind{"", n, 0, {1, 1, 1}, {1, 1, 1}};
      const Tree tree = build_by_tiling(Atoms(Objects::of(make(kind, random))), 1, arity);
      ASSERT_NO_FATAL_FAILURE(expect_sound(tree, n, 1, std::to_string(n)));
      std::size_t level = n, nodes = n;
      while (level > 1) nodes += level = (level + arity - 1) / arity;
      EXPECT_EQ(tree.nodes.size(), nodes) << n << " by " << arity;
    }
}

/// 4 x 4 x 4 points: the tiles of eight are the octants.
TEST(VolumeTrees, TilesAreTiles) {
  Boxes boxes;
  for (int i = 0; i < 64; ++i) {
    const auto x = static_cast<float>(i % 4), y = static_cast<float>(i / 4 % 4), z = static_cast<float>(i / 16);
    boxes.push_back({{x, y, z}, {x, y, z}});
  }
  const Tree tree = build_by_tiling(Atoms(Objects::of(boxes)), 8, 8);
  ASSERT_EQ(tree.nodes.size(), 9u);
  for (std::uint32_t leaf = 1; leaf < 9; ++leaf) {
    Aabb box = boxes[tree.objects(leaf)[0]];
    for (const std::uint32_t object : tree.objects(leaf)) box = merged(box, boxes[object]);
    for (int d = 0; d < 3; ++d) EXPECT_EQ(box.max[d] - box.min[d], 1);
  }
}

double cost_of_split(const std::vector<Aabb64>& boxes, const std::vector<std::uint32_t>& order, std::size_t j,
                     double (*measure)(const Aabb64&)) {
  Aabb64 low = boxes[order[0]], high = boxes[order[j]];
  for (std::size_t i = 0; i < j; ++i) low = merged(low, boxes[order[i]]);
  for (std::size_t i = j; i < order.size(); ++i) high = merged(high, boxes[order[i]]);
  return measure(low) * static_cast<double>(j) + measure(high) * static_cast<double>(order.size() - j);
}

TEST(VolumeTrees, HeuristicsTakeTheLeastCost) {
  Random random(4);
  const Kind kind{"", 25, 0, {1, 2, 3}, {0.5, 0.5, 0.5}};
  const std::pair<Split, double (*)(const Aabb64&)> heuristics[] = {{split_by_surface_area, area},
                                                                    {split_by_volume, volume}};
  for (int round = 0; round < 50; ++round)
    for (const auto& heuristic : heuristics) {
      const Atoms atoms(Objects::of(make(kind, random)));
      std::vector<std::uint32_t> order(kind.n);
      for (std::uint32_t i = 0; i < kind.n; ++i) order[i] = i;
      double least = std::numeric_limits<double>::infinity();
      for (int axis = 0; axis < 3; ++axis) {
        std::sort(order.begin(), order.end(),
                  [&](auto a, auto b) { return atoms.centres[a][axis] < atoms.centres[b][axis]; });
        for (std::size_t j = 1; j < kind.n; ++j)
          least = std::min(least, cost_of_split(atoms.boxes, order, j, heuristic.second));
      }
      const std::size_t j = heuristic.first(atoms, Span<std::uint32_t>(order));
      EXPECT_DOUBLE_EQ(cost_of_split(atoms.boxes, order, j, heuristic.second), least);
    }
}

/// Two heaps of 3 and 7 along a diagonal: the barycentre, and the areas, tell them apart; the median does not.
TEST(VolumeTrees, SplitsTellHeapsApart) {
  Boxes boxes;
  for (int i = 0; i < 10; ++i) {
    const float at = (i % 3 == 0 && i < 9 ? 0.0F : 50.0F) + static_cast<float>(i) * 0.01F;
    boxes.push_back({{at, at, at}, {at + 1, at + 1, at + 1}});
  }
  const Atoms atoms(Objects::of(boxes));
  const auto low_part = [&](Split split) {
    std::vector<std::uint32_t> order{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    const std::size_t j = split(atoms, Span<std::uint32_t>(order));
    std::vector<std::uint32_t> part(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(j));
    if (part.size() > 5) part.assign(order.begin() + static_cast<std::ptrdiff_t>(j), order.end());
    std::sort(part.begin(), part.end());
    return part;
  };
  const std::vector<std::uint32_t> heap{0, 3, 6};
  EXPECT_EQ(low_part(split_by_surface_area), heap);
  EXPECT_EQ(low_part(split_by_volume), heap);
  EXPECT_EQ(low_part(split_across_principal_axis), heap);
  EXPECT_EQ(low_part(split_at_median).size(), 5u);
}

TEST(VolumeTrees, RefuseWhatTheyCannotHold) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const Boxes inverted{{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {0, 1, 1}}}, endless{{{0, 0, 0}, {1, infinity, 1}}};
  EXPECT_THROW(Objects::of(inverted), std::invalid_argument);
  EXPECT_THROW(Objects::of(endless), std::invalid_argument);
  const std::vector<Triangle> broken{{{{0, 0, 0}, {0, nan, 0}, {1, 0, 0}}}};
  EXPECT_THROW(Objects::of(broken), std::invalid_argument);
  EXPECT_THROW(build(Builder::median, Objects::of(Boxes{}), 0), std::invalid_argument);
}

}  // namespace
}  // namespace boxstream::papers::volumes::tests
