// SPDX-License-Identifier: MIT
#include <optional>
#include <vector>

#include "papers/experiments/structures.hpp"
#include "papers/structures/octree.hpp"

namespace boxstream::papers {

namespace {

class OctreeOfBoxes final : public Structure {
 public:
  void build(Span<const Aabb> boxes) override {
    boxes_.assign(boxes.begin(), boxes.end());
    tree_.emplace(boxes_);
    mail_.emplace(*tree_);
  }

  FirstHit first_hit(const Ray& ray) const override { return tree_->first_hit(ray, *mail_); }

 private:
  std::vector<Aabb> boxes_;
  std::optional<Octree> tree_;
  mutable std::optional<Octree::Mailboxes> mail_;
};

}  // namespace

std::vector<StructureEntry> octree_structures() {
  return {{"octree", ray_work, make_structure<OctreeOfBoxes>}};
}

}  // namespace boxstream::papers
