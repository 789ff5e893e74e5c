// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "simulation/engine/solid_parts.hpp"

namespace boxstream::scenes {

/// A volume, and its first moment: centre times volume.
struct Volume {
  double size = 0;  // m^3
  Vec3 moment{};

  void add(double part, const Vec3& centre) {
    size += part;
    for (std::size_t d = 0; d < 3; ++d) moment[d] += part * centre[d];
  }
};

/// One convex part of a body, as far as it is under a level.
class Submersible {
 public:
  virtual ~Submersible() = default;

  /// What of it is below y = `level`, in the world's axes and from the origin of the body, which is at `body`.
  Volume below(const btTransform& body, double level) const;
  double volume() const { return whole_.size; }

 protected:
  Submersible(const Volume& whole, const Vec3& middle, double reach) : whole_(whole), middle_(middle), reach_(reach) {}

 private:
  /// Of one that may reach both sides.
  virtual Volume cut(const btTransform& body, double level) const = 0;

  Volume whole_;  // in the frame of the body
  Vec3 middle_;   // of a ball that has all of it inside
  double reach_;
};

/// Exact for balls, boxes and hulls; of cylinders, cones and capsules what is partly under is integrated along the axis
/// with six points: a thousandth of the volume.
class Displacement {
 public:
  Displacement(ShapeSet& shapes, std::size_t shape, const btTransform& frame);

  Volume below(const btTransform& body, double level) const;
  double volume() const { return volume_; }

 private:
  std::vector<std::unique_ptr<Submersible>> parts_;
  double volume_ = 0;
};

}  // namespace boxstream::scenes
