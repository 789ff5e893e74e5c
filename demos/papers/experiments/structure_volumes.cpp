// SPDX-License-Identifier: MIT
#include <optional>
#include <vector>

#include "papers/experiments/structures.hpp"
#include "papers/volumes/axis_box.hpp"
#include "papers/volumes/builders.hpp"
#include "papers/volumes/dop.hpp"
#include "papers/volumes/front.hpp"
#include "papers/volumes/oriented_box.hpp"
#include "papers/volumes/query.hpp"
#include "papers/volumes/sphere.hpp"

namespace boxstream::papers {

namespace {

using namespace volumes;

template <Volume V, Builder builder>
class HierarchyOfBoxes final : public Structure {
 public:
  void build(Span<const Aabb> boxes) override {
    boxes_.assign(boxes.begin(), boxes.end());
    front_.reset();
    hierarchy_.emplace(built(boxes_));
  }

  void query_box(const Aabb& box, VisitNumber visit) const override {
    Counts counts;
    query(
        *hierarchy_, V::around(Points(corners_of(box))), [&](std::uint32_t i) { return overlaps(boxes_[i], box); },
        visit, counts);
  }

  void find_pairs(Span<const Aabb> others, Found found) const override {
    Counts counts;
    traverse(
        *hierarchy_, built(others), Descent::one_side,
        [&](std::uint32_t i, std::uint32_t j) { return overlaps(boxes_[i], others[j]); }, found, counts);
  }

  /// The tree stays what it was when it was built; its volumes follow the boxes.
  void next_frame(Span<const Aabb> boxes, Found found) override {
    boxes_.assign(boxes.begin(), boxes.end());
    Counts counts;
    hierarchy_->refit(Objects::of(boxes), counts);
    if (!front_) front_.emplace(*hierarchy_, *hierarchy_, Descent::one_side);
    front_->step([&](std::uint32_t i, std::uint32_t j) { return overlaps(boxes_[i], boxes_[j]); }, found, counts);
  }

 private:
  static Hierarchy<V> built(Span<const Aabb> boxes) {
    const Objects objects = Objects::of(boxes);
    return Hierarchy<V>(volumes::build(builder, objects), objects);
  }

  std::vector<Aabb> boxes_;
  std::optional<Hierarchy<V>> hierarchy_;
  std::optional<Front<V>> front_;
};

}  // namespace

std::vector<StructureEntry> volume_structures() {
  return {{"AABBs by tiling", box_work | pair_work, make_structure<HierarchyOfBoxes<AxisBox, Builder::tiling>>},
          {"AABBs by insertion", box_work | pair_work, make_structure<HierarchyOfBoxes<AxisBox, Builder::insertion>>},
          {"AABBs by median", box_work | pair_work | frame_work,
           make_structure<HierarchyOfBoxes<AxisBox, Builder::median>>},
          {"AABBs by surface", box_work | pair_work | frame_work,
           make_structure<HierarchyOfBoxes<AxisBox, Builder::surface_area>>},
          {"spheres", box_work, make_structure<HierarchyOfBoxes<Sphere, Builder::surface_area>>},
          {"OBBs", box_work, make_structure<HierarchyOfBoxes<OrientedBox, Builder::surface_area>>},
          {"14-DOPs", box_work, make_structure<HierarchyOfBoxes<Dop<14>, Builder::surface_area>>}};
}

}  // namespace boxstream::papers
