// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "sweep.hpp"

/// What a request names of its scene. BadKnob, with what there is, if there is no such thing.
namespace boxstream::accuracy {

/// Among all objects, by name or number.
std::optional<std::size_t> body_of(const Request& request, const scenes::Scene& scene);

/// Among all joints, by number or by the names of its bodies: "a,b"; "a" where it is the only one of `a`.
std::optional<std::size_t> joint_of(const Request& request, const scenes::Scene& scene);

}  // namespace boxstream::accuracy
