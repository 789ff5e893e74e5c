// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "papers/experiments/structures.hpp"

namespace boxstream::papers {

std::unique_ptr<Structure> make_world();
std::unique_ptr<Structure> make_detector();
std::unique_ptr<Structure> make_scan();
std::unique_ptr<Structure> make_kd_points();
std::unique_ptr<Structure> make_kd_boxes();
std::unique_ptr<Structure> make_kd_binary();
std::unique_ptr<Structure> make_kd_worst_case();
std::unique_ptr<Structure> make_octree();
std::unique_ptr<Structure> make_aabbs_by_tiling();
std::unique_ptr<Structure> make_aabbs_by_insertion();
std::unique_ptr<Structure> make_aabbs_by_median();
std::unique_ptr<Structure> make_aabbs_by_surface();
std::unique_ptr<Structure> make_spheres();
std::unique_ptr<Structure> make_oriented_boxes();
std::unique_ptr<Structure> make_dops();

}  // namespace boxstream::papers
