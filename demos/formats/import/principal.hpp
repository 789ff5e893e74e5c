// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "formats/import/frame.hpp"

namespace boxstream::imports {

/// Symmetric; of inertia, in kg m^2.
using Tensor = std::array<Vec3, 3>;

inline constexpr Tensor no_inertia{};

Tensor sum(const Tensor& a, const Tensor& b);

/// As seen by axes that `turn` turns into those of `tensor`.
Tensor turned(const Quat& turn, const Tensor& tensor);

/// What a point of this mass adds when it is at `place`.
Tensor of_point(double mass, const Vec3& place);

struct Principal {
  Vec3 moments{};
  Quat turn{0, 0, 0, 1};  // takes the axes to the principal ones
};

/// A tensor that is diagonal already keeps its axes.
Principal principal(const Tensor& tensor);

}  // namespace boxstream::imports
