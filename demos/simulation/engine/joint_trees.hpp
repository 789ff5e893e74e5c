// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace boxstream::scenes {

/// A joint as an edge between bodies.
struct JointEdge {
  std::size_t a = 0;
  std::optional<std::size_t> b{};  ///< none: the world
  bool may_close = false;          ///< may stay between two bodies of one tree, and close a loop
  std::string unfit{};             ///< why no tree may have it; empty: it may be in one
};

/// The bodies that joints connect, each group of them as one tree.
struct JointTrees {
  struct Link {
    std::size_t body;
    std::size_t joint;                    ///< that holds it at its parent
    std::optional<std::size_t> parent{};  ///< index of a link before it; none: the base
  };
  struct Tree {
    std::optional<std::size_t> base{};  ///< a body; none: the world
    std::vector<Link> links;            ///< parents first
    std::vector<std::size_t> closing;   ///< joints that close loops
  };
  /// A joint for which all that is connected with it is in no tree.
  struct Refused {
    std::size_t joint;
    std::string reason;
  };
  /// Where a body is.
  struct Place {
    std::size_t tree;
    int link;  ///< -1: the base
  };

  std::vector<Tree> trees;
  std::vector<Refused> refused;              ///< the first joint of each group that is in no tree
  std::vector<std::optional<Place>> places;  ///< of each body
  std::vector<char> holds;                   ///< for each joint, whether a tree has it

  bool has_body(std::size_t body) const { return body < places.size() && places[body].has_value(); }
  bool has_joint(std::size_t joint) const { return joint < holds.size() && holds[joint] != 0; }
};

/// Groups in the order of their first bodies. The world connects nothing, but is the base of each group that a joint
/// holds at it; others have their first body for that. Joints that may not close loops come into trees first, then
/// those with lower numbers.
JointTrees grow_trees(std::size_t bodies, const std::vector<JointEdge>& joints);

}  // namespace boxstream::scenes
