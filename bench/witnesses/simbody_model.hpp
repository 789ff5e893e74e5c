// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

/// Bodies and joints for Simbody. In C++17 and nothing but numbers: Simbody's headers know no later standard, and take
/// long to compile.
namespace boxstream::witnesses::simbody {

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
  Numbers3 centre{};               ///< of mass, in its own axes
  Numbers3 inertia{}, products{};  ///< about that: xx, yy, zz and xy, xz, yz of the tensor along its own axes
  Numbers3 velocity{}, spin{};     ///< of the centre of mass
};

enum class JointKind { ball, hinge, slider, fixed, spring };

/// In world coordinates at the start.
struct Joint {
  JointKind kind = JointKind::ball;
  std::size_t a = world, b = world;
  Numbers3 pivot{};
  Numbers3 axis{};                    // of hinges and sliders
  double stiffness = 0, damping = 0;  // of springs, which pull the two pivots together
};

struct Model {
  Numbers3 gravity{};
  std::vector<Body> bodies;
  std::vector<Joint> joints;
};

struct Moving {
  Pose pose;
  Numbers3 velocity{}, spin{};
};
struct Frame {
  std::vector<Moving> bodies;
  double energy = 0;  // kinetic and potential, springs included
};

/// All bodies at the start and after each of `steps` times `dt`, by an error-controlled integrator (Runge-Kutta-Merson)
/// of this accuracy. A hinge that closes a loop holds its point and no more, which is all that a loop of hinges about
/// one direction needs.
///
/// Throws std::invalid_argument: velocities at the start are not what the joints allow, or a slider closes a loop.
std::vector<Frame> run(const Model& model, double dt, std::size_t steps, double accuracy = 1e-10);

}  // namespace boxstream::witnesses::simbody
