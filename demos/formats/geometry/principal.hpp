// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "formats/geometry/frame.hpp"

namespace boxstream::geometry {

/// Symmetric; of inertia, in kg m^2.
using Tensor = std::array<Vec3, 3>;

inline constexpr Tensor no_inertia{};

Tensor sum(const Tensor& a, const Tensor& b);
Tensor scaled(const Tensor& tensor, double factor);
Tensor diagonal(const Vec3& moments);

/// As seen by axes that `turn` turns into those of `tensor`.
Tensor turned(const Quat& turn, const Tensor& tensor);

/// What a point of this mass adds when it is at `place`.
Tensor of_point(double mass, const Vec3& place);

struct Principal {
  Vec3 moments{};
  Quat turn{0, 0, 0, 1};  // takes the axes to the principal ones
};

/// A tensor that is diagonal already, or as good as that, keeps its axes. Otherwise each principal axis goes by the
/// name of the axis that it is near to: the turn is as small as it can be, half a turn about none.
Principal principal(const Tensor& tensor);

}  // namespace boxstream::geometry
