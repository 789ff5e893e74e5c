// SPDX-License-Identifier: MIT
#include "peers/plain_tree.hpp"

#include "peers/cross.hpp"
#include "peers/plain.hpp"

namespace boxstream::bench {

namespace {

class TreePeer final : public Peer {
 public:
  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
    pairs.clear();
    tree_.build(boxes);
    tree_.pairs_within([&](std::uint32_t i, std::uint32_t j) { pairs.push_back(i < j ? Pair{i, j} : Pair{j, i}); });
  }

 private:
  PlainTree tree_;
};

}  // namespace

std::unique_ptr<Peer> make_plain_tree() {
  return std::make_unique<TreePeer>();
}

CrossSearch make_two_trees() {
  return [tree_a = PlainTree(), tree_b = PlainTree()](Span<const Aabb> a, Span<const Aabb> b,
                                                      std::vector<Pair>& pairs) mutable {
    pairs.clear();
    tree_a.build(a);
    tree_b.build(b);
    tree_a.pairs_with(tree_b, [&](std::uint32_t i, std::uint32_t j) { pairs.push_back({i, j}); });
  };
}

CrossSearch make_tree_over_the_few() {
  return [tree = PlainTree()](Span<const Aabb> a, Span<const Aabb> b, std::vector<Pair>& pairs) mutable {
    pairs.clear();
    const bool a_is_few = a.size() < b.size();
    const Span<const Aabb> many = a_is_few ? b : a;
    tree.build(a_is_few ? a : b);
    for (std::uint32_t j = 0; j < many.size(); ++j)
      tree.query(many[j], [&](std::uint32_t i) { pairs.push_back(a_is_few ? Pair{i, j} : Pair{j, i}); });
  };
}

}  // namespace boxstream::bench
