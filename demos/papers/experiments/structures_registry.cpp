// SPDX-License-Identifier: MIT
#include <stdexcept>

#include "papers/experiments/structure_makers.hpp"

namespace boxstream::papers {

namespace {

[[noreturn]] void cannot() {
  throw std::logic_error("a structure was asked for what is not among its works");
}

}  // namespace

Span<const StructureEntry> structures() {
  static constexpr StructureEntry all[] = {
      {"boxstream", box_work | ray_work | update_work | frame_work, make_world},
      {"boxstream batch", pair_work | frame_work, make_detector},
      {"scan", box_work | ray_work | no_build, make_scan},
      {"k-d tree of points", point_work, make_kd_points},
      {"k-d tree of boxes", box_work | pair_work | frame_work, make_kd_boxes},
      {"k-d amortised", box_work | update_work, make_kd_binary},
      {"k-d worst case", box_work | update_work, make_kd_worst_case},
      {"octree", ray_work, make_octree},
      {"AABBs by tiling", box_work | pair_work, make_aabbs_by_tiling},
      {"AABBs by insertion", box_work | pair_work, make_aabbs_by_insertion},
      {"AABBs by median", box_work | pair_work | frame_work, make_aabbs_by_median},
      {"AABBs by surface", box_work | pair_work | frame_work, make_aabbs_by_surface},
      {"spheres", box_work, make_spheres},
      {"OBBs", box_work, make_oriented_boxes},
      {"14-DOPs", box_work, make_dops},
  };
  return all;
}

void Structure::query_box(const Aabb&, VisitNumber) const {
  cannot();
}
FirstHit Structure::first_hit(const Ray&) const {
  cannot();
}
void Structure::insert(std::uint32_t, const Aabb&) {
  cannot();
}
void Structure::erase(std::uint32_t) {
  cannot();
}
void Structure::find_pairs(Span<const Aabb>, Found) const {
  cannot();
}
void Structure::next_frame(Span<const Aabb>, Found) {
  cannot();
}

}  // namespace boxstream::papers
