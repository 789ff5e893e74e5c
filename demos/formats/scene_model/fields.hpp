// SPDX-License-Identifier: MIT
#pragma once

#include <variant>

#include "formats/scene_model/scaling.hpp"
#include "formats/scene_model/values.hpp"

namespace boxstream::scenes {

/// Air that drags all dynamic bodies around the vertical through `centre`, up in the middle and down at the walls, so
/// that they never come to rest. It turns as a rigid whole and its convection has no sources or sinks: it spreads
/// bodies evenly, but for what their inertia does.
struct VortexField {
  static constexpr const char* kind = "vortex";
  Vec3 centre{};       // middle of the floor
  double radius = 1;   // of the room
  double height = 1;   // of the room
  double speed = 0;    // around, at `radius`
  double updraft = 0;  // on the axis, half way up
  double rate = 0;     // 1/s: how fast bodies take on the speed of the air

  void scale(const Scaling& by) {
    radius *= by.side, height *= by.side;
    if (!by.self_similar) return;
    by.room(centre);
    speed *= by.side, updraft *= by.side;
  }
};

/// Air of one velocity; pushes dynamic bodies with density / 2 * area * |v|^2 * coefficient, where v is the velocity
/// relative to the air and the area what they turn to it, and turns them by where it pushes.
struct WindField {
  static constexpr const char* kind = "wind";
  Vec3 velocity{};
  double density = 1.2;      // kg/m^3
  double coefficient = 0.5;  // of drag

  /// Its force goes by the square of speeds: thinner air takes the same time.
  void scale(const Scaling& by) {
    if (!by.self_similar) return;
    by.room(velocity);
    density /= by.side;
  }
};

/// Slows all dynamic bodies down: force = -(linear + quadratic * |v|) * v, torque = -angular * spin, whatever their
/// shape; and as air of that density that is still.
struct DragField {
  static constexpr const char* kind = "drag";
  double linear = 0;         // N s/m
  double quadratic = 0;      // N s^2/m^2
  double angular = 0;        // N m s
  double density = 0;        // kg/m^3
  double coefficient = 0.5;  // of drag, of what has a density

  /// As of wind.
  void scale(const Scaling& by) {
    if (by.self_similar) quadratic /= by.side, density /= by.side;
  }
};

/// Fluid below a level: lifts dynamic bodies by the weight of what they displace, at its centre, and drags them in
/// proportion to how much is under.
struct BuoyancyField {
  static constexpr const char* kind = "buoyancy";
  double level = 0;       // y of the surface
  double density = 1000;  // kg/m^3
  double drag = 1;        // 1/s, of a body that is under

  void scale(const Scaling& by) {
    if (by.self_similar) level *= by.side;
  }
};

/// Before each step a share of the dynamic bodies, the next ones in turn, get a new velocity, uniform in a ball
/// (Broadmark's "Brownian" scenes).
struct ImpulsesField {
  static constexpr const char* kind = "impulses";
  double share = 0.01;  // rounded up to whole bodies
  double speed = 1;     // radius of the ball, m/s

  void scale(const Scaling& by) {
    if (by.self_similar) speed *= by.side;
  }
};

using Field = std::variant<VortexField, WindField, DragField, BuoyancyField, ImpulsesField>;

}  // namespace boxstream::scenes
