// SPDX-License-Identifier: MIT
// Every builder with every volume, against brute force.
#include <gtest/gtest.h>

#include "papers/volumes/builders.hpp"
#include "papers/volumes/front.hpp"
#include "papers/volumes/query.hpp"
#include "sanitized.hpp"
#include "support.hpp"
#include "truth.hpp"

namespace boxstream::papers::volumes::tests {
namespace {

using boxstream::papers::tests::same_pairs;

template <class V>
class HierarchyTest : public ::testing::Test {};
TYPED_TEST_SUITE(HierarchyTest, AllVolumes);

constexpr Descent descents[] = {Descent::both_sides, Descent::one_side};

std::string label(Builder builder, const Kind& kind, std::size_t leaf_size) {
  return std::string(name(builder)) + ", " + kind.name + ", leaves of " + std::to_string(leaf_size);
}

/// For every kind of input, builder and leaf size.
template <class Check>
void for_each_case(const Check& check) {
  for (const Kind& kind : kinds)
    for (const Builder builder : builders())
      for (const std::size_t leaf_size : {1u, 4u}) {
        check(kind, builder, leaf_size);
        if (::testing::Test::HasFatalFailure()) return;
      }
}

template <class V>
void expect_enclosed(const Hierarchy<V>& hierarchy, const Objects& objects, const std::string& what) {
  for (std::uint32_t node = 0; node < hierarchy.tree().nodes.size(); ++node)
    for (const std::uint32_t object : hierarchy.tree().objects(node))
      for (const Point& corner : objects.corners(object))
        ASSERT_TRUE(inside(hierarchy.volume(node), corner)) << what << ", node " << node << ", object " << object;
}

TYPED_TEST(HierarchyTest, VolumesEncloseAllBeneath) {
  Random random(1);
  for_each_case([&](const Kind& kind, Builder builder, std::size_t leaf_size) {
    Boxes boxes = make(kind, random);
    const Objects objects = Objects::of(boxes);
    Hierarchy<TypeParam> hierarchy(build(builder, objects, leaf_size), objects);
    const std::string what = label(builder, kind, leaf_size);
    ASSERT_NO_FATAL_FAILURE(expect_enclosed(hierarchy, objects, what));
    move(boxes, kind, 0.3, random);
    const Objects moved = Objects::of(boxes);
    Counts counts;
    hierarchy.refit(moved, counts);
    EXPECT_EQ(counts.updates, hierarchy.tree().nodes.size());
    ASSERT_NO_FATAL_FAILURE(expect_enclosed(hierarchy, moved, what + ", refitted"));
  });
}

TYPED_TEST(HierarchyTest, VolumesEncloseTriangles) {
  Random random(2);
  std::vector<Triangle> triangles(100);
  for (Triangle& triangle : triangles)
    for (auto& corner : triangle.corners)
      for (float& x : corner) x = static_cast<float>(random.between(-1, 1));
  const Objects objects = Objects::of(triangles);
  for (const Builder builder : builders()) {
    const Hierarchy<TypeParam> hierarchy(build(builder, objects, 2), objects);
    ASSERT_NO_FATAL_FAILURE(expect_enclosed(hierarchy, objects, std::string(name(builder))));
  }
}

TYPED_TEST(HierarchyTest, QueriesFindWhatBruteForceFinds) {
  Random random(3);
  for_each_case([&](const Kind& kind, Builder builder, std::size_t leaf_size) {
    const Boxes boxes = make(kind, random);
    const Objects objects = Objects::of(boxes);
    const Hierarchy<TypeParam> hierarchy(build(builder, objects, leaf_size), objects);
    Kind probes = kind;
    probes.n = 5;
    for (const Aabb& probe : make(probes, random)) {
      const Objects asked = Objects::of(Span<const Aabb>(&probe, 1));
      std::vector<std::uint32_t> found, expected;
      Counts counts;
      query(
          hierarchy, TypeParam::around(asked.corners(0)), [&](std::uint32_t i) { return overlaps(boxes[i], probe); },
          [&](std::uint32_t i) { found.push_back(i); }, counts);
      for (std::uint32_t i = 0; i < boxes.size(); ++i)
        if (overlaps(boxes[i], probe)) expected.push_back(i);
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, expected) << label(builder, kind, leaf_size);
      ASSERT_LE(counts.primitive_tests, boxes.size());
    }
  });
}

TYPED_TEST(HierarchyTest, PairsAreThoseOfBruteForce) {
  Random random(4);
  for_each_case([&](const Kind& kind, Builder builder, std::size_t leaf_size) {
    const Boxes a = make(kind, random);
    Kind other = kind;
    other.n = kind.n / 2 + 1;
    const Boxes b = make(other, random);
    const Objects objects_a = Objects::of(a), objects_b = Objects::of(b);
    const Hierarchy<TypeParam> tree_a(build(builder, objects_a, leaf_size), objects_a);
    const Hierarchy<TypeParam> tree_b(build(Builder::median, objects_b, leaf_size), objects_b);
    for (const Descent descent : descents) {
      Pairs within, between;
      Counts counts;
      traverse(
          tree_a, tree_a, descent, [&](auto i, auto j) { return overlaps(a[i], a[j]); },
          [&](auto i, auto j) {
            within.push_back({i, j});
          },
          counts);
      ASSERT_LE(counts.primitive_tests, a.size() * a.size() / 2);
      traverse(
          tree_a, tree_b, descent, [&](auto i, auto j) { return overlaps(a[i], b[j]); },
          [&](auto i, auto j) {
            between.push_back({i, j});
          },
          counts);
      ASSERT_TRUE(same_pairs(within, truth(a), label(builder, kind, leaf_size)));
      ASSERT_TRUE(same_pairs(between, truth(a, b), label(builder, kind, leaf_size) + ", two sets"));
    }
  });
}

/// 50 frames: the pairs of brute force, in fewer visits than a search from the root over the same volumes.
template <class V>
void check_frames(const Kind& kind, Builder builder, Descent descent, double step, bool two_sets, Random& random) {
  const std::string what = label(builder, kind, 2) + (two_sets ? ", two sets" : "");
  Boxes a = make(kind, random), b = make(kind, random);
  const auto tree = [&](const Boxes& boxes) {
    const Objects objects = Objects::of(boxes);
    return Hierarchy<V>(build(builder, objects, 2), objects);
  };
  Hierarchy<V> tree_a = tree(a), tree_b = tree(b);
  const Hierarchy<V>& other_tree = two_sets ? tree_b : tree_a;
  const Boxes& other = two_sets ? b : a;
  Front<V> front(tree_a, other_tree, descent);
  Counts kept, fresh;
  constexpr int frames = boxstream::tests::sanitized ? 10 : 50;
  for (int frame = 0; frame < frames; ++frame) {
    const auto meets = [&](auto i, auto j) { return overlaps(a[i], other[j]); };
    Pairs of_front, of_fresh;
    Counts first;
    front.step(
        meets,
        [&](auto i, auto j) {
          of_front.push_back({i, j});
        },
        frame == 0 ? first : kept);
    traverse(
        tree_a, other_tree, descent, meets,
        [&](auto i, auto j) {
          of_fresh.push_back({i, j});
        },
        frame == 0 ? first : fresh);
    const Pairs expected = two_sets ? truth(a, b) : truth(a);
    ASSERT_TRUE(same_pairs(of_front, expected, what + ", frame " + std::to_string(frame)));
    ASSERT_TRUE(same_pairs(of_fresh, expected, what + ", from the root, frame " + std::to_string(frame)));
    Counts refits;
    move(a, kind, step, random);
    move(b, kind, step, random);
    tree_a.refit(Objects::of(a), refits);
    tree_b.refit(Objects::of(b), refits);
  }
  if (fresh.volume_tests >= frames) {
    EXPECT_LT(kept.volume_tests, fresh.volume_tests) << what;
  }
  EXPECT_EQ(kept.primitive_tests, fresh.primitive_tests) << what;
}

TYPED_TEST(HierarchyTest, FrontsFindThePairsOfEachFrame) {
  Random random(5);
  for (const Builder builder : builders())
    for (const Descent descent : descents)
      for (const bool two_sets : {false, true})
        ASSERT_NO_FATAL_FAILURE(check_frames<TypeParam>(kinds[3], builder, descent, 0.002, two_sets, random));
}

TYPED_TEST(HierarchyTest, FrontsHoldOverAnyInput) {
  Random random(6);
  for (const Kind& kind : kinds)
    ASSERT_NO_FATAL_FAILURE(
        check_frames<TypeParam>(kind, Builder::surface_area, Descent::one_side, 0.002, false, random));
}

/// Objects that jump about: right all the same. And when all has come apart, the slice goes up to where it began.
TYPED_TEST(HierarchyTest, FrontsGoUpAgain) {
  Random random(7);
  for (const Descent descent : descents) {
    Boxes a = make(kinds[3], random), b = make(kinds[3], random);
    const Objects objects_a = Objects::of(a), objects_b = Objects::of(b);
    const Hierarchy<TypeParam> tree_a(build(Builder::median, objects_a), objects_a);
    Hierarchy<TypeParam> tree_b(build(Builder::tiling, objects_b), objects_b);
    Front<TypeParam> front(tree_a, tree_b, descent);
    Counts counts;
    std::size_t pairs = 0;
    const auto meets = [&](auto i, auto j) { return overlaps(a[i], b[j]); };
    const auto count = [&](auto, auto) { ++pairs; };
    front.step(meets, count, counts);
    EXPECT_EQ(pairs, truth(a, b).size());
    EXPECT_GT(front.size(), 100u);
    for (int jump = 0; jump < 5; ++jump) {
      move(b, kinds[3], 1, random);
      tree_b.refit(Objects::of(b), counts);
      pairs = 0;
      front.step(meets, count, counts);
      EXPECT_EQ(pairs, truth(a, b).size());
    }
    for (Aabb& box : b) {
      box.min[1] += 100;
      box.max[1] += 100;
    }
    tree_b.refit(Objects::of(b), counts);
    pairs = 0;
    front.step(meets, count, counts);
    EXPECT_EQ(pairs, 0u);
    EXPECT_EQ(front.size(), 1u);
  }
}

}  // namespace
}  // namespace boxstream::papers::volumes::tests
