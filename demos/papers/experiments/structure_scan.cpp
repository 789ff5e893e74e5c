// SPDX-License-Identifier: MIT
#include <vector>

#include "papers/experiments/structures.hpp"

namespace boxstream::papers {

namespace {

/// No structure: what all others have to beat.
class Scan final : public Structure {
 public:
  void build(Span<const Aabb> boxes) override { boxes_.assign(boxes.begin(), boxes.end()); }

  void query_box(const Aabb& box, VisitNumber visit) const override {
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      if (overlaps(boxes_[i], box)) visit(static_cast<std::uint32_t>(i));
  }

  FirstHit first_hit(const Ray& ray) const override {
    FirstHit first;
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      first.offer(ray_enter(ray, boxes_[i]), static_cast<std::uint32_t>(i));
    return first;
  }

 private:
  std::vector<Aabb> boxes_;
};

}  // namespace

std::vector<StructureEntry> scan_structures() {
  return {{"scan", box_work | ray_work | no_build, make_structure<Scan>}};
}

}  // namespace boxstream::papers
