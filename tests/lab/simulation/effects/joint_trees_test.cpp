// SPDX-License-Identifier: MIT
#include "simulation/engine/joint_trees.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

// Forests of joints, against what can be said of any forest.
namespace boxstream::scenes {
namespace {

/// For each body the least body that a chain of joints connects it with, by going through all joints until nothing
/// changes.
std::vector<std::size_t> groups(std::size_t bodies, const std::vector<JointEdge>& joints) {
  std::vector<std::size_t> least(bodies);
  for (std::size_t i = 0; i < bodies; ++i) least[i] = i;
  for (bool changed = true; changed;) {
    changed = false;
    for (const JointEdge& edge : joints) {
      if (!edge.b || least[edge.a] == least[*edge.b]) continue;
      least[edge.a] = least[*edge.b] = std::min(least[edge.a], least[*edge.b]);
      changed = true;
    }
  }
  return least;
}

void check(std::size_t bodies, const std::vector<JointEdge>& joints) {
  const JointTrees trees = grow_trees(bodies, joints);
  const std::vector<std::size_t> group = groups(bodies, joints);
  ASSERT_EQ(trees.places.size(), bodies);
  ASSERT_EQ(trees.holds.size(), joints.size());
  std::set<std::size_t> unfit, jointed;
  for (const JointEdge& edge : joints) {
    jointed.insert(group[edge.a]);
    if (!edge.unfit.empty()) unfit.insert(group[edge.a]);
  }

  std::set<std::size_t> refused;
  for (const auto& [joint, reason] : trees.refused) {
    EXPECT_FALSE(reason.empty());
    EXPECT_TRUE(refused.insert(group[joints[joint].a]).second) << "a group is refused twice";
    // Unfit, or not to be closed: then the joints that must be in a tree form a loop.
    if (unfit.count(group[joints[joint].a]) == 0) {
      std::size_t must = 0;
      std::set<std::size_t> ends;
      for (const JointEdge& edge : joints)
        if (group[edge.a] == group[joints[joint].a] && !edge.may_close) {
          ++must;
          ends.insert(edge.a);
          ends.insert(edge.b.value_or(bodies));
        }
      EXPECT_GE(must, 2u);
      EXPECT_FALSE(joints[joint].may_close);
    }
  }
  for (const std::size_t g : unfit) EXPECT_EQ(refused.count(g), 1u);

  std::set<std::size_t> seen, held;
  for (std::size_t t = 0; t < trees.trees.size(); ++t) {
    const JointTrees::Tree& tree = trees.trees[t];
    const auto is_at = [&](std::size_t body, int link) {
      ASSERT_TRUE(trees.places[body]);
      EXPECT_EQ(trees.places[body]->tree, t);
      EXPECT_EQ(trees.places[body]->link, link);
      EXPECT_TRUE(seen.insert(body).second) << "body " << body << " is there twice";
    };
    if (tree.base) is_at(*tree.base, -1);
    for (std::size_t i = 0; i < tree.links.size(); ++i) {
      const auto& [body, joint, parent] = tree.links[i];
      is_at(body, static_cast<int>(i));
      EXPECT_TRUE(held.insert(joint).second);
      const JointEdge& edge = joints[joint];
      std::optional<std::size_t> above = tree.base;
      if (parent) {
        ASSERT_LT(*parent, i) << "parents come first";
        above = tree.links[*parent].body;
      }
      EXPECT_TRUE((edge.a == body && edge.b == above) || (above && edge.a == *above && edge.b == body))
          << "the joint connects the two";
    }
    for (const std::size_t joint : tree.closing) {
      EXPECT_TRUE(held.insert(joint).second);
      EXPECT_TRUE(joints[joint].may_close);
    }
    const std::size_t any = tree.base ? *tree.base : tree.links.at(0).body;
    const bool holds_world = std::any_of(joints.begin(), joints.end(),
                                         [&](const JointEdge& edge) { return !edge.b && group[edge.a] == group[any]; });
    EXPECT_EQ(tree.base.has_value(), !holds_world) << "what hangs from the world has no body for a base";
  }
  for (std::size_t i = 0; i < bodies; ++i)
    EXPECT_EQ(seen.count(i) > 0, jointed.count(group[i]) > 0 && refused.count(group[i]) == 0) << "body " << i;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    EXPECT_EQ(trees.has_joint(j), refused.count(group[joints[j].a]) == 0);
    EXPECT_EQ(held.count(j) > 0, trees.has_joint(j));
  }
}

TEST(JointTrees, HaveEachBodyAndJointOnceOrRefuseItsGroup) {
  std::mt19937 random(7);
  for (int round = 0; round < 3000; ++round) {
    const std::size_t bodies = 1 + random() % 9, count = random() % 10;
    std::vector<JointEdge> joints;
    for (std::size_t j = 0; j < count; ++j) {
      JointEdge edge{random() % bodies, {}, random() % 4 != 0, random() % 20 == 0 ? "is a gear" : ""};
      if (const std::size_t b = random() % (bodies + 1); b < bodies && b != edge.a) edge.b = b;
      joints.push_back(edge);
    }
    ASSERT_NO_FATAL_FAILURE(check(bodies, joints)) << "round " << round;
    if (testing::Test::HasFailure()) return;
  }
}

TEST(JointTrees, TakeInWhatMayNotCloseALoop) {
  // A ring of three: the slider is in the tree though it comes last.
  const JointTrees trees = grow_trees(3, {{0, 1, true}, {1, 2, true}, {2, 0, false}});
  ASSERT_EQ(trees.trees.size(), 1u);
  EXPECT_EQ(trees.trees[0].closing, std::vector<std::size_t>{1});
  // Two sliders and no more can be in a ring of two.
  const JointTrees ring = grow_trees(2, {{0, 1, false}, {1, 0, false}});
  EXPECT_TRUE(ring.trees.empty());
  ASSERT_EQ(ring.refused.size(), 1u);
  EXPECT_EQ(ring.refused[0].joint, 1u);
}

TEST(JointTrees, HangFromTheWorldWhereAJointHoldsThemThere) {
  const JointTrees trees = grow_trees(4, {{1, 0}, {2, 1}, {2, {}}});
  ASSERT_EQ(trees.trees.size(), 1u);
  EXPECT_FALSE(trees.trees[0].base);
  ASSERT_EQ(trees.trees[0].links.size(), 3u);
  EXPECT_EQ(trees.trees[0].links[0].body, 2u);
  EXPECT_EQ(trees.trees[0].links[2].body, 0u);
  EXPECT_FALSE(trees.has_body(3));
}

}  // namespace
}  // namespace boxstream::scenes
