// SPDX-License-Identifier: MIT
#include <vector>

#include "papers/experiments/structures.hpp"
#include "papers/structures/binary_structure.hpp"
#include "papers/structures/kd_builder.hpp"
#include "papers/structures/kd_tree.hpp"
#include "papers/structures/worst_case_structure.hpp"

namespace boxstream::papers {

namespace {

/// The k-d tree over boxes made dynamic by one method or the other.
template <class Dynamised>
class Dynamic final : public Structure {
 public:
  void build(Span<const Aabb> boxes) override {
    std::vector<KdPoint<6>> points;
    points.reserve(boxes.size());
    handles_.clear();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      points.push_back(as_point(boxes[i], static_cast<std::uint32_t>(i)));
      handles_.push_back(static_cast<Handle>(i));
    }
    dynamised_ = Dynamised(std::move(points));
  }

  void query_box(const Aabb& box, VisitNumber visit) const override {
    dynamised_.query(touching(box), [&](std::uint32_t number) { visit(number); });
  }

  void insert(std::uint32_t number, const Aabb& box) override {
    if (handles_.size() <= number) handles_.resize(number + 1);
    handles_[number] = dynamised_.insert(as_point(box, number));
  }

  void erase(std::uint32_t number) override { dynamised_.erase(handles_[number]); }

 private:
  using Handle = typename Dynamised::Handle;
  Dynamised dynamised_;
  std::vector<Handle> handles_;
};

}  // namespace

std::vector<StructureEntry> dynamic_structures() {
  return {
      {"k-d amortised", box_work | update_work, make_structure<Dynamic<BinaryStructure<KdBoxes>>>},
      {"k-d worst case", box_work | update_work, make_structure<Dynamic<WorstCaseStructure<KdBoxes, KdBuilder<6>>>>}};
}

}  // namespace boxstream::papers
