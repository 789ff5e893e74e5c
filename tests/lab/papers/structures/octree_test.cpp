// SPDX-License-Identifier: MIT
#include "papers/structures/octree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "box_sets.hpp"

namespace boxstream::papers::tests {
namespace {

using boxstream::tests::Random;

FirstHit first_of_all(const std::vector<Aabb>& boxes, const Ray& ray) {
  FirstHit first;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) first.offer(ray_enter(ray, boxes[i]), i);
  return first;
}

/// From within, from beside and from afar; aslant, along one axis and along two; whole lines and short ones.
Ray ray_for(const std::vector<Aabb>& boxes, Random& random) {
  const Aabb unit = box_at(-1, -1, -1, 2, 2, 2);
  Aabb all = boxes.empty() ? unit : boxes[0];
  for (const Aabb& box : boxes) all = merged(all, box);
  const Aabb& goal = boxes.empty() ? unit : boxes[random.index(boxes.size())];
  const double away = random.chance(0.1) ? 1000 : random.chance(0.5) ? 2 : 0.5;
  float origin[3], direction[3];
  const bool exact = random.chance(0.3);  // from a corner, to a corner
  for (int d = 0; d < 3; ++d) {
    const double middle = 0.5 * (double{all.min[d]} + double{all.max[d]});
    const double half = 0.5 * (double{all.max[d]} - double{all.min[d]}) + 1e-3;
    origin[d] = static_cast<float>(middle + random.between(-away, away) * half);
    if (exact && random.chance(0.5)) origin[d] = goal.min[d];
    direction[d] = (random.chance(0.5) ? goal.min[d] : goal.max[d]) - origin[d];
    if (random.chance(0.2)) direction[d] = 0;
  }
  const float length = random.chance(0.3) ? static_cast<float>(random.unit()) : 4;
  return Ray::along(origin, direction, length);
}

TEST(Octree, FindsTheFirstBoxOnTheRay) {
  for (const BoxSet& set : box_sets())
    for (const OctreeOptions options : {OctreeOptions{}, OctreeOptions{8, 3}, OctreeOptions{1, 0}}) {
      const Octree tree(set.boxes, options);
      Octree::Mailboxes mail(tree);
      Random random(4);
      int hits = 0;
      for (int i = 0; i < 300; ++i) {
        const Ray ray = ray_for(set.boxes, random);
        const FirstHit expected = first_of_all(set.boxes, ray);
        const FirstHit hit = tree.first_hit(ray, mail);
        ASSERT_EQ(hit.number, expected.number) << set.name << ", ray " << i;
        ASSERT_EQ(hit.enter, expected.enter) << set.name << ", ray " << i;
        hits += hit.number != FirstHit::none;
      }
      if (set.boxes.empty()) {
        EXPECT_EQ(hits, 0);
      } else {
        EXPECT_GT(hits, 30) << set.name;
      }
    }
}

/// A ray that begins in a box is there at once; one along a face, and one that ends at a face, touch it.
TEST(Octree, ClosedAtFaces) {
  const std::vector<Aabb> boxes{box_at(0, 0, 0, 1, 1, 1), box_at(4, 0, 0, 1, 1, 1), box_at(4, 3, 0, 1, 1, 1)};
  const Octree tree(boxes);
  Octree::Mailboxes mail(tree);
  const auto shoot = [&](const float(&origin)[3], const float(&direction)[3], float length) {
    return tree.first_hit(Ray::along(origin, direction, length), mail);
  };
  EXPECT_EQ(shoot({0.5F, 0.5F, 0.5F}, {1, 0, 0}, 10), (FirstHit{0, 0}));
  EXPECT_EQ(shoot({2, 1, 1}, {1, 0, 0}, 10), (FirstHit{2, 1}));
  EXPECT_EQ(shoot({2, 1, 1}, {1, 0, 0}, 2), (FirstHit{2, 1}));
  EXPECT_EQ(shoot({2, 1, 1}, {1, 0, 0}, 1.99F), FirstHit{});
  EXPECT_EQ(shoot({2, 1, 1}, {-1, 0, 0}, 10), (FirstHit{1, 0}));
  EXPECT_EQ(shoot({4.5F, 9, 0.5F}, {0, -1, 0}, 20), (FirstHit{5, 2}));
  EXPECT_EQ(shoot({4.5F, 2, 0.5F}, {0, 0, 0}, 20), FirstHit{});
  EXPECT_EQ(shoot({4.5F, 0.5F, 0.5F}, {0, 0, 0}, 20), (FirstHit{0, 1}));
}

/// Among boxes entered at once, the smallest number wins, wherever they are listed.
TEST(Octree, TiesGoToTheSmallestNumber) {
  std::vector<Aabb> boxes;
  for (int i = 0; i < 64; ++i) boxes.push_back(box_at(5, static_cast<float>(63 - i), 0, 1, 1, 1));
  boxes.push_back(box_at(5, 0, 0, 1, 64, 1));
  const Octree tree(boxes);
  Octree::Mailboxes mail(tree);
  const float direction[3] = {1, 0, 0};
  for (int i = 0; i < 64; ++i) {
    const float origin[3] = {0, static_cast<float>(63 - i) + 0.5F, 0.5F};
    EXPECT_EQ(tree.first_hit(Ray::along(origin, direction, 100), mail).number, static_cast<std::uint32_t>(i));
  }
}

/// Splitting stops where it does not pay, so that objects are not listed in each of the cells that they reach.
TEST(Octree, ListsStayShort) {
  for (const BoxSet& set : box_sets()) {
    if (set.boxes.empty()) continue;
    const Octree tree(set.boxes);
    EXPECT_GE(tree.listed(), set.boxes.size()) << set.name;
    // Rods and plates are in many cells, but never in all of a plane of 4096 x 4096.
    EXPECT_LT(tree.listed(), 600 * set.boxes.size()) << set.name;
    EXPECT_EQ(tree.cells() % 8, 1u) << set.name;
  }
}

}  // namespace
}  // namespace boxstream::papers::tests
