// SPDX-License-Identifier: MIT
#include "simulation/engine/joint_trees.hpp"

#include <algorithm>
#include <numeric>

namespace boxstream::scenes {
namespace {

class Sets {
 public:
  explicit Sets(std::size_t size) : parents_(size) { std::iota(parents_.begin(), parents_.end(), std::size_t{0}); }

  /// The least of a set stands for it.
  std::size_t of(std::size_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  /// False if they were one already.
  bool join(std::size_t a, std::size_t b) {
    a = of(a);
    b = of(b);
    parents_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  std::vector<std::size_t> parents_;
};

/// Puts links of one group into a tree, from the base outwards.
void hang_up(const std::vector<JointEdge>& joints, const std::vector<std::vector<std::size_t>>& joints_of,
             const std::vector<std::size_t>& first_links, JointTrees& all, std::size_t tree) {
  std::vector<JointTrees::Link>& links = all.trees[tree].links;
  const auto place_of = [&](std::size_t body) -> std::optional<JointTrees::Place>& { return all.places[body]; };
  const auto add = [&](std::size_t body, std::size_t joint, std::optional<std::size_t> parent) {
    place_of(body) = JointTrees::Place{tree, static_cast<int>(links.size())};
    links.push_back({body, joint, parent});
  };
  const auto grow = [&](std::size_t body, std::optional<std::size_t> link) {
    for (const std::size_t joint : joints_of[body]) {
      const JointEdge& edge = joints[joint];
      if (!edge.b) continue;
      const std::size_t other = edge.a == body ? *edge.b : edge.a;
      if (!place_of(other)) add(other, joint, link);
    }
  };
  if (const auto base = all.trees[tree].base) {
    place_of(*base) = JointTrees::Place{tree, -1};
    grow(*base, std::nullopt);
  }
  for (const std::size_t joint : first_links) add(joints[joint].a, joint, std::nullopt);
  for (std::size_t at = 0; at < links.size(); ++at) grow(links[at].body, at);
}

}  // namespace

JointTrees grow_trees(std::size_t bodies, const std::vector<JointEdge>& joints) {
  JointTrees all;
  all.places.resize(bodies);
  all.holds.assign(joints.size(), 0);
  Sets groups(bodies);
  for (const JointEdge& edge : joints)
    if (edge.b) groups.join(edge.a, *edge.b);

  std::vector<std::vector<std::size_t>> joints_of_group(bodies);
  for (std::size_t i = 0; i < joints.size(); ++i) joints_of_group[groups.of(joints[i].a)].push_back(i);

  std::vector<std::vector<std::size_t>> in_tree(bodies);  // joints of each body that are no closing ones
  // Each group has a node for the world, which is that of its first body moved by the number of bodies.
  Sets connected(2 * bodies);
  for (std::size_t group = 0; group < bodies; ++group) {
    std::vector<std::size_t>& of_group = joints_of_group[group];
    if (of_group.empty()) continue;
    const auto unfit =
        std::find_if(of_group.begin(), of_group.end(), [&](std::size_t joint) { return !joints[joint].unfit.empty(); });
    if (unfit != of_group.end()) {
      all.refused.push_back({*unfit, joints[*unfit].unfit});
      continue;
    }
    JointTrees::Tree tree;
    std::vector<std::size_t> first_links;
    std::stable_partition(of_group.begin(), of_group.end(),
                          [&](std::size_t joint) { return !joints[joint].may_close; });
    std::optional<std::size_t> cannot_close;
    for (const std::size_t joint : of_group) {
      const JointEdge& edge = joints[joint];
      if (!connected.join(edge.a, edge.b.value_or(bodies + group))) {
        tree.closing.push_back(joint);
        if (!edge.may_close && !cannot_close) cannot_close = joint;
        continue;
      }
      in_tree[edge.a].push_back(joint);
      if (edge.b)
        in_tree[*edge.b].push_back(joint);
      else
        first_links.push_back(joint);
    }
    if (cannot_close) {
      all.refused.push_back({*cannot_close, "closes a loop, which only balls and hinges without limits and motor may"});
      continue;
    }
    if (first_links.empty()) tree.base = group;
    for (const std::size_t joint : of_group) all.holds[joint] = 1;
    all.trees.push_back(std::move(tree));
    hang_up(joints, in_tree, first_links, all, all.trees.size() - 1);
  }
  return all;
}

}  // namespace boxstream::scenes
