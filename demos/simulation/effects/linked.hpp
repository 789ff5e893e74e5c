// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/scene_model/expand.hpp"
#include "simulation/engine/joint_trees.hpp"

namespace boxstream::effects {

struct Subject;

/// The trees that multibodies are made of: none unless the scene asks for them. Pure.
scenes::JointTrees trees_of(const scenes::Scene& scene, const scenes::Expanded& expanded);

/// Requests of a scene that its multibodies cannot meet, a line each.
std::vector<std::string> not_by_multibodies(const Subject& subject);

}  // namespace boxstream::effects
