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

class TwoTrees final : public CrossPeer {
 public:
  void find_pairs(Span<const Aabb> a, Span<const Aabb> b, std::vector<Pair>& pairs) override {
    pairs.clear();
    tree_a_.build(a);
    tree_b_.build(b);
    tree_a_.pairs_with(tree_b_, [&](std::uint32_t i, std::uint32_t j) { pairs.push_back({i, j}); });
  }

 private:
  PlainTree tree_a_, tree_b_;
};

class TreeOverTheFew final : public CrossPeer {
 public:
  void find_pairs(Span<const Aabb> a, Span<const Aabb> b, std::vector<Pair>& pairs) override {
    pairs.clear();
    const bool a_is_few = a.size() < b.size();
    const Span<const Aabb> many = a_is_few ? b : a;
    tree_.build(a_is_few ? a : b);
    for (std::uint32_t j = 0; j < many.size(); ++j)
      tree_.query(many[j], [&](std::uint32_t i) { pairs.push_back(a_is_few ? Pair{i, j} : Pair{j, i}); });
  }

 private:
  PlainTree tree_;
};

}  // namespace

std::unique_ptr<Peer> make_plain_tree() {
  return std::make_unique<TreePeer>();
}
std::unique_ptr<CrossPeer> make_two_trees() {
  return std::make_unique<TwoTrees>();
}
std::unique_ptr<CrossPeer> make_tree_over_the_few() {
  return std::make_unique<TreeOverTheFew>();
}

}  // namespace boxstream::bench
