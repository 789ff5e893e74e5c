// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

/// Bodies and joints for Simbody. In C++17 and nothing but numbers: Simbody's headers know no later standard, and take
/// long to compile.
namespace boxstream::report::simbody {

using Numbers3 = std::array<double, 3>;
/// x, y, z, w of a unit quaternion.
using Numbers4 = std::array<double, 4>;

constexpr std::size_t world = static_cast<std::size_t>(-1);

struct Pose {
  Numbers3 position{};
  Numbers4 rotation{0, 0, 0, 1};
};

struct Body {
  Pose start;
  double mass = 1;
  Numbers3 inertia{};  ///< about its own axes
  Numbers3 velocity{}, spin{};
};

/// In world coordinates at the start. A ball joint, or a hinge.
struct Joint {
  std::size_t a = world, b = world;
  Numbers3 pivot{};
  bool hinge = false;
  Numbers3 axis{};
};

struct Model {
  Numbers3 gravity{};
  std::vector<Body> bodies;
  std::vector<Joint> joints;
};

/// Poses of all bodies after each of `steps` times `dt`, by an error-controlled integrator (Runge-Kutta-Merson,
/// accuracy 1e-10). Velocities at the start are taken from bodies without joints; the others hang at rest. A hinge that
/// closes a loop holds its point and no more, which is all that a loop of hinges about one direction needs.
std::vector<std::vector<Pose>> run(const Model& model, double dt, std::size_t steps);

}  // namespace boxstream::report::simbody
