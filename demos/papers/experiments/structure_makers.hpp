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

}  // namespace boxstream::papers
