// SPDX-License-Identifier: MIT
#include "papers/experiments/structures.hpp"

#include <optional>
#include <vector>

#include "papers/structures/kd_tree.hpp"
#include "papers/structures/octree.hpp"

namespace boxstream::papers {

// Each is in the file of its name.
std::vector<StructureEntry> engine_structures();
std::vector<StructureEntry> dynamic_structures();
std::vector<StructureEntry> volume_structures();

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

class KdPoints final : public Structure {
 public:
  void build(Span<const Aabb> boxes) override {
    std::vector<KdPoint<3>> points;
    points.reserve(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
      points.push_back({{boxes[i].min[0], boxes[i].min[1], boxes[i].min[2]}, static_cast<std::uint32_t>(i)});
    tree_ = KdTree<3>(std::move(points));
  }

  void query_box(const Aabb& box, VisitNumber visit) const override {
    tree_.query({{box.min[0], box.min[1], box.min[2]}, {box.max[0], box.max[1], box.max[2]}},
                [&](const KdPoint<3>& point) { visit(point.number); });
  }

 private:
  KdTree<3> tree_;
};

/// Pairs by a query for each box: a k-d tree has no volumes that two trees could be compared by.
class KdOfBoxes final : public Structure {
 public:
  void build(Span<const Aabb> boxes) override {
    std::vector<KdPoint<6>> points;
    points.reserve(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) points.push_back(as_point(boxes[i], static_cast<std::uint32_t>(i)));
    tree_ = KdBoxes(std::move(points));
  }

  void query_box(const Aabb& box, VisitNumber visit) const override {
    tree_.query(touching(box), [&](const KdPoint<6>& point) { visit(point.number); });
  }

  void find_pairs(Span<const Aabb> others, Found found) const override {
    for (std::size_t i = 0; i < others.size(); ++i)
      query_box(others[i], [&](std::uint32_t number) { found(number, static_cast<std::uint32_t>(i)); });
  }

  void next_frame(Span<const Aabb> boxes, Found found) override {
    build(boxes);
    for (std::size_t i = 0; i < boxes.size(); ++i)
      query_box(boxes[i], [&](std::uint32_t number) {
        if (number < i) found(number, static_cast<std::uint32_t>(i));
      });
  }

 private:
  KdBoxes tree_;
};

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

std::vector<StructureEntry> static_structures() {
  return {{"scan", box_work | ray_work | no_build, make_structure<Scan>},
          {"k-d tree of points", point_work, make_structure<KdPoints>},
          {"k-d tree of boxes", box_work | pair_work | frame_work, make_structure<KdOfBoxes>},
          {"octree", ray_work, make_structure<OctreeOfBoxes>}};
}

}  // namespace

Span<const StructureEntry> structures() {
  static const std::vector<StructureEntry> all = [] {
    std::vector<StructureEntry> joined;
    for (const auto list : {engine_structures, static_structures, dynamic_structures, volume_structures})
      for (const StructureEntry& entry : list()) joined.push_back(entry);
    return joined;
  }();
  return all;
}

}  // namespace boxstream::papers
