// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "simulation/engine/solid_parts.hpp"

namespace boxstream::scenes {

/// What of a body's surface a flow meets, as a few spots on each part.
///
/// On each piece of surface that is turned to the flow, the flow pushes along its own direction, as if it lost there
/// all speed that it has relative to that piece: area turned to the flow, times speed, times velocity. The area of a
/// convex part is that of its silhouette: exact for balls, boxes, cylinders, capsules and hulls, within 2 % for cones,
/// however they are turned. Parts of a compound do not shelter each other. A surface that a spin moves along itself is
/// not held back by the flow, one that it moves into the flow is.
class Windward {
 public:
  Windward(ShapeSet& shapes, std::size_t shape, const btTransform& frame);

  struct Push {
    btVector3 force{0, 0, 0};   // m^4/s^2: times half the density and a coefficient a force
    btVector3 torque{0, 0, 0};  // likewise, about the origin of the body
  };
  /// By a flow with a velocity relative to the body's origin, on a body that spins; all along the body's axes.
  Push push(const btVector3& flow, const btVector3& spin) const;
  /// Largest distance of a point of the body from its origin.
  double reach() const { return reach_; }

 private:
  /// A piece of a plane: `area` is its size, along its outward normal.
  struct Flat {
    btVector3 place, area;
  };
  struct Ball {
    btVector3 place;
    btScalar area;
  };
  /// A length of the side of a cylinder.
  struct Side {
    btVector3 place, axis;
    btScalar area, depth;  // its largest silhouette; how far in front of the axis what is turned to the flow is
  };
  /// The half of a ball on the side of `axis`.
  struct Cap {
    btVector3 place, axis;
    btScalar area,
        offset;  // of the half disc that is its silhouette from aside; how far the middle of that is from `place`
  };

  void add(const SolidPart& part);
  void add_disc(const btTransform& pose, double height, double radius, double sign);
  void add_facets(const Facets& facets);

  std::vector<Flat> flats_;
  std::vector<Ball> balls_;
  std::vector<Side> sides_;
  std::vector<Cap> caps_;
  double reach_ = 0;
};

}  // namespace boxstream::scenes
